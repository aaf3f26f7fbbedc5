//! Run between two computed cycles: what is computed from the state of its contact, operators among it, is computed again.

use serde::{Deserialize, Serialize};

use super::earlier::EarlierRuns;
use super::section::SectionState;
use crate::cycle::MotionHistory;
use crate::effects::Crossing;
use crate::electrical::ElectricalState;
use crate::extruded::{ExtrudedHistory, ExtrudedState};
use crate::point::{PointHistory, PointState};
use crate::record::{Compared, Initial, Life};
use crate::scene::{Motion, Scene};
use crate::schedule::mission_state::MissionState;
use crate::station::{LineHistory, LineState};

/// A run between two computed cycles: the state of its contact, and the history that a motion leaves where a run has several.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run<S, H> {
    pub(crate) state: S,
    /// State of its mission, if it has one.
    pub(crate) mission: Option<MissionState<H>>,
    pub(crate) initial: Initial,
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

/// A run of a section.
pub type SectionRun = Run<SectionState, MotionHistory>;

/// A run of a point contact.
pub type PointRun = Run<PointState, PointHistory>;

/// A run of a contact along a line.
pub type LineRun = Run<LineState, LineHistory>;

/// A run of extruded bodies.
pub type ExtrudedRun = Run<ExtrudedState, ExtrudedHistory>;

impl<S, H> Run<S, H> {
    /// Restores an earlier state for effects that were skipped.
    pub(crate) fn go_back(&mut self, to: S, required: Vec<Crossing>) {
        self.state = to;
        self.crossings.extend(required);
    }

    /// The present block of its mission; the first one without a mission.
    pub(crate) fn block(&self) -> usize {
        let mission = self.mission.as_ref();
        mission.map_or(0, |mission| mission.position.block)
    }

    /// The motion that the slider has to leave before the next cycle.
    pub(crate) fn motion_left(&self, scene: &Scene) -> Option<Motion> {
        let left = self.mission.as_ref()?.left?;
        let block = scene.mission.as_ref()?.blocks.get(left)?;
        Some(block.motion)
    }

    /// Returns `true` if the present block of its mission is done after so many cycles.
    pub(crate) fn is_block_done(&self, cycle: u64) -> bool {
        let mission = self.mission.as_ref();
        mission.is_some_and(|mission| mission.is_block_done(cycle))
    }

    /// Records that the slider is where the cycles of the present block begin.
    pub(crate) fn motion_changed(&mut self) {
        if let Some(mission) = &mut self.mission {
            mission.left = None;
        }
    }

    /// Returns `true` if the state after so many cycles can be compared with that of another run: one that takes other rounds of a
    /// mission together has worn its blocks in another order before they are whole.
    pub(crate) fn is_comparable(&self, scene: &Scene, cycle: u64) -> bool {
        let (mission, repeated) = (self.mission.as_ref(), scene.mission.as_ref());
        let repeats = repeated.is_some_and(|mission| mission.rounds() > 1);
        mission.is_none_or(|mission| !repeats || mission.is_whole(scene, cycle))
    }
}
