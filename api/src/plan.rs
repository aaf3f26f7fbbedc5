//! The plan of a specification: simulated effects with reasons, and estimates.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::spec::Spec;

/// Whether an effect is simulated, with the reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct PlannedEffect {
    /// Whether it is simulated.
    pub simulated: bool,
    /// Reason, in words.
    pub reason: String,
}

/// A warning about a value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Warning {
    /// JSON pointer (RFC 6901) of the field.
    // Plans were stored with the name that faults have.
    #[serde(alias = "pointer")]
    pub field: String,
    /// What is unusual, and what is likely meant.
    pub detail: String,
}

/// A plan: simulated effects with reasons, and estimates.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Plan {
    /// Effects by name.
    pub effects: BTreeMap<String, PlannedEffect>,
    /// Values by name with unit: closed-form results for the unworn contact, and estimates of the solve: unknowns,
    /// memory, output, computed cycles, increments, and processor seconds (`cpu_s`), which are absent until the machine
    /// is calibrated and if that fails.
    pub estimates: BTreeMap<String, f64>,
    /// Values that were probably written in another unit than that of their field. They are accepted as they are.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// Contradictions in the source of the presets that concern this specification.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A plan with the specification it belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlanDocument {
    /// The resolved specification.
    pub spec: Spec,
    /// Its plan.
    pub plan: Plan,
    /// Calibration of the machine that `cpu_s` refers to; absent if it is not calibrated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineFigures>,
}

/// Calibration of a machine, measured once by a few small solves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MachineFigures {
    /// The measured program: version and build time.
    pub program: String,
    /// Processor seconds of a contact increment with 30 solved nodes.
    pub increment_s: f64,
    /// Power of the number of solved nodes in the time of an increment.
    pub increment_power: f64,
    /// Processor seconds of a condensation per (number of unknowns)^1.2.
    pub condensation_dof_s: f64,
    /// Processor seconds of a condensation per (number of surface nodes)^3.
    pub condensation_surface_s: f64,
}
