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
    /// Radius of the spot of real contact, um.
    pub spot_radius_um: f64,
}

/// Constriction resistance of one spot of real contact, mOhm: without films, without the way through the rest of the parts, and at
/// the deepest point of each side.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ContactResistance {
    /// Of the unworn contact.
    pub initial: f64,
    /// At the end of the run.
    pub r#final: f64,
    /// Its parts at the end.
    pub parts: ResistanceParts,
}
