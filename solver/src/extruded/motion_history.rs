//! State that the cycles of one motion leave for later ones of the same motion: a mission returns to its blocks.

use serde::{Deserialize, Serialize};

use super::state::ExtrudedState;
use crate::cycle::{Neutral, WarmStarts};
use crate::schedule::jump::{self, JumpControl};

/// Jump control of a motion, and its contact in each node plane.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ExtrudedHistory {
    jump: JumpControl,
    mean_half_width: f64,
    planes: Vec<(Neutral, WarmStarts)>,
}

impl ExtrudedState {
    /// Takes out what belongs to the present motion; the contacts stay as they are.
    pub(crate) fn take_motion_history(&mut self) -> ExtrudedHistory {
        let planes = self.sections.planes.states.iter_mut();
        ExtrudedHistory {
            jump: std::mem::take(&mut self.sections.common.jump),
            planes: planes
                .map(|plane| (plane.neutral, std::mem::take(&mut plane.warm_starts)))
                .collect(),
            mean_half_width: self.sections.planes.mean_half_width,
        }
    }

    /// Continues with what cycles of the next motion have left.
    pub(crate) fn continue_motion(&mut self, history: ExtrudedHistory) {
        let planes = &mut self.sections.planes;
        for (plane, (neutral, warm_starts)) in planes.states.iter_mut().zip(history.planes) {
            plane.neutral = neutral.with_load(plane.neutral.load);
            plane.warm_starts = warm_starts;
        }
        planes.mean_half_width = history.mean_half_width;
        self.sections.common.jump = history.jump;
    }

    /// Estimated relative error of the worn depth by the jumps so far, with those of the motions that are not under way.
    pub(crate) fn mean_jump_error(&self, histories: &[&ExtrudedHistory]) -> f64 {
        let earlier = histories.iter().map(|history| &history.jump);
        jump::mean_error([&self.sections.common.jump].into_iter().chain(earlier))
    }
}
