//! What goes from one computed cycle to the next.

use serde::{Deserialize, Serialize};

use super::jump::JumpControl;
use super::{Checks, Neutral, path};
use crate::condensation::Operators;
use crate::contact::{ContactError, ContactState};

/// Why a cycle could not be integrated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CycleError {
    /// An increment failed however often it was halved.
    #[error(
        "cycle {cycle}, increment {increment}: {source}; the increment was halved {halvings} times"
    )]
    Increment {
        /// Physical cycles done before.
        cycle: u64,
        /// Increment within the cycle.
        increment: usize,
        /// How often it was halved.
        halvings: u32,
        /// What went wrong in the smallest one.
        source: ContactError,
    },
}

/// Everything that the next cycle depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleState {
    /// Physical cycles done.
    pub cycle: u64,
    /// Contact at the end of the last increment.
    pub contact: ContactState,
    /// Vertical worn depth at the receptacle's contact nodes, mm.
    pub receptacle_depth: Vec<f64>,
    /// Vertical worn depth at the slider's contact nodes, mm.
    pub slider_depth: Vec<f64>,
    /// Imposed sliding distance, mm.
    pub sliding_distance: f64,
    /// Accumulated integral of p |slip|, N/mm mm.
    pub friction_path: f64,
    /// Accumulated energy dissipated by friction, mJ/mm.
    pub energy: f64,
    /// Jump control.
    pub jump: JumpControl,
    /// Contact at the last passage of the neutral position.
    pub neutral: Neutral,
    /// Mean half-width of the contact over the last computed cycle, mm.
    pub mean_half_width: f64,
    /// Computed cycles, increments, and the most increments in one cycle.
    pub computed_cycles: u64,
    /// Increments solved.
    pub increments: u64,
    /// The most increments that a cycle was cut into.
    pub most_increments: usize,
    /// Worst residuals so far.
    pub checks: Checks,
}

impl CycleState {
    /// The unworn, unloaded state.
    pub fn start(operators: &Operators) -> Self {
        Self {
            cycle: 0,
            contact: ContactState::untouched(operators),
            receptacle_depth: vec![0.0; operators.receptacle.x.len()],
            slider_depth: vec![0.0; operators.slider.x.len()],
            sliding_distance: 0.0,
            friction_path: 0.0,
            energy: 0.0,
            jump: JumpControl::default(),
            neutral: Neutral::default(),
            mean_half_width: 0.0,
            computed_cycles: 0,
            increments: 0,
            most_increments: 0,
            checks: Checks::default(),
        }
    }

    /// The half-width that increments are laid for, mm.
    pub(super) fn followed_half_width(&self) -> f64 {
        path::followed(self.mean_half_width, self.neutral.half_width)
    }
}
