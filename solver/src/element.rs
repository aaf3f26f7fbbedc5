//! Finite elements of linear elasticity: an element is its data plus one function.

pub mod incompatible;
pub mod quad4;
pub mod tri3;

use crate::law::elastic::Lame;
use nalgebra::Matrix2;

pub use incompatible::quad_stiffness;
pub use quad4::Quad4;
pub use tri3::Tri3;

/// Above this Poisson's ratio the volumetric part is taken at its mean over the element (B-bar): from here on
/// lambda > 9 mu, and a fully integrated quadrilateral begins to lock.
pub const B_BAR_FROM_POISSON_RATIO: f64 = 0.45;

/// A plane element with `N` nodes.
pub trait Element<const N: usize> {
    /// Places of the nodes on the reference element.
    const CORNERS: [[f64; 2]; N];

    /// Quadrature points and weights on the reference element.
    const QUADRATURE: &'static [([f64; 2], f64)];

    /// Shape functions at a reference point.
    fn shape(xi: [f64; 2]) -> [f64; N];

    /// Derivatives of the shape functions with respect to the reference coordinates.
    fn gradient(xi: [f64; 2]) -> [[f64; 2]; N];
}

/// Stiffness of an element, N/mm per mm of depth: 2x2 blocks K_ab between nodes a and b, or `None` if the
/// element is inverted somewhere.
///
/// `K_ab[i][j]` = integral of lambda d_i N_a d_j N_b + mu (d_j N_a d_i N_b + delta_ij grad N_a . grad N_b).
pub fn stiffness<E: Element<N>, const N: usize>(
    nodes: &[[f64; 2]; N],
    lame: Lame,
    b_bar: bool,
) -> Option<[[Matrix2<f64>; N]; N]> {
    let mut k = [[Matrix2::zeros(); N]; N];
    let mut mean = [[0.0; 2]; N];
    let mut area = 0.0;
    for &(xi, weight) in E::QUADRATURE {
        let (g, det) = physical_gradient(nodes, &E::gradient(xi))?;
        let dv = det * weight;
        area += dv;
        let lambda = if b_bar { 0.0 } else { lame.lambda };
        add_point(&mut k, &g, lambda * dv, lame.mu * dv);
        for (m, gradient) in mean.iter_mut().zip(&g) {
            m[0] += gradient[0] * dv;
            m[1] += gradient[1] * dv;
        }
    }
    if b_bar {
        let mean = mean.map(|m| [m[0] / area, m[1] / area]);
        add_point(&mut k, &mean, lame.lambda * area, 0.0);
    }
    Some(k)
}

fn add_point<const N: usize>(
    k: &mut [[Matrix2<f64>; N]; N],
    g: &[[f64; 2]; N],
    lambda: f64,
    mu: f64,
) {
    for a in 0..N {
        for b in 0..N {
            let dot = g[a][0] * g[b][0] + g[a][1] * g[b][1];
            for i in 0..2 {
                for j in 0..2 {
                    let shear = g[a][j] * g[b][i] + if i == j { dot } else { 0.0 };
                    k[a][b][(i, j)] += lambda * g[a][i] * g[b][j] + mu * shear;
                }
            }
        }
    }
}

/// Gradients in physical coordinates and the determinant of the Jacobian; `None` if it is not positive.
pub fn physical_gradient<const N: usize>(
    nodes: &[[f64; 2]; N],
    reference: &[[f64; 2]; N],
) -> Option<([[f64; 2]; N], f64)> {
    let mut jacobian = [[0.0; 2]; 2];
    for (node, g) in nodes.iter().zip(reference) {
        for i in 0..2 {
            for j in 0..2 {
                jacobian[i][j] += node[i] * g[j];
            }
        }
    }
    let det = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
    if det.is_nan() || det <= 0.0 {
        return None;
    }
    let gradients = reference.map(|g| {
        [
            (g[0] * jacobian[1][1] - g[1] * jacobian[1][0]) / det,
            (g[1] * jacobian[0][0] - g[0] * jacobian[0][1]) / det,
        ]
    });
    Some((gradients, det))
}

#[cfg(test)]
mod tests;
