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
    /// Figures by name with unit: of the unworn contact in closed form; and what the solve is expected to take: unknowns,
    /// memory, output, computed cycles, increments, and `cpu_s`, processor seconds, absent while the machine is not
    /// measured yet or not measurable.
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
    /// The machine that `cpu_s` is expected of; absent if it is not measured yet or not measurable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineFigures>,
}

/// What a machine takes for the engine's work, measured once by a few small solves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MachineFigures {
    /// The program that was measured: its version and when it was built.
    pub program: String,
    /// Processor seconds of a contact increment that watches 30 nodes.
    pub increment_s: f64,
    /// The power of the watched nodes that an increment's time grows with.
    pub increment_power: f64,
    /// Processor seconds of a condensation for each unknown to the power 1.2.
    pub condensation_dof_s: f64,
    /// Processor seconds of a condensation for each surface node to the power 3.
    pub condensation_surface_s: f64,
}
