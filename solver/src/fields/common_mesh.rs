//! A mesh on the spines of several meshes of a body: what is known at the nodes of one of them at the nodes of all.
//!
//! Between two spines of its own mesh a field is linear at the same share of the height, as its elements are there. Where a mesh has all spines,
//! nothing changes.

use std::collections::BTreeSet;

use crate::mesh::ColumnMesh;
use crate::model::{BodyModel, ZoneModel};

/// Spines of a body, and the unworn mesh on them.
pub(super) struct CommonMesh {
    spines: Vec<usize>,
    pub(super) mesh: ColumnMesh,
}

/// Where a spine lies in another mesh: between two of its spines, at a share of the way from the first to the second.
struct Between {
    left: usize,
    right: usize,
    share: f64,
}

impl CommonMesh {
    /// The mesh on all spines of these zones of a body; bodies of the same mesh lines share it.
    pub(super) fn of<'a>(body: &BodyModel, zones: impl Iterator<Item = &'a ZoneModel>) -> Self {
        let layout = &body.layout;
        let spines: BTreeSet<usize> = zones
            .flat_map(|zone| zone.zone.spines.iter().copied())
            .collect();
        let spines: Vec<usize> = spines.into_iter().collect();
        let at = |values: &[f64]| spines.iter().map(|&i| values[i]).collect();
        let mesh = ColumnMesh::new(
            at(&layout.x),
            at(&layout.heights()),
            layout.far_y,
            layout.fractions.clone(),
        );
        Self { spines, mesh }
    }

    /// Spines among those of the body.
    pub(super) fn spines(&self) -> &[usize] {
        &self.spines
    }

    /// The mesh with the body's surface at other heights, mm.
    pub(super) fn with_surface(&self, surface_y: &[f64]) -> ColumnMesh {
        let at = self.spines.iter().map(|&i| surface_y[i]).collect();
        self.mesh.with_surface(at)
    }

    /// Values at the nodes of a zone's mesh at the nodes of this one; `between` is that at a share of the way from one to another.
    pub(super) fn values<T: Clone>(
        &self,
        zone: &ZoneModel,
        values: &[T],
        between: impl Fn(&T, &T, f64) -> T,
    ) -> Vec<T> {
        if zone.zone.spines == self.spines {
            return values.to_vec();
        }
        let mut found = Vec::with_capacity(self.mesh.nodes());
        for (i, &spine) in self.spines.iter().enumerate() {
            let at = self.place(zone, spine);
            let nodes = self.mesh.far_node(i) - self.mesh.surface_node(i) + 1;
            for layer in 0..nodes {
                let left = &values[zone.mesh.node(at.left, layer)];
                let right = &values[zone.mesh.node(at.right, layer)];
                found.push(if at.left == at.right {
                    left.clone()
                } else {
                    between(left, right, at.share)
                });
            }
        }
        found
    }

    fn place(&self, zone: &ZoneModel, spine: usize) -> Between {
        let own = &zone.zone.spines;
        let right = own.partition_point(|&other| other < spine);
        if own[right] == spine {
            return Between {
                left: right,
                right,
                share: 0.0,
            };
        }
        // Every mesh has the first and the last spine of its body.
        let left = right - 1;
        let x = zone.mesh.x();
        let number = self.spines.partition_point(|&other| other < spine);
        Between {
            left,
            right,
            share: (self.mesh.x()[number] - x[left]) / (x[right] - x[left]),
        }
    }
}
