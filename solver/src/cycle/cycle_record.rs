//! What one computed cycle recorded.

use serde::{Deserialize, Serialize};

use crate::contact::{ContactState, Pair};
use crate::history::{FrictionLoop, Position};

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
        let x = &pair.operators.receptacle.x;
        Self {
            load: contact.load(&pair.interface),
            peak_pressure: contact.peak_pressure(),
            half_width: contact.half_width(x),
        }
    }
}

/// What one computed cycle recorded besides the state.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CycleRecord {
    /// Friction force over the imposed displacement.
    pub friction_loop: FrictionLoop,
    /// Contact at the leftmost, neutral and rightmost position.
    pub contacts: Vec<(Position, ContactState)>,
}
