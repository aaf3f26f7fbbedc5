//! Trilinear hexahedron (C3D8 of the thesis): N_a = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta zeta_a) / 8 on [-1, 1]^3.

use super::{Element, Quad4};

/// Eight-node hexahedron: a quadrilateral, nodes counter-clockwise, at zeta = -1, then the same at zeta = 1.
#[derive(Debug, Clone, Copy)]
pub struct Hex8;

/// 1/sqrt(3): two-point Gauss rule.
const G: f64 = 0.577_350_269_189_625_8;

impl Element<8, 3> for Hex8 {
    const CORNERS: [[f64; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];
    const QUADRATURE: &'static [([f64; 3], f64)] = &[
        ([-G, -G, -G], 1.0),
        ([G, -G, -G], 1.0),
        ([G, G, -G], 1.0),
        ([-G, G, -G], 1.0),
        ([-G, -G, G], 1.0),
        ([G, -G, G], 1.0),
        ([G, G, G], 1.0),
        ([-G, G, G], 1.0),
    ];

    fn shape([xi, eta, zeta]: [f64; 3]) -> [f64; 8] {
        let plane = Quad4::shape([xi, eta]);
        std::array::from_fn(|a| plane[a % 4] * 0.5 * (1.0 + zeta * Self::CORNERS[a][2]))
    }

    fn gradient([xi, eta, zeta]: [f64; 3]) -> [[f64; 3]; 8] {
        let (plane, along) = (Quad4::shape([xi, eta]), Quad4::gradient([xi, eta]));
        std::array::from_fn(|a| {
            let end = Self::CORNERS[a][2];
            let share = 0.5 * (1.0 + zeta * end);
            let [by_xi, by_eta] = along[a % 4];
            [by_xi * share, by_eta * share, plane[a % 4] * 0.5 * end]
        })
    }
}
