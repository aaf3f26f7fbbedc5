//! The slip that a vibration, a thermal cycle or an insertion imposes on a contact.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A reciprocating motion that was derived from another kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DerivedMotion {
    /// Amplitude of the displacement of both parts relative to each other, mm, at most half of their clearance; of a random vibration that
    /// of an even motion with the same path.
    pub relative_amplitude_mm: f64,
    /// Part of it that the tangential deflection of the contact's arm takes up without slip, mm.
    pub held_amplitude_mm: f64,
    /// Amplitude that is imposed on the contact, mm.
    pub slip_amplitude_mm: f64,
    /// True if the contact does not slip at all.
    pub sticks: bool,
    /// Acceleration from which on the contact slips, multiples of 9.806 65 m/s^2; absent where no sine accelerates it, or
    /// the clearance ends its displacement before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slips_from_g: Option<f64>,
    /// Frequency of the cycles, Hz.
    pub frequency_hz: f64,
    /// How it was derived, with its numbers.
    pub reason: String,
}
