//! Summary of the result.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::outcome::{Outcome, Phase};
use crate::plan::Decision;
use crate::results::quantity::quantities;
use crate::results::{BlockSummary, ContactResistance, LifeEntry, LineStation};
use crate::spec::DerivedMotion;

/// Temperature at the hottest place of a contact, °C.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ContactTemperature {
    /// Mean over the distance of the last computed cycle; of a mission that of its last block.
    pub r#final: f64,
    /// The highest at any moment of the run.
    pub highest: f64,
}

quantities! {
    /// One side's wear at the end.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct SideSummary {
        /// Largest worn depth, mm.
        pub max_depth_mm: f64 => "deepest wear" [1e3, "µm"],
        /// Worn area of the section, mm^2.
        pub worn_area_mm2: f64 => "worn area" [1e6, "µm²"],
        /// k P' `s_total`, mm^2; null where the law has no such identity.
        pub ideal_area_mm2: Option<f64>,
        /// Half the width of the scar, mm.
        pub scar_half_width_mm: f64 => "scar half-width" [1e3, "µm"],
        /// Worn volume, mm^3; absent of a section.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub worn_volume_mm3: Option<f64> => "worn volume" [1e9, "µm³"],
        /// Specific wear rate times the sliding work, k F `s_total` in gross slip, mm^3; absent of a section, and where the law has no
        /// such identity.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub ideal_volume_mm3: Option<f64>,
    }
}

quantities! {
    /// A contact of finite width, at the end.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct ContactExtent {
        /// Normal force, N.
        pub load_n: f64 => "force" [1.0, "N"],
        /// Half the length of the contact across the sliding direction, mm.
        pub contact_half_length_across_mm: f64 => "contact half-length across" [1e3, "µm"],
        /// Accumulated energy dissipated by friction in the whole contact, mJ.
        pub dissipated_energy_mj: f64 => "dissipated energy of the whole contact" [1.0, "mJ"],
    }
}

quantities! {
    /// The unworn, loaded state.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct Initial {
        /// Highest pressure, MPa.
        pub peak_pressure_mpa: f64 => "peak pressure" [1.0, "MPa"],
        /// Half the width of the contact, mm.
        pub contact_half_width_mm: f64 => "contact half-width" [1e3, "µm"],
    }
}

/// Estimated relative error of a quantity, and the parts that cause it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EstimatedError {
    /// The whole error.
    pub relative: f64,
    /// The part of the mesh.
    pub mesh: f64,
    /// The part of the increments.
    pub increments: f64,
    /// The part of the cycle jumps.
    pub jump: f64,
    /// The part of the effects that the plan skips.
    #[serde(default)]
    pub effects: f64,
}

/// Estimated errors at the end, each that of the worse side.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EstimatedErrors {
    /// Of the largest worn depth.
    pub worn_depth: EstimatedError,
    /// Of half the width of the scar.
    pub scar_half_width: EstimatedError,
    /// Of the worn area.
    pub worn_area: EstimatedError,
    /// Of the highest contact pressure.
    pub peak_pressure: EstimatedError,
    /// Of the resistance of the contact; null where it is not computed.
    #[serde(default)]
    pub contact_resistance: Option<EstimatedError>,
}

quantities! {
    /// Accuracy that was reached, and the resolution that the settings led to.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct AccuracyReached {
        /// Estimated relative error of worn depth or scar width, whichever is larger; without `errors` that of worn depth
        /// made by cycle jumps.
        pub estimated_relative_error: f64 => "estimated error" [1e2, "%"],
        /// Estimated errors; null where they were not asked for, or a coarse companion has no solution.
        #[serde(default)]
        pub errors: Option<EstimatedErrors>,
        /// Elements along the receptacle's contact surface.
        pub contact_elements: u64,
        /// Surface element size under the contact, mm.
        pub contact_element_mm: f64,
        /// Increments a computed cycle (the most that were used).
        pub increments_per_cycle: u32,
        /// Computed cycles.
        pub computed_cycles: u64,
        /// Contact increments that were solved.
        pub increments: u64,
        /// How often the operators were rebuilt after the first time.
        pub relocations: u64,
    }
}

quantities! {
    /// Cost of the run.
    #[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct Cost {
        /// Wall-clock seconds.
        pub wall_s: f64,
        /// Processor seconds of the solving process.
        pub cpu_s: f64 => "processor time" [1.0, "s"],
        /// Wall-clock seconds by phase.
        pub phases_s: BTreeMap<Phase, f64>,
        /// Largest resident memory of the solving process, MiB.
        pub peak_memory_mb: f64,
        /// Degrees of freedom of both meshes.
        pub dofs: u64,
        /// Factorizations of the contact's systems, in the delivered run.
        #[serde(default)]
        pub factorizations: u64,
        /// Unknowns of these systems, summed.
        #[serde(default)]
        pub unknowns: u64,
        /// Entries of the bodies' responses that were computed for these systems.
        #[serde(default)]
        pub response_entries: u64,
    }
}

/// An effect that the plan had skipped and the run has required. The run returned to this cycle and continued with it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EffectCalledFor {
    /// Name of the effect.
    pub effect: String,
    /// Physical cycles done before it was switched on.
    pub cycle: u64,
    /// How much it would have changed the outputs after the next computed cycle, relative; null where that has no bound or the
    /// contact has no solution without it.
    pub value: Option<f64>,
}

/// Worst residuals of the run, each relative to its scale.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Checks {
    /// |sum of vertical forces - load| / load.
    pub force_balance: f64,
    /// The same with the normals of the surfaces as worn at that moment, at the reported positions: the solve takes those
    /// of the beginning of the cycle, without the step that a pass wears. Null in results of earlier versions.
    #[serde(default)]
    pub force_balance_present_normals: Option<f64>,
    /// |worn area of the profile - k times the integral of p |slip|| / worn area.
    pub worn_area: f64,
    /// Largest violation of gap >= 0, p >= 0, p gap = 0, over its scale.
    pub complementarity: f64,
    /// Largest excess of |q| over mu p, over the peak pressure.
    pub friction_cone: f64,
    /// Largest |Q| / (mu P).
    pub friction_use: f64,
}

quantities! {
    /// Summary of the result.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
    pub struct Summary {
        /// Physical cycles done; of a continuous motion the parts of its distance, a hundred thousandth each, as in the column `cycle` of its
        /// histories.
        pub cycles_done: u64,
        /// Accumulated imposed sliding distance, mm.
        pub sliding_distance_mm: f64,
        /// Why it ended.
        pub outcome: Outcome,
        /// The receptacle's wear.
        pub receptacle: SideSummary,
        /// The slider's wear.
        pub slider: SideSummary,
        /// Highest contact pressure at the end, MPa.
        pub peak_pressure_mpa: f64 => "peak pressure" [1.0, "MPa"],
        /// Half the width of the contact at the end, mm.
        pub contact_half_width_mm: f64 => "contact half-width" [1e3, "µm"],
        /// The unworn, loaded state.
        pub initial: Initial,
        /// Accumulated energy dissipated by friction, mJ per mm of depth.
        pub dissipated_energy_mj_per_mm: f64 => "dissipated energy" [1.0, "mJ/mm"],
        /// The whole contact; absent of a section. What is else per mm of depth is that of the middle section of a point contact, and the mean
        /// along a line.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub extent: Option<ContactExtent>,
        /// The sections along a line at the end, in their order; absent of another contact.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub stations: Vec<LineStation>,
        /// Resolution that the accuracy settings led to.
        pub accuracy: AccuracyReached,
        /// Cost of the run.
        pub cost: Cost,
        /// Worst residuals of the run.
        pub checks: Checks,
        /// The decision about each effect at the end; `plan.effects` has their numbers.
        #[serde(default)]
        pub effects: BTreeMap<String, Decision>,
        /// Effects that the plan had skipped and the run has required.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub effects_called_for: Vec<EffectCalledFor>,
        /// Life by each criterion of the specification, in their order.
        #[serde(default)]
        pub life: Vec<LifeEntry>,
        /// Resistance of the contact, mOhm; absent where the force on the contact, a resistivity or a hardness is not known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub contact_resistance_mohm: Option<ContactResistance>,
        /// Temperature of the contact, °C; absent where neither friction nor the current heats it in the run.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub contact_temperature_c: Option<ContactTemperature>,
        /// How the motion was derived from a vibration, a thermal cycle or an insertion.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub motion: Option<DerivedMotion>,
        /// Wear of each block of a mission, in their order.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub mission: Vec<BlockSummary>,
        /// Warnings about the result, in words: errors beyond the tolerance.
        #[serde(default)]
        pub warnings: Vec<String>,
    }
}
