//! Elements of a section whose displacements vary along the line as waves:
//!   `u_x` = U cos(k s),  `u_y` = V cos(k s),  `u_s` = W sin(k s),
//! s the length along the line at the section's x = 0. On a ring of radius R, r = R + x is the distance from its axis, n = k R the number
//! of waves around it, and with c = 1/r, m = n/r
//!   `e_x` = dU/dx,  `e_y` = dV/dy,  `e_s` = c U + m W,
//!   `g_xy` = dU/dy + dV/dx,  `g_xs` = dW/dx - c W - m U,  `g_ys` = dW/dy - m V
//! (Timoshenko and Goodier 1970, section 116; the amplitudes of a Fourier series in the angle as in Wilson 1965). A straight line has c = 0 and
//! m = k. Volumes are those per length at x = 0, r/R of the section's area. Both cos^2 and sin^2 have the mean 1/2, which the
//! loads have as well.
//!
//! Limiting case: k = 0 on a straight line is plane strain, with W apart.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::{Element, Stiffness, physical_gradient};
use crate::law::elastic::Lame;

/// Waves along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Waves {
    /// k, 1/mm.
    pub per_mm: f64,
    /// R, mm; `None` of a straight line.
    pub radius_mm: Option<f64>,
}

/// Strains `e_x`, `e_y`, `e_s`, `g_xy`, `g_xs`, `g_ys` per displacement of a node.
type Strains = SMatrix<f64, 6, 3>;

/// Blocks K_ab between the nodes a and b of an element, U, V and W of each, N/mm per mm of the line; `None` if the element is inverted, or
/// reaches over the axis of the ring.
pub(crate) fn harmonic_stiffness<E: Element<N, 2>, const N: usize>(
    nodes: &[[f64; 2]; N],
    lame: Lame,
    b_bar: bool,
    waves: Waves,
) -> Option<Stiffness<N, 3>> {
    let mut k = [[Matrix3::zeros(); N]; N];
    let mut mean = [SVector::<f64, 3>::zeros(); N];
    let mut volume = 0.0;
    for &(xi, weight) in E::QUADRATURE {
        let (gradients, det) = physical_gradient(nodes, &E::gradient(xi))?;
        let shape = E::shape(xi);
        let x: f64 = shape.iter().zip(nodes).map(|(n, node)| n * node[0]).sum();
        let (curvature, stretch) = match waves.radius_mm {
            None => (0.0, 1.0),
            Some(radius) if radius + x > 0.0 => (1.0 / (radius + x), (radius + x) / radius),
            Some(_) => return None,
        };
        let dv = det * weight * stretch;
        volume += dv;
        let per_mm = waves.per_mm / stretch;
        let strains: [Strains; N] =
            std::array::from_fn(|a| strains(shape[a], gradients[a], curvature, per_mm));
        let dilatation = strains.map(|b| dilatation(&b));
        let lambda = if b_bar { 0.0 } else { lame.lambda };
        for a in 0..N {
            mean[a] += dilatation[a] * dv;
            for b in 0..N {
                let shear = strains[a].transpose() * weighted(&strains[b], lame.mu);
                k[a][b] += (shear + dilatation[a] * dilatation[b].transpose() * lambda) * dv;
            }
        }
    }
    if b_bar {
        for a in 0..N {
            for b in 0..N {
                k[a][b] += mean[a] * mean[b].transpose() * (lame.lambda / volume);
            }
        }
    }
    Some(k)
}

/// Strains per displacement of a node with a shape function and its gradient, where the line has a curvature and waves per mm.
fn strains(shape: f64, [dx, dy]: [f64; 2], curvature: f64, waves: f64) -> Strains {
    let (c, m) = (curvature * shape, waves * shape);
    let rows = [
        [dx, 0.0, 0.0],
        [0.0, dy, 0.0],
        [c, 0.0, m],
        [dy, dx, 0.0],
        [-m, 0.0, dx - c],
        [0.0, -m, dy],
    ];
    Strains::from_fn(|row, column| rows[row][column])
}

/// Change of volume per displacement of a node.
fn dilatation(strains: &Strains) -> SVector<f64, 3> {
    (strains.row(0) + strains.row(1) + strains.row(2)).transpose()
}

/// Stresses of the strains without those of the change of volume.
fn weighted(strains: &Strains, mu: f64) -> Strains {
    let mut stresses = strains * mu;
    for mut row in stresses.row_iter_mut().take(3) {
        row *= 2.0;
    }
    stresses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{Quad4, Tri3, stiffness};
    use crate::law::elastic::Elastic;

    const QUAD: [[f64; 2]; 4] = [[-0.1, 0.0], [0.2, 0.05], [0.25, 0.3], [-0.05, 0.2]];
    const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [0.3, 0.02], [0.1, 0.2]];
    const RADIUS: f64 = 0.5;

    fn lame() -> Lame {
        let copper = Elastic {
            youngs_modulus_mpa: 117_000.0,
            poisson_ratio: 0.34,
        };
        copper.into()
    }

    /// Largest nodal force under displacements of (U, V, W) at each node, over the largest entry of the stiffness.
    fn force<E: Element<N, 2>, const N: usize>(
        nodes: &[[f64; 2]; N],
        waves: Waves,
        b_bar: bool,
        displacement: impl Fn([f64; 2]) -> [f64; 3],
    ) -> f64 {
        let k = harmonic_stiffness::<E, N>(nodes, lame(), b_bar, waves);
        let k = k.expect("the element is not inverted");
        let u = nodes.map(|node| SVector::from(displacement(node)));
        let forces = k.map(|row| {
            let sum = row.iter().zip(&u).map(|(block, u)| block * u);
            sum.fold(SVector::zeros(), |sum: SVector<f64, 3>, f| sum + f)
        });
        let largest = k.iter().flatten().map(Matrix3::amax);
        let most = forces.iter().map(SVector::amax).fold(0.0, f64::max);
        most / largest.fold(0.0, f64::max)
    }

    fn ring(n: f64) -> Waves {
        Waves {
            per_mm: n / RADIUS,
            radius_mm: Some(RADIUS),
        }
    }

    /// Rigid motions of a ring: along its axis, about it, sideways, and about a diameter.
    #[test]
    fn rigid_motions_of_a_ring_need_no_force() {
        for b_bar in [false, true] {
            let forces = [
                force::<Quad4, 4>(&QUAD, ring(0.0), b_bar, |_| [0.0, 1.0, 0.0]),
                force::<Quad4, 4>(&QUAD, ring(0.0), b_bar, |[x, _]| [0.0, 0.0, RADIUS + x]),
                force::<Quad4, 4>(&QUAD, ring(1.0), b_bar, |_| [1.0, 0.0, -1.0]),
                force::<Quad4, 4>(&QUAD, ring(1.0), b_bar, |[x, y]| [-y, RADIUS + x, y]),
                force::<Tri3, 3>(&TRIANGLE, ring(1.0), b_bar, |[x, y]| [-y, RADIUS + x, y]),
            ];
            assert!(forces.iter().all(|f| *f < 1e-14), "{forces:?}");
        }
        let bent = force::<Quad4, 4>(&QUAD, ring(2.0), false, |[x, y]| [-y, RADIUS + x, y]);
        assert!(bent > 1e-2);
    }

    #[test]
    fn no_waves_on_a_straight_line_are_plane_strain() {
        let none = Waves {
            per_mm: 0.0,
            radius_mm: None,
        };
        for b_bar in [false, true] {
            let k = harmonic_stiffness::<Quad4, 4>(&QUAD, lame(), b_bar, none);
            let k = k.expect("the element is not inverted");
            let plane = stiffness::<Quad4, 4, 2>(&QUAD, lame(), b_bar);
            let plane = plane.expect("the element is not inverted");
            for (row, plane) in k.iter().zip(&plane) {
                for (block, plane) in row.iter().zip(plane) {
                    let differs = block.fixed_view::<2, 2>(0, 0) - plane;
                    assert!(differs.amax() < 1e-9, "{differs}");
                    assert!(block[(0, 2)].abs() < 1e-9 && block[(2, 1)].abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn stiffness_is_symmetric_and_a_wide_ring_is_straight() {
        let straight = Waves {
            per_mm: 3.0,
            radius_mm: None,
        };
        let wide = Waves {
            radius_mm: Some(1e9),
            ..straight
        };
        let of = |waves| {
            harmonic_stiffness::<Quad4, 4>(&QUAD, lame(), false, waves)
                .expect("the element is not inverted")
        };
        let (straight, wide) = (of(straight), of(wide));
        for a in 0..4 {
            for b in 0..4 {
                assert!((straight[a][b] - straight[b][a].transpose()).amax() < 1e-9);
                assert!((straight[a][b] - wide[a][b]).amax() < 1e-2);
            }
        }
        let over_the_axis = Waves {
            per_mm: 1.0,
            radius_mm: Some(0.01),
        };
        assert!(harmonic_stiffness::<Quad4, 4>(&QUAD, lame(), false, over_the_axis).is_none());
    }
}
