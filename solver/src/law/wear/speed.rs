//! Laws of the speed of sliding: a specific wear rate k(V), the same at all points of the contact.
//!
//! V is the speed of the imposed motion, the mean of an increment. Where the rate is in proportion to 1/V the law is one of time:
//! an increment wears by the time that it takes, however the speed changes within it.

use super::mechanism::Mechanism;
use super::mild_oxidation::MildOxidation;
use super::quinn::Quinn;
use super::severe_oxidation::SevereOxidation;
use crate::law::pace::Pace;

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

    /// Whether it is a law of time.
    pub fn is_by_time(&self) -> bool {
        match self {
            Self::Quinn(_) | Self::MildOxidation(_) => true,
            Self::SevereOxidation(_) | Self::Mechanism(_) => false,
        }
    }

    /// The law at another hardness than it was given with.
    #[must_use]
    pub(super) fn softened(self, ratio: f64) -> Self {
        match self {
            Self::Quinn(law) => Self::Quinn(law.softened(ratio)),
            Self::MildOxidation(law) => Self::MildOxidation(law.softened(ratio)),
            Self::SevereOxidation(law) => Self::SevereOxidation(law.softened(ratio)),
            Self::Mechanism(law) => Self::Mechanism(law.softened(ratio)),
        }
    }

    /// The law of a contact that is warmer than its surroundings by a rise in K.
    #[must_use]
    pub(super) fn heated(self, rise_k: f64) -> Self {
        match self {
            Self::Quinn(law) => Self::Quinn(law.heated(rise_k)),
            Self::MildOxidation(law) => Self::MildOxidation(law.heated(rise_k)),
            Self::SevereOxidation(law) => Self::SevereOxidation(law.heated(rise_k)),
            Self::Mechanism(law) => Self::Mechanism(law.heated(rise_k)),
        }
    }
}
