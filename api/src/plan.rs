//! The plan of a specification: what would be simulated and why.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::spec::Spec;

/// Whether an effect is simulated, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct PlannedEffect {
    /// Whether it is simulated.
    pub simulated: bool,
    /// Why, in words.
    pub reason: String,
}

/// What would be simulated.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Plan {
    /// Effects by name.
    pub effects: BTreeMap<String, PlannedEffect>,
    /// Closed-form figures of the unworn contact, by name with unit.
    pub estimates: BTreeMap<String, f64>,
    /// What a user should know about the numbers of this scene: where the source contradicts itself.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A plan with the specification it belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlanDocument {
    /// The resolved specification.
    pub spec: Spec,
    /// What would be simulated.
    pub plan: Plan,
}
