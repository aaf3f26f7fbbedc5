//! Quadrilateral and hexahedron with incompatible modes: they bend without the parasitic shear of the bilinear elements.
//!
//! Inside the element, u + (1 - xi^2) a_1 + (1 - eta^2) a_2, and (1 - zeta^2) a_3 in three dimensions. The gradients of the modes are taken
//! with the Jacobian J_0 at the centre and scaled by det J_0 / det J, so that their mean vanishes and the patch test holds on any
//! element (Taylor, Beresford and Wilson 1976). The modes are eliminated in the element: K - K_ua K_aa^-1 K_au.
//!
//! Limiting case: where both ends of a prism have the same displacements in its plane and none along it, the third mode and the
//! components along the prism vanish, and the hexahedron is the quadrilateral times its length.

use nalgebra::{SMatrix, SVector};

use super::{Element, Hex8, Quad4, Stiffness, dot, physical_gradient, stiffness};
use crate::law::elastic::Lame;

/// Stiffness of a quadrilateral with incompatible modes, as [`stiffness`] returns it.
pub(crate) fn quad_stiffness(
    nodes: &[[f64; 2]; 4],
    lame: Lame,
    b_bar: bool,
) -> Option<Stiffness<4, 2>> {
    condensed::<Quad4, 4, 2, 8, 4>(nodes, lame, b_bar)
}

/// Stiffness of a hexahedron with incompatible modes, as [`stiffness`] returns it.
pub(crate) fn hex_stiffness(
    nodes: &[[f64; 3]; 8],
    lame: Lame,
    b_bar: bool,
) -> Option<Stiffness<8, 3>> {
    condensed::<Hex8, 8, 3, 24, 9>(nodes, lame, b_bar)
}

/// Amplitudes a_1 and a_2 of the modes of a quadrilateral under nodal displacements, mm; `None` if the element is inverted.
pub(crate) fn amplitudes(
    nodes: &[[f64; 2]; 4],
    lame: Lame,
    b_bar: bool,
    displacement: &[[f64; 2]; 4],
) -> Option<[[f64; 2]; 2]> {
    amplitudes_of::<Quad4, 4, 2, 8, 4>(nodes, lame, b_bar, displacement)
}

/// Amplitudes a_1, a_2 and a_3 of the modes of a hexahedron under nodal displacements, mm; `None` if the element is inverted.
pub(crate) fn hex_amplitudes(
    nodes: &[[f64; 3]; 8],
    lame: Lame,
    b_bar: bool,
    displacement: &[[f64; 3]; 8],
) -> Option<[[f64; 3]; 3]> {
    amplitudes_of::<Hex8, 8, 3, 24, 9>(nodes, lame, b_bar, displacement)
}

/// a = -K_aa^-1 K_au u of an element of `U` displacements with `A` amplitudes of modes.
fn amplitudes_of<
    E: Element<N, D>,
    const N: usize,
    const D: usize,
    const U: usize,
    const A: usize,
>(
    nodes: &[[f64; D]; N],
    lame: Lame,
    b_bar: bool,
    displacement: &[[f64; D]; N],
) -> Option<[[f64; D]; D]> {
    let (modes, coupling) = integrate::<E, N, D, U, A>(nodes, lame, b_bar)?;
    let u = SVector::<f64, U>::from_fn(|i, _| displacement[i / D][i % D]);
    let a = modes.try_inverse()? * coupling.transpose() * -u;
    Some(std::array::from_fn(|m| {
        std::array::from_fn(|d| a[D * m + d])
    }))
}

/// Stiffness of an element of `U` displacements with `A` amplitudes of modes, which are eliminated.
fn condensed<E: Element<N, D>, const N: usize, const D: usize, const U: usize, const A: usize>(
    nodes: &[[f64; D]; N],
    lame: Lame,
    b_bar: bool,
) -> Option<Stiffness<N, D>> {
    let mut k = stiffness::<E, N, D>(nodes, lame, b_bar)?;
    let (modes, coupling) = integrate::<E, N, D, U, A>(nodes, lame, b_bar)?;
    let eliminated = coupling * modes.try_inverse()? * coupling.transpose();
    for (a, row) in k.iter_mut().enumerate() {
        for (b, block) in row.iter_mut().enumerate() {
            *block -= eliminated.fixed_view::<D, D>(D * a, D * b);
        }
    }
    Some(k)
}

/// K_aa of the modes and K_ua of the nodes with them.
fn integrate<E: Element<N, D>, const N: usize, const D: usize, const U: usize, const A: usize>(
    nodes: &[[f64; D]; N],
    lame: Lame,
    b_bar: bool,
) -> Option<(SMatrix<f64, A, A>, SMatrix<f64, U, A>)> {
    debug_assert!(U == N * D && A == D * D, "a mode for each direction");
    // The mean volumetric strain of the modes is zero.
    let lambda = if b_bar { 0.0 } else { lame.lambda };
    let mut modes = SMatrix::<f64, A, A>::zeros();
    let mut coupling = SMatrix::<f64, U, A>::zeros();
    for &(xi, weight) in E::QUADRATURE {
        let (gradients, det) = physical_gradient(nodes, &E::gradient(xi))?;
        let mode = mode_gradients::<E, N, D>(nodes, xi, det)?;
        let product = |a: [f64; D], b: [f64; D]| {
            let dot = dot(&a, &b);
            SMatrix::<f64, D, D>::from_fn(|i, j| {
                let shear = a[j] * b[i] + if i == j { dot } else { 0.0 };
                (lambda * a[i] * b[j] + lame.mu * shear) * det * weight
            })
        };
        for (m, b) in mode.iter().enumerate() {
            for (n, a) in mode.iter().enumerate() {
                let mut block = modes.fixed_view_mut::<D, D>(D * n, D * m);
                block += product(*a, *b);
            }
            for (n, a) in gradients.iter().enumerate() {
                let mut block = coupling.fixed_view_mut::<D, D>(D * n, D * m);
                block += product(*a, *b);
            }
        }
    }
    Some((modes, coupling))
}

/// Gradients of the modes at a reference point, for the determinant of the Jacobian there; `None` if the element is
/// inverted.
pub(crate) fn mode_gradients<E: Element<N, D>, const N: usize, const D: usize>(
    nodes: &[[f64; D]; N],
    xi: [f64; D],
    det: f64,
) -> Option<[[f64; D]; D]> {
    // The gradients of the reference coordinates at the centre, from those of the shape functions.
    let reference = E::gradient([0.0; D]);
    let (physical, central) = physical_gradient(nodes, &reference)?;
    let along = |direction: usize| {
        let mut sum = [0.0; D];
        for (corner, g) in E::CORNERS.iter().zip(&physical) {
            for (s, g) in sum.iter_mut().zip(g) {
                *s += corner[direction] * g;
            }
        }
        sum
    };
    let scale = central / det;
    Some(std::array::from_fn(|d| {
        along(d).map(|g| -2.0 * xi[d] * scale * g)
    }))
}
