//! The imposed motion.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Kinds of motion.
    MotionKind {
        /// Back and forth around the neutral position, to +x first.
        Reciprocating = "reciprocating",
        /// The slider's surface runs past a contact that stays at one place of the receptacle.
        Continuous = "continuous",
    }
}

string_enum! {
    /// Shapes of a reciprocating motion over time.
    Waveform {
        /// A sine.
        Sine = "sine",
        /// Constant speed between the ends.
        Triangle = "triangle",
    }
}

string_enum! {
    /// Where the motion enters.
    Drive {
        /// The slider's top face is a rigid handle that carries the load and moves.
        SliderTop = "slider_top",
        /// Every slider node is moved along x (the source's drive).
        SliderBody = "slider_body",
        /// The handle is held and the receptacle's base moves.
        ReceptacleBase = "receptacle_base",
    }
}

/// The imposed motion. Which fields belong to it depends on its kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Motion {
    /// Its kind.
    #[schema(value_type = MotionKind)]
    pub kind: EnumValue<MotionKind>,
    /// `reciprocating`: its shape over time.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Waveform>)]
    pub waveform: Option<EnumValue<Waveform>>,
    /// `reciprocating`: amplitude, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude_mm: Option<f64>,
    /// `reciprocating`: cycles a second; instead of `period_s`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// `reciprocating`: duration of a cycle, s; instead of `frequency_hz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// `reciprocating`: where the motion enters.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Drive>)]
    pub drive: Option<EnumValue<Drive>>,
    /// `continuous`: speed, mm/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_mm_s: Option<f64>,
    /// `continuous`: distance, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_mm: Option<f64>,
}
