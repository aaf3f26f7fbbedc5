//! Quinn's law of mild oxidational wear (thesis, equation 7): an oxide film grows on the asperities that touch, and breaks off at a
//! critical thickness,
//!   dh = K p |ds|/H,  K = d Ap exp(-Qp/(R T0))/(xi^2 rho^2 f^2 V).
//!
//! d: diameter of a touching asperity, m, which is the distance of sliding in which it oxidises; Ap: Arrhenius constant of the
//! parabolic oxidation, kg^2/(m^4 s); Qp: its activation energy, J/mol; R: gas constant; T0: temperature of the asperities, K; xi:
//! critical thickness of the oxide, m; rho: its density, kg/m^3; f: mass fraction of oxygen in it, -; V: speed, m/s; H: hardness,
//! MPa; p: pressure, MPa; ds: slip, mm. The real area of contact is p/H of the apparent one. In the source's list of symbols V is
//! missing; it is the speed, not the worn volume. At a temperature it is a law of time: dh/dt = C p while the point slips.
//!
//! Range: K is the probability that an encounter of asperities yields a particle, at most 1; one mechanism of oxidation, since Ap and Qp
//! change with the oxide; films that friction heats (`SLOWEST_MM_S`). Constants are published of steels alone (Quinn 1971). Limiting
//! cases: no wear at absolute zero; fast sliding leaves no time to oxidise.

use super::arrhenius;
use crate::law::pace::Pace;
use crate::law::temperature::Temperature;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quinn {
    /// Diameter d of a touching asperity, um.
    pub asperity_um: f64,
    /// Arrhenius constant Ap, kg^2/(m^4 s).
    pub arrhenius_kg2_m4s: f64,
    /// Activation energy Qp, J/mol.
    pub activation_j_mol: f64,
    /// Temperature T0 of the asperities, K.
    pub temperature: Temperature,
    /// Critical thickness xi of the oxide, um.
    pub film_um: f64,
    /// Density rho of the oxide, kg/m^3.
    pub oxide_density_kg_m3: f64,
    /// Mass fraction f of oxygen in the oxide, -.
    pub oxygen_fraction: f64,
    /// Hardness H, MPa.
    pub hardness_mpa: f64,
}

impl Quinn {
    /// Wear coefficient K at a pace, -.
    fn coefficient(&self, pace: Pace) -> f64 {
        let oxygen = self.film_um * 1e-6 * self.oxide_density_kg_m3 * self.oxygen_fraction;
        let growth = self.arrhenius_kg2_m4s
            * arrhenius::factor(self.activation_j_mol, self.temperature.kelvin());
        self.asperity_um * 1e-6 * growth / (oxygen * oxygen) * (1e3 * pace.s_per_mm)
    }

    /// Wear coefficient K at a speed in mm/s, -.
    pub fn coefficient_at(&self, mm_s: f64) -> f64 {
        self.coefficient(Pace::at_speed(mm_s))
    }

    /// Specific wear rate at a pace, 1/MPa.
    pub(super) fn rate(&self, pace: Pace) -> f64 {
        self.coefficient(pace) / self.hardness_mpa
    }

    /// The law at another hardness than it was given with.
    #[must_use]
    pub(super) fn softened(self, ratio: f64) -> Self {
        Self {
            hardness_mpa: self.hardness_mpa * ratio,
            ..self
        }
    }

    /// The law of a contact that is warmer than its surroundings by a rise in K.
    #[must_use]
    pub(super) fn heated(self, rise_k: f64) -> Self {
        Self {
            temperature: self.temperature.raised(rise_k),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel at 400 °C and 10 mm/s: 1.276179e-11 1/MPa.
    #[test]
    fn steel_that_slides_slowly_wears_by_its_oxide() {
        let law = Quinn {
            asperity_um: 20.0,
            arrhenius_kg2_m4s: 1.5e6,
            activation_j_mol: 208e3,
            temperature: Temperature::OfContact(673.15),
            film_um: 1.0,
            oxide_density_kg_m3: 5_240.0,
            oxygen_fraction: 0.3006,
            hardness_mpa: 6_865.0,
        };
        let rate = |s_per_mm| law.rate(Pace::at_speed(1.0 / s_per_mm));
        assert!(
            (rate(0.1) / 1.276_179e-11 - 1.0).abs() < 1e-6,
            "{}",
            rate(0.1)
        );
        // By time: half the speed, twice the wear over a distance.
        assert!((rate(0.2) / rate(0.1) - 2.0).abs() < 1e-15);
    }
}
