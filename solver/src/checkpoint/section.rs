//! Checkpoints of the run of a section.
//!
//! Meshes and operators are not part of it. The mesh of a run is the unworn one with its surfaces moved to the depths
//! at which the operators were last built, and the operators follow from the mesh; building both again from these
//! depths gives the same bits, so a resumed run gives the same bits as an undisturbed one.

use serde::{Deserialize, Serialize};

use super::earlier::EarlierRuns;
use super::mismatch::CheckpointMismatch;
use crate::ale;
use crate::cycle::{CycleState, MissionState};
use crate::effects::Crossing;
use crate::electrical::ElectricalState;
use crate::mesh::MeshError;
use crate::model::{Model, ZONE_WIDENING};
use crate::record::{Compared, Initial, Life};
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// A run of a section between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SectionRun {
    pub(crate) state: CycleState,
    /// State of its mission, if it has one.
    pub(crate) mission: Option<MissionState>,
    pub(crate) initial: Initial,
    /// Worn depths at which the operators were last rebuilt, mm.
    pub(crate) built: Option<Sides<Vec<f64>>>,
    pub(crate) relocations: u64,
    /// Factor by which zones of fine elements are wider than the scene's.
    pub(crate) widened: f64,
    /// Skipped effects that the run has required.
    pub(crate) crossings: Vec<Crossing>,
    /// Histories that the run's error is estimated by.
    pub(crate) compared: Compared,
    /// Life by the criteria of the scene.
    pub(crate) life: Life,
    /// Resistance of the contact, and what the next one depends on.
    pub(crate) electrical: ElectricalState,
    /// Earlier runs of this scene, for error control.
    pub(crate) earlier: EarlierRuns,
}

impl SectionRun {
    /// The model at this checkpoint, from an earlier one.
    pub(crate) fn model(&self, earlier: &Model) -> Result<Model, MeshError> {
        let model = match &self.built {
            None => earlier.clone(),
            Some(depth) => ale::relocate(earlier, depth)?,
        };
        model.with_zones_widened(self.widened)
    }

    /// Restores an earlier state for effects that were skipped.
    pub(crate) fn go_back(&mut self, to: CycleState, required: Vec<Crossing>) {
        self.state = to;
        self.crossings.extend(required);
    }

    /// The present block of its mission; the first one without a mission.
    pub(crate) fn block(&self) -> usize {
        let mission = self.mission.as_ref();
        mission.map_or(0, |mission| mission.position.block)
    }

    /// The block whose motion the slider has to leave before the next cycle.
    pub(crate) fn block_left(&self) -> Option<usize> {
        self.mission.as_ref().and_then(|mission| mission.left)
    }

    /// Returns `true` if the present block of its mission is done.
    pub(crate) fn is_block_done(&self) -> bool {
        let mission = self.mission.as_ref();
        mission.is_some_and(|mission| mission.is_block_done(&self.state))
    }

    /// Records that the slider is where the cycles of the present block begin.
    pub(crate) fn motion_changed(&mut self) {
        if let Some(mission) = &mut self.mission {
            mission.left = None;
        }
    }

    /// Returns `true` if the state can be compared with that of another run after as many cycles: one that takes other rounds of a
    /// mission together has worn its blocks in another order before they are whole.
    pub(crate) fn is_comparable(&self, scene: &Scene) -> bool {
        let (mission, repeated) = (self.mission.as_ref(), scene.mission.as_ref());
        let repeats = repeated.is_some_and(|mission| mission.rounds() > 1);
        mission.is_none_or(|mission| !repeats || mission.is_whole(scene, &self.state))
    }

    /// Records that zones must be wider.
    pub(crate) fn widen(&mut self) {
        self.widened *= ZONE_WIDENING;
    }

    /// Records that the operators are rebuilt at the present depths.
    pub(crate) fn relocated(&mut self) {
        self.built = Some(self.state.depth.clone());
        self.relocations += 1;
    }

    /// Checks that it belongs to a run of this many cycles on this unworn model.
    pub(crate) fn check(&self, unworn: &Model, cycles: u64) -> Result<(), CheckpointMismatch> {
        if self.state.cycle > cycles {
            return Err(CheckpointMismatch::Beyond {
                cycle: self.state.cycle,
                cycles,
            });
        }
        let contact = &self.state.contact;
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
                self.state.depth.of(side).len(),
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
