//! Record of one computed cycle.

use serde::{Deserialize, Serialize};

use crate::contact::{ContactState, Pair};
use crate::schedule::increments::Position;

/// Contact at the neutral position on the way to +x.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Neutral {
    /// Normal load, N/mm.
    pub load: f64,
    /// Highest pressure, MPa.
    pub peak_pressure: f64,
    /// Half-width of the contact, mm.
    pub half_width: f64,
}

impl Neutral {
    pub(super) fn of(contact: &ContactState, pair: &Pair<'_>) -> Self {
        let x = &pair.slave().x;
        Self {
            load: contact.load(&pair.interface),
            peak_pressure: contact.peak_pressure(),
            half_width: contact.half_width(x),
        }
    }
}

/// Friction force over displacement during one cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrictionLoop {
    /// Imposed displacement, mm.
    pub displacement_mm: Vec<f64>,
    /// Force of the slider on the receptacle along x, N/mm.
    pub tangential_force_n_per_mm: Vec<f64>,
}

impl FrictionLoop {
    /// Rotates the closed loop to begin after its first `steps` increments.
    pub(super) fn begin_at(&mut self, steps: usize) {
        self.displacement_mm.rotate_left(steps);
        self.tangential_force_n_per_mm.rotate_left(steps);
    }
}

/// Record of one computed cycle besides the state.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CycleRecord {
    /// Friction force over the imposed displacement.
    pub friction_loop: FrictionLoop,
    /// Contact at the leftmost, neutral and rightmost position.
    pub contacts: Vec<(Position, ContactState)>,
}
