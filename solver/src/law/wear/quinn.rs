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
use super::surface_state::SurfaceState;
use crate::law::pace::Pace;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quinn {
    /// Diameter d of a touching asperity, um.
    pub asperity_um: f64,
    /// Arrhenius constant Ap, kg^2/(m^4 s).
    pub arrhenius_kg2_m4s: f64,
    /// Activation energy Qp, J/mol.
    pub activation_j_mol: f64,
    /// Critical thickness xi of the oxide, um.
    pub film_um: f64,
    /// Density rho of the oxide, kg/m^3.
    pub oxide_density_kg_m3: f64,
    /// Mass fraction f of oxygen in the oxide, -.
    pub oxygen_fraction: f64,
    /// Hardness H and temperature of the surface.
    pub surface: SurfaceState,
}

impl Quinn {
    /// Wear coefficient K at a pace, -.
    fn coefficient(&self, pace: Pace) -> f64 {
        let oxygen = self.film_um * 1e-6 * self.oxide_density_kg_m3 * self.oxygen_fraction;
        let growth = self.arrhenius_kg2_m4s
            * arrhenius::factor(self.activation_j_mol, self.surface.temperature.kelvin());
        self.asperity_um * 1e-6 * growth / (oxygen * oxygen) * (1e3 * pace.s_per_mm)
    }

    /// Wear coefficient K at a speed in mm/s, -.
    pub fn coefficient_at(&self, mm_s: f64) -> f64 {
        self.coefficient(Pace::at_speed(mm_s))
    }

    /// Specific wear rate at a pace, 1/MPa.
    pub(super) fn rate(&self, pace: Pace) -> f64 {
        self.coefficient(pace) / self.surface.hardness_mpa
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::temperature::Temperature;

    /// Steel at 400 °C and 10 mm/s: 1.276179e-11 1/MPa.
    #[test]
    fn steel_that_slides_slowly_wears_by_its_oxide() {
        let law = Quinn {
            asperity_um: 20.0,
            arrhenius_kg2_m4s: 1.5e6,
            activation_j_mol: 208e3,
            film_um: 1.0,
            oxide_density_kg_m3: 5_240.0,
            oxygen_fraction: 0.3006,
            surface: SurfaceState {
                hardness_mpa: 6_865.0,
                temperature: Temperature::OfContact(673.15),
            },
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
