//! Bilinear quadrilateral (CPE4 of the thesis): N_a = (1 + xi xi_a)(1 + eta eta_a) / 4 on [-1, 1]^2.

use super::Element;

/// Four-node quadrilateral, nodes counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quad4;

/// 1/sqrt(3): two-point Gauss rule.
const G: f64 = 0.577_350_269_189_625_8;

impl Element<4, 2> for Quad4 {
    const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    const QUADRATURE: &'static [([f64; 2], f64)] = &[
        ([-G, -G], 1.0),
        ([G, -G], 1.0),
        ([G, G], 1.0),
        ([-G, G], 1.0),
    ];

    fn shape(xi: [f64; 2]) -> [f64; 4] {
        Self::CORNERS.map(|c| 0.25 * (1.0 + xi[0] * c[0]) * (1.0 + xi[1] * c[1]))
    }

    fn gradient(xi: [f64; 2]) -> [[f64; 2]; 4] {
        Self::CORNERS.map(|c| {
            [
                0.25 * c[0] * (1.0 + xi[1] * c[1]),
                0.25 * c[1] * (1.0 + xi[0] * c[0]),
            ]
        })
    }
}
