//! State that the cycles of one motion leave for later ones of the same motion: a mission returns to its blocks.

use serde::{Deserialize, Serialize};

use super::{CycleState, Neutral, Skew, WarmStarts};
use crate::schedule::jump::{self, JumpControl};

/// Jump control and contact of a motion.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MotionHistory {
    pub(crate) jump: JumpControl,
    warm_starts: WarmStarts,
    neutral: Neutral,
    mean_half_width: f64,
    skew: Skew,
}

impl CycleState {
    /// Takes out what belongs to the present motion; the contact stays as it is.
    pub(crate) fn take_motion_history(&mut self) -> MotionHistory {
        self.forget_last_cycle();
        MotionHistory {
            jump: std::mem::take(&mut self.jump),
            warm_starts: std::mem::take(&mut self.warm_starts),
            neutral: self.neutral,
            mean_half_width: self.mean_half_width,
            skew: std::mem::take(&mut self.skew),
        }
    }

    /// Continues with what cycles of the next motion have left.
    pub(crate) fn continue_motion(&mut self, history: MotionHistory) {
        let MotionHistory {
            jump,
            warm_starts,
            neutral,
            mean_half_width,
            skew,
        } = history;
        self.jump = jump;
        self.warm_starts = warm_starts;
        self.neutral = neutral.with_load(self.neutral.load);
        self.mean_half_width = mean_half_width;
        self.skew = skew;
    }

    /// Another motion has worn the surfaces since the last cycle of this one, so that a groove is extrapolated from new ones.
    fn forget_last_cycle(&mut self) {
        self.wear_of_strokes = Default::default();
        self.friction_per_cycle = 0.0;
        self.energy_per_cycle = 0.0;
        self.loss_of_load = 0.0;
    }
}

/// Estimated relative error of the worn depth by the jumps of a state and of the motions that are not under way.
pub(crate) fn mean_error<'a>(
    state: &'a CycleState,
    histories: impl Iterator<Item = &'a MotionHistory>,
) -> f64 {
    let earlier = histories.map(|history| &history.jump);
    jump::mean_error([&state.jump].into_iter().chain(earlier))
}
