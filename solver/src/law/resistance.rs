//! Constriction resistance of a spot of real contact.
//!
//! The softer of both surfaces yields until the spot carries the force, F = pi a^2 H (Holm, *Electric Contacts*, 1967), and the
//! current converges to this spot in both bodies: each is a half-space of a resistivity, or of layers over one (`layered`). Limiting
//! case: two like bodies, R = rho/(2 a).
//!
//! Range: one round spot. Many spots, films and the way through the rest of the parts are not included: more spots have a lower, films
//! a higher resistance.

pub mod layered;

use std::f64::consts::PI;

pub use layered::{Conductor, half_space};

/// Radius of the spot, mm, that carries a force in N by a hardness in MPa.
pub fn spot_radius(force_n: f64, hardness_mpa: f64) -> f64 {
    (force_n / (PI * hardness_mpa)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spot_of_hard_gold_is_that_of_the_reference() {
        let radius = spot_radius(0.5, 1_700.0);
        assert!((radius - 9.675_77e-3).abs() < 1e-8, "{radius}");
        // Two bodies of gold, 2.21e-8 ohm m: 1.142 03 mOhm.
        let gold = half_space(
            radius,
            &[Conductor {
                resistivity_ohm_m: 2.21e-8,
                thickness_mm: f64::INFINITY,
            }],
        );
        assert!((2.0e3 * gold - 1.142_03).abs() < 1e-5, "{gold}");
    }
}
