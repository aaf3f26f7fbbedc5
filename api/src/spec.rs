//! The specification of a job, as users write it.
//!
//! Only `system.kind` is required; everything else has a default from the system's preset. Variants are selected by
//! `kind` or `law` within one flat object, so that every fault has its JSON pointer.

mod count;
mod environment;
mod interface;
mod life;
mod load;
mod materials;
mod mission;
mod model;
mod motion;
mod plating;
mod read;
mod real_contact;
mod settings;
mod system;
mod unique;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::string_enum;
pub use crate::enum_value::{EnumValue, StringEnum};
pub use environment::Environment;
pub use interface::{
    Friction, FrictionAtCycle, FrictionAtDose, FrictionLaw, Interface, Sides, WearCourse, WearLaw,
    WearLawName,
};
pub use life::{Criterion, CriterionKind, LifeSettings, Part};
pub use load::{Load, LoadKind};
pub use materials::{Material, MaterialProperties, Materials};
pub use mission::{MissionBlock, MissionOrder};
pub use model::{Dimension, Ends, Model, ModelPreset, RingMotion, Top};
pub use motion::{DerivedMotion, Drive, FourierTerm, Motion, MotionKind, PsdPoint, Waveform};
pub use plating::{PlatingLayer, Platings};
pub use read::{ParseError, pointer_token, read};
pub use real_contact::{Film, SpotDeformation, Spots};
pub use settings::{Accuracy, CycleJump, Output, Overrides, Preset, Stop, Switch};
pub use system::{System, SystemKind};

string_enum! {
    /// Provenance of a value of a resolved specification.
    Provenance {
        /// Given by the user.
        Given = "given",
        /// Stated by the source of the preset.
        Source = "source",
        /// Typical of such parts or materials, from the literature.
        Typical = "typical",
        /// Assumed; replace it by a measured value if it matters.
        Assumed = "assumed",
    }
}

/// The specification of a job.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Spec {
    /// Display name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Labels, for filtering.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "unique::map"
    )]
    pub labels: BTreeMap<String, String>,
    /// The contact system and its dimensions.
    pub system: System,
    /// Which dimensions of the contact are simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<Model>,
    /// Materials of both parts.
    #[serde(default)]
    pub materials: Materials,
    /// Friction and wear.
    #[serde(default)]
    pub interface: Interface,
    /// Layers over the base materials.
    #[serde(default, skip_serializing_if = "Platings::is_absent")]
    pub plating: Platings,
    /// The normal load.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
    /// Surroundings of the contact.
    #[serde(default)]
    pub environment: Environment,
    /// The imposed motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// Number of cycles of a reciprocating motion.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub cycles: Option<u64>,
    /// Blocks of different motions, one after the other, instead of `motion` and `cycles`; one history over all of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mission: Vec<MissionBlock>,
    /// How often the blocks of a mission are done.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub repeat: Option<u64>,
    /// Order of the cycles of a mission.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<MissionOrder>)]
    pub order: Option<EnumValue<MissionOrder>>,
    /// Physical effects by name.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "unique::map"
    )]
    #[schema(value_type = BTreeMap<String, Switch>)]
    pub effects: BTreeMap<String, EnumValue<Switch>>,
    /// Accuracy.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// Recorded output.
    #[serde(default)]
    pub output: Output,
    /// Conditions that end the run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stop: Vec<Stop>,
    /// Life of the contact.
    #[serde(default)]
    pub life: LifeSettings,
    /// Provenance of each value, by JSON pointer. Filled in by the service; accepted and replaced when submitted,
    /// so that a resolved specification can be submitted again.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub provenance: BTreeMap<String, Provenance>,
}
