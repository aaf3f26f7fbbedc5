//! The mechanism of wear by speed and temperature (Cantizano 2002; thesis, before equation 11): Archard's law at low speeds, mild
//! oxidational wear where friction heats asperities, severe oxidational wear where it melts their oxide.
//!
//! Low speeds are below a transition V1; the oxide melts from the speed on at which the heat of friction exceeds what is conducted away
//! (`severe_oxidation`), which falls as the contact gets warmer. Range: that of the three laws; the wear of a transition jumps. Limiting
//! cases: one of them at a constant speed and temperature.

use super::mild_oxidation::MildOxidation;
use super::severe_oxidation::SevereOxidation;
use crate::law::pace::Pace;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// k/H of Archard's law, 1/MPa.
    pub k_over_h_per_mpa: f64,
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
            self.k_over_h_per_mpa
        }
    }

    /// The law at another hardness than it was given with.
    pub(super) fn softened(self, ratio: f64) -> Self {
        Self {
            k_over_h_per_mpa: self.k_over_h_per_mpa / ratio,
            mild: self.mild.softened(ratio),
            severe: self.severe.softened(ratio),
            ..self
        }
    }

    /// The law of a contact that is warmer than its surroundings by a rise in K.
    pub(super) fn heated(self, rise_k: f64) -> Self {
        Self {
            mild: self.mild.heated(rise_k),
            severe: self.severe.heated(rise_k),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::temperature::Temperature;

    /// Steel of the tests of both laws.
    fn steel(temperature: Temperature) -> Mechanism {
        Mechanism {
            k_over_h_per_mpa: 1e-7,
            transition_mm_s: 100.0,
            mild: MildOxidation {
                constant: 3.4e-4,
                arrhenius_m2_s: 1e6,
                activation_j_mol: 138e3,
                temperature: Temperature::OfContact(700.0),
                film_um: 10.0,
                hardness_mpa: 6_865.0,
            },
            severe: SevereOxidation {
                molten_fraction: 0.01,
                latent_heat_j_m3: 2e9,
                heat_share: 0.5,
                friction: 0.3,
                conductivity_w_mk: 3.2,
                melting_k: 1_760.15,
                temperature,
                diffusion_um: 10.0,
                hardness_mpa: 6_865.0,
            },
        }
    }

    #[test]
    fn speed_and_temperature_select_the_mechanism() {
        let law = steel(Temperature::OfSurroundings(293.15));
        let at = |law: &Mechanism, mm_s: f64| law.rate(Pace::at_speed(mm_s)).to_bits();
        assert_eq!(at(&law, 99.0), 1e-7_f64.to_bits());
        let mild = |mm_s: f64| law.mild.rate(Pace::at_speed(mm_s)).to_bits();
        assert_eq!(
            [100.0, 455.0].map(|v| at(&law, v)),
            [100.0, 455.0].map(mild)
        );
        let severe = |law: &Mechanism, v: f64| law.severe.rate(Pace::at_speed(v)).to_bits();
        assert_eq!(at(&law, 457.0), severe(&law, 457.0));
        // 1 000 K warmer, the oxide melts from a third of that speed on.
        let warm = law.heated(1_000.0);
        assert!(
            (warm.severe.slowest_mm_s() / law.severe.slowest_mm_s() - 467.0 / 1_467.0).abs()
                < 1e-12
        );
        assert_eq!(at(&warm, 200.0), severe(&warm, 200.0));
        // A given temperature of the contact stays.
        let given = steel(Temperature::OfContact(293.15));
        assert_eq!(given.heated(1_000.0), given);
        // Half the hardness: twice the rate of both laws of hardness.
        let softer = law.softened(0.5);
        assert!((softer.rate(Pace::at_speed(50.0)) / 2e-7 - 1.0).abs() < 1e-15);
    }
}
