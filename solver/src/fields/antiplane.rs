//! Stresses of antiplane shear: mu grad w at the corners of every element, averaged over the elements of a node by area.

use crate::element::{Element, Quad4, Tri3, physical_gradient};
use crate::mesh::columns::Cell;
use crate::model::ZoneModel;

/// sigma_xz and sigma_yz at the nodes of a mesh, MPa, of displacements w along the line, mm.
pub(super) fn stress(zone: &ZoneModel, w: &[f64]) -> Vec<[f64; 2]> {
    if w.iter().all(|w| *w == 0.0) {
        return vec![[0.0; 2]; w.len()];
    }
    let nodes = zone.mesh.coordinates();
    let mut sums = vec![([0.0; 2], 0.0); nodes.len()];
    for cell in zone.mesh.cells() {
        match &cell {
            Cell::Quad(n) => add::<Quad4, 4>(&mut sums, n, &n.map(|n| nodes[n]), &n.map(|n| w[n])),
            Cell::Tri(n) => add::<Tri3, 3>(&mut sums, n, &n.map(|n| nodes[n]), &n.map(|n| w[n])),
        }
    }
    sums.iter()
        .map(|(sum, weight)| sum.map(|sum| zone.lame.mu * sum / weight))
        .collect()
}

fn add<E: Element<N, 2>, const N: usize>(
    sums: &mut [([f64; 2], f64)],
    cell: &[usize; N],
    places: &[[f64; 2]; N],
    w: &[f64; N],
) {
    for (corner, node) in E::CORNERS.iter().zip(cell) {
        // A corner of a quadrilateral that has become a triangle has no gradient; its neighbours speak for it.
        let Some((gradients, det)) = physical_gradient(places, &E::gradient(*corner)) else {
            continue;
        };
        let (sum, weight) = &mut sums[*node];
        for (w, gradient) in w.iter().zip(&gradients) {
            sum[0] += det * w * gradient[0];
            sum[1] += det * w * gradient[1];
        }
        *weight += det;
    }
}
