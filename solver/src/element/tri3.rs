//! Linear triangle (CPE3 of the thesis): N = (1 - xi - eta, xi, eta) on the unit triangle.

use super::Element;

/// Three-node triangle, nodes counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tri3;

impl Element<3, 2> for Tri3 {
    const CORNERS: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    const QUADRATURE: &'static [([f64; 2], f64)] = &[([1.0 / 3.0, 1.0 / 3.0], 0.5)];

    fn shape(xi: [f64; 2]) -> [f64; 3] {
        [1.0 - xi[0] - xi[1], xi[0], xi[1]]
    }

    fn gradient(_: [f64; 2]) -> [[f64; 2]; 3] {
        [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]
    }
}
