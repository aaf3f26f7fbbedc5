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
    /// Middle, mm.
    pub middle: f64,
    /// Mean coefficient of friction over the contact, -.
    pub friction: f64,
}

impl Neutral {
    pub(crate) fn of(contact: &ContactState, pair: &Pair<'_>) -> Self {
        let x = &pair.slave().x;
        Self {
            load: contact.load(&pair.interface),
            peak_pressure: contact.peak_pressure(),
            half_width: contact.half_width(x),
            middle: contact.middle(x),
            friction: contact.friction,
        }
    }

    /// The contact under the load of a present height: that of an earlier cycle had another one.
    pub(crate) fn with_load(self, load: f64) -> Self {
        Self { load, ..self }
    }
}

/// Friction force over displacement during one cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrictionLoop {
    /// Imposed displacement, mm.
    pub displacement_mm: Vec<f64>,
    /// Force of the slider on the receptacle along x, N/mm.
    pub tangential_force_n_per_mm: Vec<f64>,
    /// Tangential force of the whole contact, N; empty of a section.
    pub tangential_force_n: Vec<f64>,
}

impl FrictionLoop {
    /// Appends points of displacement and force.
    pub(super) fn extend(&mut self, points: &[(f64, f64)]) {
        for (displacement, force) in points {
            self.displacement_mm.push(*displacement);
            self.tangential_force_n_per_mm.push(*force);
        }
    }

    /// Rotates the closed loop to begin after its first `points`.
    pub(crate) fn begin_at(&mut self, points: usize) {
        self.displacement_mm.rotate_left(points);
        self.tangential_force_n_per_mm.rotate_left(points);
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
