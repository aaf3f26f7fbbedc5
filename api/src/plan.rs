//! The plan of a specification: simulated effects with reasons, and estimates.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

use crate::enum_value::string_enum;
use crate::results::BlockExtent;
use crate::spec::{Criterion, DerivedMotion, Provenance, Spec};

string_enum! {
    /// A decision about an effect.
    Decision {
        /// The scene requires it.
        Simulated = "simulated",
        /// The scene does not call for it, or has nothing to simulate.
        Skipped = "skipped",
        /// Simulated because it is switched on.
        ForcedOn = "forced_on",
        /// Left out because it is switched off.
        ForcedOff = "forced_off",
        /// The scene requires it and the specification lacks what it needs, which the reason names.
        InputMissing = "input_missing",
    }
}

/// The decision about an effect, with the numbers that it was made by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlannedEffect {
    /// Name of the effect.
    pub effect: String,
    /// The decision.
    pub decision: Decision,
    /// Definition of the value, in words and symbols.
    #[serde(default)]
    pub indicator: String,
    /// How much the effect changes the outputs, relative: the larger value of the unworn contact and of the estimated end.
    /// Absent where there is nothing to simulate or the change has no bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Largest value of an effect that is skipped. Absent where there is nothing to simulate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f64>,
    /// Outputs that the effect changes.
    #[serde(default)]
    pub changes: Vec<String>,
    /// Reason, in words.
    pub reason: String,
}

/// Reads effects as a list, or as the map by name that plans were stored with.
fn effects<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PlannedEffect>, D::Error> {
    #[derive(Deserialize)]
    struct Stored {
        simulated: bool,
        reason: String,
    }
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Effects {
        List(Vec<PlannedEffect>),
        Map(BTreeMap<String, Stored>),
    }
    Ok(match Effects::deserialize(deserializer)? {
        Effects::List(effects) => effects,
        Effects::Map(effects) => effects
            .into_iter()
            .map(|(effect, stored)| PlannedEffect {
                effect,
                decision: if stored.simulated {
                    Decision::Simulated
                } else {
                    Decision::Skipped
                },
                indicator: String::new(),
                value: None,
                threshold: None,
                changes: Vec::new(),
                reason: stored.reason,
            })
            .collect(),
    })
}

/// A warning about a value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Warning {
    /// JSON pointer (RFC 6901) of the field.
    // Plans were stored with the name that faults have.
    #[serde(alias = "pointer")]
    pub field: String,
    /// The unusual value, and the one that is likely meant.
    pub detail: String,
}

/// The life by a criterion, estimated in closed form before anything is solved: of laws whose rate is the same in every state,
/// under a constant load, in gross slip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlannedLife {
    /// The criterion, with its side.
    pub criterion: Criterion,
    /// The side, `slider` or `receptacle`.
    pub side: String,
    /// Cycles of the motion until it is reached, whatever the run's cycles are; null for a continuous motion, and where it
    /// is never reached.
    pub cycles: Option<f64>,
    /// Repetitions of a mission until then; absent without a mission.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repetitions: Option<f64>,
    /// Imposed sliding distance until then, mm.
    pub sliding_distance_mm: Option<f64>,
    /// The same beside the rated matings. Absent for a worn depth, where no rating is published, and where it is never reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rated: Option<RatedLife>,
}

/// Matings until an exposure beside the rated ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RatedLife {
    /// Estimated matings until the exposure: passes in and out over the wipe.
    pub matings: f64,
    /// Matings that connectors of this kind are rated for.
    pub rated_matings: f64,
    /// Matings over the rated ones; below 1 the plating is through within the rated life.
    pub matings_over_rated: f64,
    /// Provenance of the rated matings.
    pub rated_matings_provenance: Provenance,
    /// Whose rating it is.
    pub rating: String,
    /// Path of the contact in one direction of a mating, mm: that of the motion if it is a mating.
    pub wipe_mm: f64,
    /// Provenance of the wipe.
    pub wipe_provenance: Provenance,
}

/// A plan: simulated effects with reasons, and estimates.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Plan {
    /// The decision about each effect.
    #[serde(deserialize_with = "effects")]
    pub effects: Vec<PlannedEffect>,
    /// Values by name with unit: closed-form results for the unworn contact, and estimates of the solve: unknowns,
    /// memory, output, computed cycles, increments, and processor seconds: likely (`cpu_s`) and enough in nine of ten cases
    /// (`cpu_s_most`), also if the run restarts because it is outside of its tolerance. Both are absent until the machine is
    /// calibrated and if that fails.
    pub estimates: BTreeMap<String, f64>,
    /// How the motion was derived from a vibration, a thermal cycle or an insertion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<DerivedMotion>,
    /// Blocks of a mission over all repetitions, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mission: Vec<BlockExtent>,
    /// Lives by the criteria of the specification, and beside the rated matings of its kind.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub life: Vec<PlannedLife>,
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
    /// Plan.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_of_earlier_versions_have_a_map_of_effects() {
        let stored = r#"{"effects":{"friction":{"simulated":true,"reason":"a"},
            "slider_wear":{"simulated":false,"reason":"b"}},"estimates":{}}"#;
        let plan: Plan = serde_json::from_str(stored).expect("it is a plan");
        let decisions = plan.effects.iter();
        let decisions: Vec<_> = decisions
            .map(|effect| {
                (
                    effect.effect.as_str(),
                    effect.decision,
                    effect.reason.as_str(),
                )
            })
            .collect();
        assert_eq!(
            decisions,
            [
                ("friction", Decision::Simulated, "a"),
                ("slider_wear", Decision::Skipped, "b")
            ]
        );
        let again = serde_json::to_string(&plan).expect("it is written");
        assert_eq!(serde_json::from_str::<Plan>(&again).expect("a plan"), plan);
    }
}
