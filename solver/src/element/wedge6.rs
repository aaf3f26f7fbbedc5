//! Linear wedge (C3D6 of the thesis): the linear triangle times (1 + zeta zeta_a) / 2 on [-1, 1].
//!
//! Three quadrature points in the plane and two along the prism integrate its stiffness exactly where both triangles are alike; the
//! patch test holds on any wedge.

use super::{Element, Tri3};

/// Six-node wedge: a triangle, nodes counter-clockwise, at zeta = -1, then the same at zeta = 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wedge6;

/// 1/sqrt(3): two-point Gauss rule.
const G: f64 = 0.577_350_269_189_625_8;
/// Points of the rule of degree 2 on the triangle (Zienkiewicz and Taylor 2000, table 9.2), each of a third of its area.
const NEAR: f64 = 1.0 / 6.0;
const FAR: f64 = 2.0 / 3.0;
const SIXTH: f64 = 1.0 / 6.0;

impl Element<6, 3> for Wedge6 {
    const CORNERS: [[f64; 3]; 6] = [
        [0.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [0.0, 1.0, -1.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    const QUADRATURE: &'static [([f64; 3], f64)] = &[
        ([NEAR, NEAR, -G], SIXTH),
        ([FAR, NEAR, -G], SIXTH),
        ([NEAR, FAR, -G], SIXTH),
        ([NEAR, NEAR, G], SIXTH),
        ([FAR, NEAR, G], SIXTH),
        ([NEAR, FAR, G], SIXTH),
    ];

    fn shape([xi, eta, zeta]: [f64; 3]) -> [f64; 6] {
        let plane = Tri3::shape([xi, eta]);
        std::array::from_fn(|a| plane[a % 3] * 0.5 * (1.0 + zeta * Self::CORNERS[a][2]))
    }

    fn gradient([xi, eta, zeta]: [f64; 3]) -> [[f64; 3]; 6] {
        let (plane, along) = (Tri3::shape([xi, eta]), Tri3::gradient([xi, eta]));
        std::array::from_fn(|a| {
            let end = Self::CORNERS[a][2];
            let share = 0.5 * (1.0 + zeta * end);
            let [by_xi, by_eta] = along[a % 3];
            [by_xi * share, by_eta * share, plane[a % 3] * 0.5 * end]
        })
    }
}
