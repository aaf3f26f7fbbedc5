//! State of the run of a section.
//!
//! Meshes and operators are not part of it. The mesh of a run is the unworn one with its surfaces moved to the depths
//! at which the operators were last built, and the operators follow from the mesh; building both again from these
//! depths gives the same bits, so a resumed run gives the same bits as an undisturbed one.

use serde::{Deserialize, Serialize};

use super::mismatch::CheckpointMismatch;
use crate::ale;
use crate::cycle::CycleState;
use crate::mesh::MeshError;
use crate::model::{Model, ZONE_WIDENING};
use crate::sides::{Side, Sides};

/// State of a section between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SectionState {
    /// State that the next cycle depends on.
    pub(crate) cycle_state: CycleState,
    /// Worn depths at which the operators were last rebuilt, mm.
    pub(crate) built: Option<Sides<Vec<f64>>>,
    pub(crate) relocations: u64,
    /// Factor by which zones of fine elements are wider than the scene's.
    pub(crate) widened: f64,
}

impl SectionState {
    /// The model at this checkpoint, from an earlier one.
    pub(crate) fn model(&self, earlier: &Model) -> Result<Model, MeshError> {
        let model = match &self.built {
            None => earlier.clone(),
            Some(depth) => ale::relocate(earlier, depth)?,
        };
        model.with_zones_widened(self.widened)
    }

    /// Records that zones must be wider.
    pub(crate) fn widen(&mut self) {
        self.widened *= ZONE_WIDENING;
    }

    /// Records that the operators are rebuilt at the present depths.
    pub(crate) fn relocated(&mut self) {
        self.built = Some(self.cycle_state.depth.clone());
        self.relocations += 1;
    }

    /// Checks that it belongs to a run on this unworn model.
    pub(crate) fn check(&self, unworn: &Model) -> Result<(), CheckpointMismatch> {
        let contact = &self.cycle_state.contact;
        let nodes = |side| unworn.bodies.of(side).contact_x().len();
        let slave = unworn.interface.slave;
        for found in [
            contact.status.len(),
            contact.pressure.len(),
            contact.shear.len(),
        ] {
            check_nodes(slave, found, nodes(slave))?;
        }
        for side in Side::BOTH {
            let built = self.built.as_ref();
            for found in [
                contact.force.of(side).len() / 2,
                self.cycle_state.depth.of(side).len(),
                built.map_or(nodes(side), |depth| depth.of(side).len()),
            ] {
                check_nodes(side, found, nodes(side))?;
            }
        }
        Ok(())
    }
}

fn check_nodes(side: Side, found: usize, nodes: usize) -> Result<(), CheckpointMismatch> {
    if found == nodes {
        return Ok(());
    }
    let body = side.name();
    Err(CheckpointMismatch::Nodes { body, found, nodes })
}
