//! The imposed motion.

mod derived;

pub use derived::DerivedMotion;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Kinds of motion.
    MotionKind {
        /// Reciprocating around the neutral position, starting to +x.
        Reciprocating = "reciprocating",
        /// One period of a sum of sines and cosines.
        Fourier = "fourier",
        /// The slider's surface slides past a contact that stays at one position of the receptacle, as a ring turning
        /// on a block.
        Continuous = "continuous",
        /// Reciprocating slip of a part that contacts hold on a shaken base.
        Vibration = "vibration",
        /// Reciprocating slip between parts that expand differently.
        ThermalCycle = "thermal_cycle",
        /// One cycle is one mating: a pass in and a pass out.
        Insertion = "insertion",
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

/// A point of a power spectral density.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PsdPoint {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Density of the acceleration, g^2/Hz.
    pub g2_per_hz: f64,
}

/// A term of a Fourier series.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FourierTerm {
    /// Order: periods of the term in one of the motion.
    #[serde(deserialize_with = "super::count::required")]
    pub order: u64,
    /// Amplitude of the sine, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sine_mm: Option<f64>,
    /// Amplitude of the cosine, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cosine_mm: Option<f64>,
}

/// The imposed motion. Which fields belong to it depends on its kind.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Motion {
    /// Kind.
    #[schema(value_type = MotionKind)]
    pub kind: EnumValue<MotionKind>,
    /// `reciprocating`: its waveform.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Waveform>)]
    pub waveform: Option<EnumValue<Waveform>>,
    /// `reciprocating`: amplitude, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude_mm: Option<f64>,
    /// `fourier`: its terms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub terms: Option<Vec<FourierTerm>>,
    /// `reciprocating`, `fourier`, `thermal_cycle`, `insertion`: frequency, Hz; instead of `period_s`. `vibration`: that of a sine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// `reciprocating`, `fourier`, `thermal_cycle`, `insertion`: duration of a cycle, s; instead of `frequency_hz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// Where the motion is imposed; not of `continuous`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Drive>)]
    pub drive: Option<EnumValue<Drive>>,
    /// `continuous`: speed, mm/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_mm_s: Option<f64>,
    /// `continuous`: distance, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_mm: Option<f64>,
    /// `vibration`: amplitude of a sine's acceleration, multiples of 9.806 65 m/s^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration_g: Option<f64>,
    /// `vibration`: power spectral density of a random acceleration, from the lowest frequency on; instead of `acceleration_g`
    /// and `frequency_hz`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub psd: Option<Vec<PsdPoint>>,
    /// `vibration`: duration, s; instead of `cycles`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// `vibration`: mass of the part that the contacts hold, g.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_g: Option<f64>,
    /// `vibration`: number of contacts that hold the part.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub contacts: Option<u64>,
    /// `vibration`, `thermal_cycle`: stiffness of a contact's arm along the slip, N/mm; it takes up what it can before the contact slips.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential_stiffness_n_per_mm: Option<f64>,
    /// `vibration`: natural frequency of the part on its contacts, Hz; by default that of its mass on their tangential stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub natural_frequency_hz: Option<f64>,
    /// `vibration`: quality factor of that oscillation, -.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quality_factor: Option<f64>,
    /// `vibration`, `thermal_cycle`: play between the parts, mm: their displacement ends at half of it to either side, and the contact slips
    /// by what of that its arm does not take up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_mm: Option<f64>,
    /// `thermal_cycle`: change of the temperature, K.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub delta_t_k: Option<f64>,
    /// `thermal_cycle`: length over which the parts expand, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_mm: Option<f64>,
    /// `thermal_cycle`: difference of the coefficients of thermal expansion, 1/K.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expansion_mismatch_per_k: Option<f64>,
    /// `insertion`: wipe of a mating, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wipe_mm: Option<f64>,
}
