//! The imposed motion.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Kinds of motion.
    MotionKind {
        /// Reciprocating around the neutral position, starting to +x.
        Reciprocating = "reciprocating",
        /// The slider's surface slides past a contact that stays at one position of the receptacle, as a ring turning
        /// on a block.
        Continuous = "continuous",
    }
}

string_enum! {
    /// Waveforms of a reciprocating motion.
    Waveform {
        /// A sine.
        Sine = "sine",
        /// Constant speed between the ends.
        Triangle = "triangle",
    }
}

string_enum! {
    /// Where the motion is imposed.
    Drive {
        /// The slider's top face is rigid, carries the load and moves.
        SliderTop = "slider_top",
        /// Every slider node is moved along x (the source's drive).
        SliderBody = "slider_body",
        /// The slider's top face is fixed along x and the receptacle's base moves.
        ReceptacleBase = "receptacle_base",
    }
}

/// The imposed motion. Which fields belong to it depends on its kind.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Motion {
    /// Its kind.
    #[schema(value_type = MotionKind)]
    pub kind: EnumValue<MotionKind>,
    /// `reciprocating`: its waveform.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Waveform>)]
    pub waveform: Option<EnumValue<Waveform>>,
    /// `reciprocating`: amplitude, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude_mm: Option<f64>,
    /// `reciprocating`: frequency, Hz; instead of `period_s`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// `reciprocating`: duration of a cycle, s; instead of `frequency_hz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// `reciprocating`: where the motion is imposed.
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
