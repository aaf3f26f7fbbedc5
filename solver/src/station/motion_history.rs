//! State that the cycles of one motion leave in each section for later ones of the same motion: a mission returns to its blocks.

use serde::{Deserialize, Serialize};

use super::state::{LineState, StationState};
use crate::cycle::{Neutral, WarmStarts};
use crate::schedule::jump::{self, JumpControl};

/// Jump control and contact of a motion in each section.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LineHistory {
    stations: Vec<StationHistory>,
}

/// The same in a section.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct StationHistory {
    jump: JumpControl,
    warm_starts: WarmStarts,
    neutral: Neutral,
    mean_half_width: f64,
}

impl LineState {
    /// Takes out what belongs to the present motion; the contacts stay as they are.
    pub(crate) fn take_motion_history(&mut self) -> LineHistory {
        let stations = self.sections.stations.iter_mut();
        LineHistory {
            stations: stations.map(StationState::take_history).collect(),
        }
    }

    /// Continues with what cycles of the next motion have left.
    pub(crate) fn continue_motion(&mut self, history: LineHistory) {
        let stations = self.sections.stations.iter_mut();
        for (station, history) in stations.zip(history.stations) {
            station.continue_motion(history);
        }
    }

    /// Estimated relative error of the worn depth by the jumps so far, with those of the motions that are not under way: that of the worst
    /// station.
    pub(crate) fn mean_jump_error(&self, histories: &[&LineHistory]) -> f64 {
        let stations = self.sections.stations.iter().enumerate();
        let errors = stations.map(|(number, station)| {
            let earlier = histories.iter();
            let earlier = earlier.filter_map(|history| history.stations.get(number));
            let controls = earlier.map(|station| &station.jump);
            jump::mean_error([&station.jump].into_iter().chain(controls))
        });
        errors.fold(0.0, f64::max)
    }
}

impl StationState {
    fn take_history(&mut self) -> StationHistory {
        StationHistory {
            jump: std::mem::take(&mut self.jump),
            warm_starts: std::mem::take(&mut self.warm_starts),
            neutral: self.neutral,
            mean_half_width: self.mean_half_width,
        }
    }

    fn continue_motion(&mut self, history: StationHistory) {
        let StationHistory {
            jump,
            warm_starts,
            neutral,
            mean_half_width,
        } = history;
        self.jump = jump;
        self.warm_starts = warm_starts;
        self.neutral = neutral.with_load(self.neutral.load);
        self.mean_half_width = mean_half_width;
    }
}
