//! Mild oxidational wear at moderate speeds (thesis, equation 11, after Lim and Ashby 1987 and Cantizano et al. 2002): a cold, brittle
//! oxide splits off at a critical thickness,
//!   dh = K p |ds|/H,  K = C^2 A0 exp(-Q0/(R Tf))/(Zc v).
//!
//! C: a constant, -; A0: Arrhenius constant of the oxidation, m^2/s; Q0: its activation energy, J/mol; R: gas constant; Tf: flash
//! temperature of the asperities, K; Zc: critical thickness of the oxide, m; v: speed, m/s; H: hardness, MPa; p: pressure, MPa; ds:
//! slip, mm. In the source W, F and v are normalised, W = dh/ds, F = p/H and v = V r0/a, with the radius r0 of a pin and the thermal
//! diffusivity a, which cancel against its factor r0/a. At a temperature it is a law of time.
//!
//! Range: K at most 1; speeds from `SLOWEST_MM_S` on, below which Archard's law holds; below those of `severe_oxidation`. Limiting cases
//! as of Quinn's law.

use super::arrhenius;
use crate::law::pace::Pace;
use crate::law::temperature::Temperature;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MildOxidation {
    /// The constant C, -.
    pub constant: f64,
    /// Arrhenius constant A0, m^2/s.
    pub arrhenius_m2_s: f64,
    /// Activation energy Q0, J/mol.
    pub activation_j_mol: f64,
    /// Flash temperature Tf, K.
    pub temperature: Temperature,
    /// Critical thickness Zc of the oxide, um.
    pub film_um: f64,
    /// Hardness H, MPa.
    pub hardness_mpa: f64,
}

impl MildOxidation {
    /// Wear coefficient K at a pace, -.
    fn coefficient(&self, pace: Pace) -> f64 {
        let growth = self.constant
            * self.constant
            * self.arrhenius_m2_s
            * arrhenius::factor(self.activation_j_mol, self.temperature.kelvin());
        growth / (self.film_um * 1e-6) * (1e3 * pace.s_per_mm)
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

    /// Steel at a flash temperature of 700 K and 1 m/s: K = 5.827372e-7.
    #[test]
    fn steel_at_a_metre_per_second_oxidises_mildly() {
        let law = MildOxidation {
            constant: 3.4e-4,
            arrhenius_m2_s: 1e6,
            activation_j_mol: 138e3,
            temperature: Temperature::OfContact(700.0),
            film_um: 10.0,
            hardness_mpa: 6_865.0,
        };
        let found = law.coefficient(Pace::at_speed(1e3));
        assert!((found / 5.827_372e-7 - 1.0).abs() < 1e-6, "{found}");
    }
}
