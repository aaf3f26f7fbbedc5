//! Severe oxidational wear at high speeds (thesis, equation 12, after Lim and Ashby 1987 and Cantizano et al. 2002): friction melts an
//! oxide film, of which a part is thrown out,
//!   dh = (fm/L) [alpha mu - K (Tm - Tb)/(lf v H)]+ p |ds|.
//!
//! fm: fraction of the molten oxide that is removed, -; L: its latent heat of melting, J/m^3; alpha: share of the frictional heat that
//! enters the body, -; mu: coefficient of friction, -; K: thermal conductivity of the oxide, W/(m K); Tm: its melting temperature,
//! Tb: temperature of the bulk, K; lf: distance over which the heat of a flash diffuses, m; v: speed, m/s; H: hardness, MPa; p:
//! pressure, MPa; ds: slip, mm; []+ is the positive part. The source's heat q of the real area of contact is mu H v, and that area is
//! p/H of the apparent one. Corrections of the source: it lacks L, without which W has the unit of a heat; less heat than is
//! conducted away melts nothing, where its formula would deposit material.
//!
//! Range: speeds above v = K (Tm - Tb)/(alpha mu lf H), below which nothing melts. Limiting case: fast sliding is Archard's law with
//! k/H = alpha mu fm/L.

use super::surface_state::SurfaceState;
use crate::law::pace::Pace;

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SevereOxidation {
    /// Fraction fm of the molten oxide that is removed, -.
    pub molten_fraction: f64,
    /// Latent heat L, J/m^3.
    pub latent_heat_j_m3: f64,
    /// Share alpha of the heat, -.
    pub heat_share: f64,
    /// Coefficient of friction mu, -.
    pub friction: f64,
    /// Thermal conductivity K of the oxide, W/(m K).
    pub conductivity_w_mk: f64,
    /// Melting temperature Tm of the oxide, K.
    pub melting_k: f64,
    /// Diffusion distance lf, um.
    pub diffusion_um: f64,
    /// Hardness H and temperature of the surface.
    pub surface: SurfaceState,
}

impl SevereOxidation {
    /// Heat that is conducted away over the pressure of the real area of contact, m/s.
    fn conducted(&self) -> f64 {
        // An oxide that is molten already needs no heat.
        let rise_k = (self.melting_k - self.surface.temperature.kelvin()).max(0.0);
        self.conductivity_w_mk * rise_k
            / (self.diffusion_um * 1e-6 * self.surface.hardness_mpa * 1e6)
    }

    /// The speed above which it wears, mm/s; without bound where no friction heats.
    pub fn slowest_mm_s(&self) -> f64 {
        1e3 * self.conducted() / (self.heat_share * self.friction)
    }

    /// Specific wear rate at a pace, 1/MPa.
    pub(super) fn rate(&self, pace: Pace) -> f64 {
        let melting = self.heat_share * self.friction - self.conducted() * 1e3 * pace.s_per_mm;
        1e6 * self.molten_fraction / self.latent_heat_j_m3 * melting.max(0.0)
    }
}

/// A steel, at the constants of the reference value below.
#[cfg(test)]
pub(super) const STEEL: SevereOxidation = SevereOxidation {
    molten_fraction: 0.01,
    latent_heat_j_m3: 2e9,
    heat_share: 0.5,
    friction: 0.3,
    conductivity_w_mk: 3.2,
    melting_k: 1_760.15,
    diffusion_um: 10.0,
    surface: SurfaceState {
        hardness_mpa: 6_865.0,
        temperature: crate::law::temperature::Temperature::OfContact(293.15),
    },
};

#[cfg(test)]
mod tests {
    use super::*;

    /// p = 150 MPa at 5 m/s wears 1.022428e-4 of the slip; the law begins at 0.45588 m/s.
    #[test]
    fn steel_melts_its_oxide_above_a_speed() {
        let law = STEEL;
        let at = |mm_s: f64| law.rate(Pace::at_speed(mm_s));
        assert!((150.0 * at(5_000.0) / 1.022_428e-4 - 1.0).abs() < 1e-6);
        assert!(
            (law.slowest_mm_s() - 455.88).abs() < 5e-3,
            "{}",
            law.slowest_mm_s()
        );
        assert!(at(455.0) <= 0.0 && at(457.0) > 0.0);
        // 0.15 fm/L of fast sliding.
        assert!((at(1e12) / 7.5e-7 - 1.0).abs() < 1e-9, "{}", at(1e12));
    }
}
