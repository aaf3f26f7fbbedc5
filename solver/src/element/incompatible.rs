//! Quadrilateral with incompatible modes: it bends without the parasitic shear of the bilinear element.
//!
//! Inside the element, u + (1 - xi^2) a_1 + (1 - eta^2) a_2. The gradients of the modes are taken with the Jacobian J_0
//! at the centre and scaled by det J_0 / det J, so that their mean vanishes and the patch test holds on any
//! quadrilateral (Taylor, Beresford and Wilson 1976). The modes are eliminated in the element: K - K_ua K_aa^-1 K_au.

use nalgebra::{Matrix2, SMatrix, SVector};

use super::{Element, Quad4, physical_gradient, stiffness};
use crate::law::elastic::Lame;

/// Stiffness of a quadrilateral with incompatible modes, as [`stiffness`] returns it.
pub fn quad_stiffness(
    nodes: &[[f64; 2]; 4],
    lame: Lame,
    b_bar: bool,
) -> Option<[[Matrix2<f64>; 4]; 4]> {
    let mut k = stiffness::<Quad4, 4>(nodes, lame, b_bar)?;
    let (modes, coupling) = integrate(nodes, lame, b_bar)?;
    let eliminated = coupling * modes.try_inverse()? * coupling.transpose();
    for (a, row) in k.iter_mut().enumerate() {
        for (b, block) in row.iter_mut().enumerate() {
            *block -= eliminated.fixed_view::<2, 2>(2 * a, 2 * b);
        }
    }
    Some(k)
}

/// Amplitudes a_1 and a_2 of the modes under nodal displacements, mm; `None` if the element is inverted.
pub fn amplitudes(
    nodes: &[[f64; 2]; 4],
    lame: Lame,
    b_bar: bool,
    displacement: &[[f64; 2]; 4],
) -> Option<[[f64; 2]; 2]> {
    let (modes, coupling) = integrate(nodes, lame, b_bar)?;
    let u = SVector::<f64, 8>::from_fn(|i, _| displacement[i / 2][i % 2]);
    let a = modes.try_inverse()? * coupling.transpose() * -u;
    Some([[a[0], a[1]], [a[2], a[3]]])
}

/// K_aa of the modes and K_ua of the nodes with them.
fn integrate(
    nodes: &[[f64; 2]; 4],
    lame: Lame,
    b_bar: bool,
) -> Option<(SMatrix<f64, 4, 4>, SMatrix<f64, 8, 4>)> {
    // The mean volumetric strain of the modes is zero.
    let lambda = if b_bar { 0.0 } else { lame.lambda };
    let mut modes = SMatrix::<f64, 4, 4>::zeros();
    let mut coupling = SMatrix::<f64, 8, 4>::zeros();
    for &(xi, weight) in Quad4::QUADRATURE {
        let (gradients, det) = physical_gradient(nodes, &Quad4::gradient(xi))?;
        let mode = mode_gradients(nodes, xi, det)?;
        let product = |a: [f64; 2], b: [f64; 2]| {
            let dot = a[0] * b[0] + a[1] * b[1];
            Matrix2::from_fn(|i, j| {
                let shear = a[j] * b[i] + if i == j { dot } else { 0.0 };
                (lambda * a[i] * b[j] + lame.mu * shear) * det * weight
            })
        };
        for (m, b) in mode.iter().enumerate() {
            for (n, a) in mode.iter().enumerate() {
                let mut block = modes.fixed_view_mut::<2, 2>(2 * n, 2 * m);
                block += product(*a, *b);
            }
            for (n, a) in gradients.iter().enumerate() {
                let mut block = coupling.fixed_view_mut::<2, 2>(2 * n, 2 * m);
                block += product(*a, *b);
            }
        }
    }
    Some((modes, coupling))
}

/// Gradients of both modes at a reference point, for the determinant of the Jacobian there; `None` if the element is
/// inverted.
pub fn mode_gradients(nodes: &[[f64; 2]; 4], xi: [f64; 2], det: f64) -> Option<[[f64; 2]; 2]> {
    // The gradients of xi and eta at the centre, from those of the shape functions.
    let reference = Quad4::gradient([0.0; 2]);
    let (physical, central) = physical_gradient(nodes, &reference)?;
    let along = |direction: usize| {
        let mut sum = [0.0; 2];
        for (corner, g) in Quad4::CORNERS.iter().zip(&physical) {
            for (s, g) in sum.iter_mut().zip(g) {
                *s += corner[direction] * g;
            }
        }
        sum
    };
    let scale = central / det;
    Some([0, 1].map(|d| along(d).map(|g| -2.0 * xi[d] * scale * g)))
}
