//! Contact resistance.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Parts of a contact's resistance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ResistanceParts {
    /// Constriction of the current in the slider and its layers, mOhm.
    pub slider_constriction: f64,
    /// Constriction in the receptacle and its layers, mOhm.
    pub receptacle_constriction: f64,
    /// Films on exposed metals, mOhm.
    #[serde(default)]
    pub film: f64,
    /// The way of the current through the slider to its far face, mOhm.
    #[serde(default)]
    pub slider_bulk: f64,
    /// The way through the receptacle, mOhm.
    #[serde(default)]
    pub receptacle_bulk: f64,
    /// Part of the contact's length on which a side shows a metal with a film, -.
    #[serde(default)]
    pub filmed_fraction: f64,
    /// Radius of a spot of real contact, um.
    pub spot_radius_um: f64,
}

/// Resistance of the contact at the neutral position, mOhm: the constriction at its spots of real contact, the films of the
/// specification and the way through both bodies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ContactResistance {
    /// Of the unworn contact.
    pub initial: f64,
    /// At the end of the run.
    pub r#final: f64,
    /// Parts at the end.
    pub parts: ResistanceParts,
}
