//! The mechanism of wear by speed and temperature (Cantizano 2002; thesis, before equation 11): Archard's law at low speeds, mild
//! oxidational wear where friction heats asperities, severe oxidational wear where it melts their oxide.
//!
//! Low speeds are below a transition V1; the oxide melts from the speed on at which the heat of friction exceeds what is conducted away
//! (`severe_oxidation`), which falls as the contact gets warmer. Range: that of the three laws; the wear of a transition jumps. Limiting
//! cases: one of them at a constant speed and temperature.

use super::mild_oxidation::MildOxidation;
use super::severe_oxidation::SevereOxidation;
use super::surface_state::SurfaceState;
use crate::law::pace::Pace;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// Wear coefficient k of Archard's law, -.
    pub k: f64,
    /// Transition V1 to mild oxidational wear, mm/s.
    pub transition_mm_s: f64,
    /// Mild oxidational wear.
    pub mild: MildOxidation,
    /// Severe oxidational wear.
    pub severe: SevereOxidation,
}

impl Mechanism {
    /// Specific wear rate at a pace, 1/MPa.
    pub(super) fn rate(&self, pace: Pace) -> f64 {
        let speed = pace.speed();
        if speed > self.severe.slowest_mm_s() {
            self.severe.rate(pace)
        } else if speed >= self.transition_mm_s {
            self.mild.rate(pace)
        } else {
            self.k / self.mild.surface.hardness_mpa
        }
    }

    /// The law on the surface that a change makes of its own.
    pub(super) fn with_surface(self, change: impl Fn(SurfaceState) -> SurfaceState) -> Self {
        Self {
            mild: MildOxidation {
                surface: change(self.mild.surface),
                ..self.mild
            },
            severe: SevereOxidation {
                surface: change(self.severe.surface),
                ..self.severe
            },
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::temperature::Temperature;
    use crate::law::wear::{mild_oxidation, severe_oxidation};

    /// Steel of the tests of both laws.
    fn steel(temperature: Temperature) -> Mechanism {
        Mechanism {
            k: 6.865e-4,
            transition_mm_s: 100.0,
            mild: mild_oxidation::STEEL,
            severe: SevereOxidation {
                surface: SurfaceState {
                    temperature,
                    ..severe_oxidation::STEEL.surface
                },
                ..severe_oxidation::STEEL
            },
        }
    }

    #[test]
    fn speed_and_temperature_select_the_mechanism() {
        let law = steel(Temperature::OfSurroundings(293.15));
        let at = |law: &Mechanism, mm_s: f64| law.rate(Pace::at_speed(mm_s)).to_bits();
        assert!((law.rate(Pace::at_speed(99.0)) / 1e-7 - 1.0).abs() < 1e-15);
        let mild = |mm_s: f64| law.mild.rate(Pace::at_speed(mm_s)).to_bits();
        assert_eq!(
            [100.0, 455.0].map(|v| at(&law, v)),
            [100.0, 455.0].map(mild)
        );
        let severe = |law: &Mechanism, v: f64| law.severe.rate(Pace::at_speed(v)).to_bits();
        assert_eq!(at(&law, 457.0), severe(&law, 457.0));
        // 1 000 K warmer, the oxide melts from a third of that speed on.
        let warm = law.with_surface(|surface| surface.heated(1_000.0));
        assert!(
            (warm.severe.slowest_mm_s() / law.severe.slowest_mm_s() - 467.0 / 1_467.0).abs()
                < 1e-12
        );
        assert_eq!(at(&warm, 200.0), severe(&warm, 200.0));
        // A given temperature of the contact stays.
        let given = steel(Temperature::OfContact(293.15));
        assert_eq!(given.with_surface(|surface| surface.heated(1_000.0)), given);
        // Half the hardness: twice the rate of both laws of hardness.
        let softer = law.with_surface(|surface| surface.softened(0.5));
        assert!((softer.rate(Pace::at_speed(50.0)) / 2e-7 - 1.0).abs() < 1e-15);
    }
}
