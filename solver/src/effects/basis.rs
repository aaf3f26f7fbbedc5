//! Basis of a decision about an effect.

use serde::{Deserialize, Serialize};

use super::plasticity::Yield;
use crate::scene::{MissingInput, MissingProperty};
use crate::sides::{Side, Sides};

/// Basis of a decision about an effect.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Basis {
    /// There is nothing to simulate.
    Nothing(Absence),
    /// The scene lacks an input.
    Missing(MissingInput),
    /// The indicator, and the facts behind it.
    Indicator(Indicator, Facts),
}

impl Basis {
    /// The indicator.
    pub(super) fn indicator(self) -> Option<Indicator> {
        match self {
            Self::Nothing(_) | Self::Missing(_) => None,
            Self::Indicator(indicator, _) => Some(indicator),
        }
    }
}

/// Relative change of the outputs by an effect.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Indicator {
    /// For the unworn contact.
    pub unworn: f64,
    /// At the estimated end.
    pub worn: f64,
    /// Largest value of an effect that is skipped.
    pub threshold: f64,
}

impl Indicator {
    /// The larger of both values.
    pub fn value(self) -> f64 {
        self.unworn.max(self.worn)
    }

    /// Returns `true` if it is larger than that of any effect that is skipped.
    pub(super) fn is_beyond_threshold(self) -> bool {
        self.value() > self.threshold
    }
}

/// Why there is nothing to simulate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Absence {
    /// The scene has no friction.
    Frictionless,
    /// Friction acts on neither body.
    FrictionOff,
    /// The amplitude is 0.
    NothingSlides,
    /// The side has no wear law, or one that wears nothing in the scene.
    NoWear(Side),
    /// Neither side wears.
    NothingWears,
    /// Neither side is plated.
    NotPlated,
    /// The contact is at the temperature at which hardnesses are measured.
    ReferenceTemperature,
    /// No wear rate depends on the temperature by what is known.
    NoRateByTemperature,
    /// The resistance of the contact is switched off.
    ResistanceOff,
    /// No current is given.
    NoCurrent,
    /// The current is direct.
    DirectCurrent,
    /// A property of the contact as a conductor is not known.
    Conductor(MissingProperty),
    /// The bodies are half-spaces.
    HalfSpaces,
    /// The load has no spring.
    DeadLoad,
    /// The contact is solved for in sections along a line.
    Sections,
    /// A hardness is not known.
    UnknownHardness,
    /// The width is not known.
    UnknownWidth,
    /// It is the wear law of a surface.
    WearLaw,
    /// It is never simulated.
    NeverSimulated,
}

/// Facts behind an indicator.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Facts {
    /// Elastic deformation of the unworn contact.
    Deformation {
        /// Contact modulus, MPa.
        modulus_mpa: f64,
        /// Hertz half-width, mm.
        half_width_mm: f64,
    },
    /// Force, resistivities and hardnesses are known.
    KnownConductor,
    /// Depth to which an alternating current enters each body, mm.
    SkinDepth(Sides<f64>),
    /// Temperature rise of the unworn contact by friction.
    FrictionalHeat {
        /// The mean, K.
        mean_k: f64,
        /// The largest one, K.
        highest_k: f64,
        /// Temperature rise of one spot that carries all of the load, K, where the force and the hardnesses are known.
        of_one_spot_k: Option<f64>,
    },
    /// Largest temperature rise of the unworn contact by the current, K.
    JouleHeat(f64),
    /// Distribution of the load across the width.
    AcrossWidth(AcrossWidth),
    /// First yield of the unworn contact.
    Yield {
        /// Peak pressure and hardnesses.
        unworn: Yield,
        /// Thickness of the outermost layer of the side that yields, mm; none of a bare one.
        layer_mm: Option<f64>,
        /// Sum of the worn depths of both sides at the estimated end, mm.
        worn_mm: f64,
    },
    /// The coefficient of friction follows from the wear of the side.
    FrictionByWear,
    /// A change of the outputs.
    Change {
        /// True if all that would be skipped changes the outputs by more than its budget, and this effect by most of it.
        is_beyond_budget: bool,
        /// True if it is beyond its limit, cannot be simulated in the scene and counts as an error.
        is_stated_error: bool,
    },
}

/// Distribution of the load across the width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum AcrossWidth {
    /// The contact of both curvatures is solved for.
    Point {
        /// Half-length along the sliding direction, mm.
        half_length_mm: f64,
    },
    /// Sections along a line are solved for.
    Sections,
    /// Node planes over the width are solved for.
    NodePlanes,
    /// The load is even across the width.
    Even {
        /// Worn depth that ends the life, mm.
        depth_mm: f64,
        /// Life of the section over that of a ball of its radius.
        life_over_ball: f64,
    },
}
