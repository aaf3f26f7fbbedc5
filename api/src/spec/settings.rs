//! Effects, accuracy, output and stop conditions.

use serde::de::{Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use utoipa::ToSchema;

use super::{Criterion, CriterionKind, Part, count};
use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Selects whether an effect is simulated.
    Switch {
        /// Decided by the plan.
        Auto = "auto",
        /// Simulated.
        On = "on",
        /// Not simulated.
        Off = "off",
    }
}

string_enum! {
    /// Named tolerances.
    Preset {
        /// 10 %.
        Draft = "draft",
        /// 2 %.
        Standard = "standard",
        /// 0.3 %.
        Fine = "fine",
        /// The mesh and increments of the source's first plane model, for comparison: 8 elements along the block.
        SourceCoarse = "source_coarse",
        /// The mesh and increments of its finer plane model: 16 elements along the block.
        SourceFine = "source_fine",
    }
}

/// Accuracy: a preset or a tolerance.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Accuracy {
    /// A named tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Preset>)]
    pub preset: Option<EnumValue<Preset>>,
    /// Relative tolerance on worn depth and scar width.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Fixed settings, which are otherwise chosen from the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overrides: Option<Overrides>,
    /// True if coarse companions estimate the run's errors, for about a quarter of its time, and a run whose depth or area is
    /// outside of the tolerance restarts, finer, for up to about four times its time (default true).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimate_errors: Option<bool>,
}

/// Fixed settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Overrides {
    /// Surface element size under the contact, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_element_mm: Option<f64>,
    /// Increments per computed cycle.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub increments_per_cycle: Option<u32>,
    /// Physical cycles per computed cycle.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<serde_json::Value>)]
    pub cycle_jump: Option<CycleJump>,
    /// `line`, `ring`: sections along the line with both ends: those of half of it, or of all of a line with a tilt.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub stations: Option<u32>,
}

/// Physical cycles per computed cycle: `"adaptive"` or a count.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CycleJump {
    /// Chosen from the tolerance.
    Adaptive,
    /// Fixed.
    Fixed(u64),
    /// Another text than `adaptive`; refused later, together with all other faults.
    Unknown(String),
}

impl Serialize for CycleJump {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Adaptive => serializer.serialize_str("adaptive"),
            Self::Fixed(count) => serializer.serialize_u64(*count),
            Self::Unknown(text) => serializer.serialize_str(text),
        }
    }
}

struct CycleJumpVisitor;

impl Visitor<'_> for CycleJumpVisitor {
    type Value = CycleJump;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("\"adaptive\" or a count of cycles")
    }

    fn visit_str<E>(self, text: &str) -> Result<CycleJump, E> {
        Ok(if text == "adaptive" {
            CycleJump::Adaptive
        } else {
            CycleJump::Unknown(text.to_owned())
        })
    }

    fn visit_u64<E>(self, count: u64) -> Result<CycleJump, E> {
        Ok(CycleJump::Fixed(count))
    }

    fn visit_i64<E: serde::de::Error>(self, count: i64) -> Result<CycleJump, E> {
        u64::try_from(count)
            .map(CycleJump::Fixed)
            .map_err(|_| E::invalid_value(Unexpected::Signed(count), &self))
    }

    fn visit_f64<E: serde::de::Error>(self, count: f64) -> Result<CycleJump, E> {
        count::integer(count)
            .map(CycleJump::Fixed)
            .ok_or_else(|| E::invalid_value(Unexpected::Float(count), &self))
    }
}

impl<'de> Deserialize<'de> for CycleJump {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CycleJumpVisitor)
    }
}

/// Recorded output.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Output {
    /// Positions on the receptacle at which the worn depth is recorded, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations_mm: Option<Vec<f64>>,
    /// Cycles at which profile, pressure and friction loop are recorded.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional_list"
    )]
    pub snapshots_at_cycles: Option<Vec<u64>>,
    /// Sliding distances at which they are recorded, mm; for continuous motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub snapshots_at_distance_mm: Option<Vec<f64>>,
    /// True to record the fields in the bodies at the snapshots; of `plane_strain`, `line`, `ring` and `extruded`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fields: Option<bool>,
}

/// A condition that ends the run: `worn_depth_mm` alone, or a criterion of a life.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Stop {
    /// The largest worn depth of either side has reached this value, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worn_depth_mm: Option<f64>,
    /// The kind of a criterion; see `Criterion` for its fields.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<CriterionKind>)]
    pub kind: Option<EnumValue<CriterionKind>>,
    /// The part; either where absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Part>)]
    pub side: Option<EnumValue<Part>>,
    /// The layer that is exposed, the outermost one being 1.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub layer: Option<u64>,
    /// The exposed part of the scar, -.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fraction: Option<f64>,
    /// The depth, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mm: Option<f64>,
    /// The resistance, mOhm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mohm: Option<f64>,
}

impl From<Criterion> for Stop {
    fn from(criterion: Criterion) -> Self {
        let Criterion {
            kind,
            side,
            layer,
            fraction,
            mm,
            mohm,
        } = criterion;
        Self {
            worn_depth_mm: None,
            kind: Some(kind),
            side,
            layer,
            fraction,
            mm,
            mohm,
        }
    }
}
