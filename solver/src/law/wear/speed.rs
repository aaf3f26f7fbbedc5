//! Laws of the speed of sliding: a specific wear rate k(V), the same at all points of the contact.
//!
//! V is the speed of the imposed motion, the mean of an increment. Where the rate is in proportion to 1/V the law is one of time:
//! an increment wears by the time that it takes, however the speed changes within it.

use super::mechanism::Mechanism;
use super::mild_oxidation::MildOxidation;
use super::quinn::Quinn;
use super::severe_oxidation::SevereOxidation;
use super::surface_state::SurfaceState;
use crate::law::pace::Pace;
use crate::law::temperature::Temperature;

/// Speed below which friction hardly heats asperities, mm/s, so that Archard's law holds instead of the oxidational ones. The source
/// says "very low"; 0.1 m/s is the usual figure for steels, general knowledge.
pub const SLOWEST_MM_S: f64 = 100.0;

/// Laws of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpeedLaw {
    /// Quinn's mild oxidational wear.
    Quinn(Quinn),
    /// Mild oxidational wear.
    MildOxidation(MildOxidation),
    /// Severe oxidational wear.
    SevereOxidation(SevereOxidation),
    /// One of these or Archard's, by speed and temperature.
    Mechanism(Mechanism),
}

impl SpeedLaw {
    /// Specific wear rate at a pace, 1/MPa.
    pub fn rate(&self, pace: Pace) -> f64 {
        match self {
            Self::Quinn(law) => law.rate(pace),
            Self::MildOxidation(law) => law.rate(pace),
            Self::SevereOxidation(law) => law.rate(pace),
            Self::Mechanism(law) => law.rate(pace),
        }
    }

    /// Returns `true` if it is a law of time.
    pub(crate) fn is_by_time(&self) -> bool {
        match self {
            Self::Quinn(_) | Self::MildOxidation(_) => true,
            Self::SevereOxidation(_) | Self::Mechanism(_) => false,
        }
    }

    /// Returns `true` if the temperature of the contact is given.
    pub(super) fn has_given_temperature(&self) -> bool {
        let surface = match self {
            Self::Quinn(law) => law.surface,
            Self::MildOxidation(law) => law.surface,
            Self::SevereOxidation(law) => law.surface,
            Self::Mechanism(law) => law.mild.surface,
        };
        matches!(surface.temperature, Temperature::OfContact(_))
    }

    /// The law on the surface that a change makes of its own.
    #[must_use]
    pub(super) fn with_surface(self, change: impl Fn(SurfaceState) -> SurfaceState) -> Self {
        match self {
            Self::Quinn(law) => Self::Quinn(Quinn {
                surface: change(law.surface),
                ..law
            }),
            Self::MildOxidation(law) => Self::MildOxidation(MildOxidation {
                surface: change(law.surface),
                ..law
            }),
            Self::SevereOxidation(law) => Self::SevereOxidation(SevereOxidation {
                surface: change(law.surface),
                ..law
            }),
            Self::Mechanism(law) => Self::Mechanism(law.with_surface(change)),
        }
    }
}
