//! Finite elements of linear elasticity: an element is its data plus one function.

pub(crate) mod harmonic;
pub(crate) mod hex8;
pub(crate) mod incompatible;
pub(crate) mod quad4;
pub(crate) mod tri3;
pub(crate) mod wedge6;

use crate::law::elastic::Lame;
use nalgebra::SMatrix;

pub use hex8::Hex8;
pub(crate) use incompatible::{hex_stiffness, quad_stiffness};
pub(crate) use quad4::Quad4;
pub(crate) use tri3::Tri3;
pub(crate) use wedge6::Wedge6;

/// Above this Poisson's ratio the volumetric part is taken at its mean over the element (B-bar): from here on
/// lambda > 9 mu, and a fully integrated quadrilateral begins to lock.
pub(crate) const B_BAR_FROM_POISSON_RATIO: f64 = 0.45;

/// An element with `N` nodes in `D` dimensions, plane strain in two.
pub trait Element<const N: usize, const D: usize> {
    /// Places of the nodes on the reference element.
    const CORNERS: [[f64; D]; N];

    /// Quadrature points and weights on the reference element.
    const QUADRATURE: &'static [([f64; D], f64)];

    /// Shape functions at a reference point.
    fn shape(xi: [f64; D]) -> [f64; N];

    /// Derivatives of the shape functions with respect to the reference coordinates.
    fn gradient(xi: [f64; D]) -> [[f64; D]; N];
}

/// Blocks K_ab between the nodes a and b of an element.
pub type Stiffness<const N: usize, const D: usize> = [[SMatrix<f64, D, D>; N]; N];

/// Stiffness of an element, N/mm (in two dimensions per mm of depth), or `None` if the element is inverted somewhere.
///
/// `K_ab[i][j]` = integral of lambda d_i N_a d_j N_b + mu (d_j N_a d_i N_b + delta_ij grad N_a . grad N_b).
pub fn stiffness<E: Element<N, D>, const N: usize, const D: usize>(
    nodes: &[[f64; D]; N],
    lame: Lame,
    b_bar: bool,
) -> Option<Stiffness<N, D>> {
    let mut k = [[SMatrix::zeros(); N]; N];
    let mut mean = [[0.0; D]; N];
    let mut volume = 0.0;
    for &(xi, weight) in E::QUADRATURE {
        let (g, det) = physical_gradient(nodes, &E::gradient(xi))?;
        let dv = det * weight;
        volume += dv;
        let lambda = if b_bar { 0.0 } else { lame.lambda };
        add_point(&mut k, &g, lambda * dv, lame.mu * dv);
        for (m, gradient) in mean.iter_mut().zip(&g) {
            for (m, g) in m.iter_mut().zip(gradient) {
                *m += g * dv;
            }
        }
    }
    if b_bar {
        let mean = mean.map(|m| m.map(|m| m / volume));
        add_point(&mut k, &mean, lame.lambda * volume, 0.0);
    }
    Some(k)
}

fn add_point<const N: usize, const D: usize>(
    k: &mut Stiffness<N, D>,
    g: &[[f64; D]; N],
    lambda: f64,
    mu: f64,
) {
    for a in 0..N {
        for b in 0..N {
            let dot = dot(&g[a], &g[b]);
            for i in 0..D {
                for j in 0..D {
                    let shear = g[a][j] * g[b][i] + if i == j { dot } else { 0.0 };
                    k[a][b][(i, j)] += lambda * g[a][i] * g[b][j] + mu * shear;
                }
            }
        }
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Gradients in physical coordinates and the determinant of the Jacobian; `None` if it is not positive.
pub fn physical_gradient<const N: usize, const D: usize>(
    nodes: &[[f64; D]; N],
    reference: &[[f64; D]; N],
) -> Option<([[f64; D]; N], f64)> {
    let mut jacobian = [[0.0; D]; D];
    for (node, g) in nodes.iter().zip(reference) {
        for i in 0..D {
            for j in 0..D {
                jacobian[i][j] += node[i] * g[j];
            }
        }
    }
    let cofactors = cofactors(&jacobian);
    let det = dot(&jacobian[0], &cofactors[0]);
    if det.is_nan() || det <= 0.0 {
        return None;
    }
    let gradients = reference.map(|g| std::array::from_fn(|i| dot(&g, &cofactors[i]) / det));
    Some((gradients, det))
}

/// Cofactors of a matrix of two or three rows: its inverse is their transpose over the determinant.
fn cofactors<const D: usize>(m: &[[f64; D]; D]) -> [[f64; D]; D] {
    debug_assert!(D == 2 || D == 3, "elements are plane or solid");
    let mut cofactors = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..D {
            cofactors[i][j] = if D == 2 {
                let minor = m[1 - i][1 - j];
                if i == j { minor } else { -minor }
            } else {
                let (k, l) = ((i + 1) % D, (i + 2) % D);
                let (p, q) = ((j + 1) % D, (j + 2) % D);
                m[k][p] * m[l][q] - m[k][q] * m[l][p]
            };
        }
    }
    cofactors
}

#[cfg(test)]
mod tests;
