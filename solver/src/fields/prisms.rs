//! Stresses of prisms: evaluated at the corners of every element, the hexahedra with their incompatible modes, and averaged over the elements
//! of a node by volume. Between held ends they are those of the plane elements.

use super::Stress;
use crate::element::{Element, Hex8, Wedge6, incompatible, physical_gradient};
use crate::law::elastic::Lame;
use crate::mesh::{Prism, PrismMesh};

/// Amplitudes of incompatible modes and their gradients at a corner.
type Modes = ([[f64; 3]; 3], [[f64; 3]; 3]);

/// Stresses at all nodes of a mesh, section by section, of displacements u there, mm.
pub(super) fn stress(mesh: &PrismMesh<'_>, lame: Lame, b_bar: bool, u: &[[f64; 3]]) -> Vec<Stress> {
    let nodes = mesh.coordinates();
    let mut sums = vec![(Stress::default(), 0.0); nodes.len()];
    for prism in mesh.prisms() {
        match &prism {
            Prism::Hexahedron(n) => {
                let (places, u) = (n.map(|n| nodes[n]), n.map(|n| u[n]));
                let amplitudes = incompatible::hex_amplitudes(&places, lame, b_bar, &u);
                let amplitudes = amplitudes.unwrap_or_default();
                add::<Hex8, 8>(&mut sums, n, &places, &u, lame, |corner, det| {
                    let gradients =
                        incompatible::mode_gradients::<Hex8, 8, 3>(&places, corner, det)?;
                    Some((amplitudes, gradients))
                });
            }
            Prism::Wedge(n) => {
                let (places, u) = (n.map(|n| nodes[n]), n.map(|n| u[n]));
                add::<Wedge6, 6>(&mut sums, n, &places, &u, lame, |_, _| None);
            }
        }
    }
    sums.iter()
        .map(|(s, weight)| Stress {
            xx: s.xx / weight,
            yy: s.yy / weight,
            zz: s.zz / weight,
            xy: s.xy / weight,
            xz: s.xz / weight,
            yz: s.yz / weight,
        })
        .collect()
}

/// Adds an element's corner stresses to the sums of its nodes, weighted by the Jacobian there.
fn add<E: Element<N, 3>, const N: usize>(
    sums: &mut [(Stress, f64)],
    prism: &[usize; N],
    places: &[[f64; 3]; N],
    u: &[[f64; 3]; N],
    lame: Lame,
    modes: impl Fn([f64; 3], f64) -> Option<Modes>,
) {
    for (corner, node) in E::CORNERS.iter().zip(prism) {
        // A corner of a hexahedron that has become a wedge has no gradient; its neighbours speak for it.
        let Some((gradients, det)) = physical_gradient(places, &E::gradient(*corner)) else {
            continue;
        };
        let mut strain = [[0.0; 3]; 3];
        let (amplitudes, of_modes) = modes(*corner, det).unwrap_or_default();
        let terms = u.iter().zip(&gradients);
        for (u, g) in terms.chain(amplitudes.iter().zip(&of_modes)) {
            for i in 0..3 {
                for j in 0..3 {
                    strain[i][j] += 0.5 * (u[i] * g[j] + u[j] * g[i]);
                }
            }
        }
        let volumetric = lame.lambda * (strain[0][0] + strain[1][1] + strain[2][2]);
        let (sum, weight) = &mut sums[*node];
        let shear = 2.0 * lame.mu;
        sum.xx += det * (volumetric + shear * strain[0][0]);
        sum.yy += det * (volumetric + shear * strain[1][1]);
        sum.zz += det * (volumetric + shear * strain[2][2]);
        sum.xy += det * shear * strain[0][1];
        sum.xz += det * shear * strain[0][2];
        sum.yz += det * shear * strain[1][2];
        *weight += det;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::elastic::Elastic;
    use crate::mesh::{ColumnMesh, NodePlanes};

    /// Displacements that are linear in space have one strain in all prisms between unlike surfaces, hexahedra and wedges.
    #[test]
    fn an_even_strain_has_its_stress_at_all_nodes() {
        let planes = NodePlanes::new(2.0, 4, 1.5);
        let x = vec![0.0, 1.0, 2.0, 2.5];
        let heights = |at: f64| vec![-at, 0.9, 1.0, 0.0];
        let mesh = ColumnMesh::new(x, heights(0.0), 1.0, vec![0.0, 0.5, 1.0]);
        let sections: Vec<ColumnMesh> = (planes.z().iter())
            .map(|z| mesh.with_surface(heights(*z)))
            .collect();
        let prisms = PrismMesh::new(sections.iter().collect(), &planes);
        let lame = Lame::from(Elastic {
            youngs_modulus_mpa: 1000.0,
            poisson_ratio: 0.25,
        });
        let gradient = [[1e-3, 2e-3, -3e-3], [0.0, -2e-3, 4e-3], [5e-3, 1e-3, 3e-3]];
        let displaced = |place: [f64; 3]| {
            let along = |row: [f64; 3]| row[0] * place[0] + row[1] * place[1] + row[2] * place[2];
            gradient.map(along)
        };
        let u: Vec<[f64; 3]> = prisms.coordinates().into_iter().map(displaced).collect();
        let strain = |i: usize, j: usize| 0.5 * (gradient[i][j] + gradient[j][i]);
        let volumetric = lame.lambda * (strain(0, 0) + strain(1, 1) + strain(2, 2));
        let expected = |i: usize, j: usize| {
            2.0 * lame.mu * strain(i, j) + if i == j { volumetric } else { 0.0 }
        };
        for s in stress(&prisms, lame, false, &u) {
            for (found, i, j) in [
                (s.xx, 0, 0),
                (s.yy, 1, 1),
                (s.zz, 2, 2),
                (s.xy, 0, 1),
                (s.xz, 0, 2),
                (s.yz, 1, 2),
            ] {
                assert!((found - expected(i, j)).abs() < 1e-11, "{s:?}");
            }
        }
    }
}
