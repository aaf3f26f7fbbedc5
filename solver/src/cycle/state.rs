//! State of the integration between two computed cycles.

use serde::{Deserialize, Serialize};

use super::{Checks, Neutral, Skew, WarmStarts};
use crate::condensation::Operators;
use crate::contact::{ContactError, ContactState, Work};
use crate::schedule::jump::JumpControl;
use crate::sides::{Side, Sides};

/// Failure of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CycleError {
    /// An increment failed after all halvings.
    #[error(
        "cycle {cycle}, increment {increment}: {source}; the increment was halved {halvings} times"
    )]
    Increment {
        /// Physical cycles done before.
        cycle: u64,
        /// Increment within the cycle.
        increment: usize,
        /// Number of halvings.
        halvings: u32,
        /// Failure of the smallest increment.
        source: ContactError,
    },
    /// Friction or the current heats the contact beyond the melting temperature of a surface.
    #[error(
        "after cycle {cycle}: friction and current heat the contact to {temperature_c:.0} °C; a material of it melts at {melting_c:.0} °C"
    )]
    Melts {
        /// Physical cycles done before.
        cycle: u64,
        /// Temperature of the contact, °C.
        temperature_c: f64,
        /// Melting temperature, °C.
        melting_c: f64,
    },
}

impl CycleError {
    /// Returns `true` if the cycle can be computed again with wider zones of fine elements.
    pub(crate) fn needs_wider_zones(self) -> bool {
        matches!(self, Self::Increment { source, .. } if source.needs_wider_zones())
    }
}

/// Everything that the next cycle depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleState {
    /// Physical cycles done.
    pub cycle: u64,
    /// Contact at the end of the last increment.
    pub contact: ContactState,
    /// Vertical worn depth at the contact nodes, mm.
    pub depth: Sides<Vec<f64>>,
    /// Imposed sliding distance, mm.
    pub sliding_distance: f64,
    /// Accumulated integrals of the wear rates over contact and time, mm^2.
    pub worn_area: Sides<f64>,
    /// Accumulated energy dissipated by friction, mJ/mm.
    pub energy: f64,
    /// Jump control.
    pub jump: JumpControl,
    /// Those that the last computed cycle leaves for the next.
    pub warm_starts: WarmStarts,
    /// Contact at the last passage of the neutral position.
    pub neutral: Neutral,
    /// Mean half-width of the contact over the last computed cycle, mm.
    pub mean_half_width: f64,
    /// Computed cycles.
    pub computed_cycles: u64,
    /// Work of all contact solves.
    pub work: Work,
    /// Most increments in one cycle.
    pub most_increments: usize,
    /// Wear of the receptacle per cycle in both strokes of the last computed one at its contact nodes, mm; none before the
    /// first.
    pub(crate) wear_of_strokes: [Vec<f64>; 2],
    /// Mean coefficient of friction in the same, -; the largest where places differ in it.
    pub(crate) friction_per_cycle: f64,
    /// Energy dissipated per cycle in the same, mJ/mm.
    pub(crate) energy_per_cycle: f64,
    /// Relative loss of the load per cycle since the one before.
    pub(crate) loss_of_load: f64,
    /// Skew of the surfaces toward the last pass.
    pub(crate) skew: Skew,
    /// Mean temperature rise of the contact by friction and current in the last computed cycle, K.
    pub(crate) temperature_rise_k: f64,
    /// Largest temperature rise at any moment so far, K.
    pub(crate) hottest_rise_k: f64,
    /// Resistance of the last contact without that of the bodies, which the current heats, mOhm.
    pub(crate) constriction_mohm: f64,
    /// Worst residuals so far.
    pub checks: Checks,
}

impl CycleState {
    /// The unworn, unloaded state.
    pub fn start(operators: &Operators, slave: Side) -> Self {
        Self {
            cycle: 0,
            contact: ContactState::untouched(operators, slave),
            depth: operators.as_ref().map(|body| vec![0.0; body.x.len()]),
            sliding_distance: 0.0,
            worn_area: Sides::default(),
            energy: 0.0,
            jump: JumpControl::default(),
            warm_starts: WarmStarts::default(),
            neutral: Neutral::default(),
            mean_half_width: 0.0,
            computed_cycles: 0,
            work: Work::default(),
            most_increments: 0,
            wear_of_strokes: Default::default(),
            friction_per_cycle: 0.0,
            energy_per_cycle: 0.0,
            loss_of_load: 0.0,
            skew: Skew::default(),
            temperature_rise_k: 0.0,
            hottest_rise_k: 0.0,
            constriction_mohm: 0.0,
            checks: Checks::default(),
        }
    }
}
