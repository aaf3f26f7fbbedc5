//! Surroundings of the contact.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Surroundings of the contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Environment {
    /// Temperature, °C.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature_c: Option<f64>,
    /// The current through the contact, A; its heat is not considered if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub current_a: Option<f64>,
    /// Frequency of the current, Hz; a direct one if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
}
