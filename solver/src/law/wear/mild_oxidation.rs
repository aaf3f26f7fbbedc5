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
use super::surface_state::SurfaceState;
use crate::law::pace::Pace;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MildOxidation {
    /// The constant C, -.
    pub constant: f64,
    /// Arrhenius constant A0, m^2/s.
    pub arrhenius_m2_s: f64,
    /// Activation energy Q0, J/mol.
    pub activation_j_mol: f64,
    /// Critical thickness Zc of the oxide, um.
    pub film_um: f64,
    /// Hardness H and temperature of the surface.
    pub surface: SurfaceState,
}

impl MildOxidation {
    /// Wear coefficient K at a pace, -.
    fn coefficient(&self, pace: Pace) -> f64 {
        let growth = self.constant
            * self.constant
            * self.arrhenius_m2_s
            * arrhenius::factor(self.activation_j_mol, self.surface.temperature.kelvin());
        growth / (self.film_um * 1e-6) * (1e3 * pace.s_per_mm)
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

/// A steel, at the constants of the reference value below.
#[cfg(test)]
pub(super) const STEEL: MildOxidation = MildOxidation {
    constant: 3.4e-4,
    arrhenius_m2_s: 1e6,
    activation_j_mol: 138e3,
    film_um: 10.0,
    surface: SurfaceState {
        hardness_mpa: 6_865.0,
        temperature: crate::law::temperature::Temperature::OfContact(700.0),
    },
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel at a flash temperature of 700 K and 1 m/s: K = 5.827372e-7.
    #[test]
    fn steel_at_a_metre_per_second_oxidises_mildly() {
        let law = STEEL;
        let found = law.coefficient(Pace::at_speed(1e3));
        assert!((found / 5.827_372e-7 - 1.0).abs() < 1e-6, "{found}");
    }
}
