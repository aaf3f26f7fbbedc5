//! Skin effect: the depth to which an alternating current enters a conductor,
//!   delta = sqrt(rho/(pi f mu0 mu_r)),
//! rho resistivity, f frequency, mu0 4e-7 pi H/m, mu_r relative permeability, and the resistance of a round wire of radius r over that to
//! direct current,
//!   R/R0 = Re [(z/2) J0(z)/J1(z)],  z^2 = -2 i (r/delta)^2
//! (Ramo, Whinnery, Van Duzer, *Fields and Waves in Communication Electronics*, section 4.5), by the continued fraction
//!   (z/2) J0/J1 = 1 - (z^2/2)/(4 - z^2/(6 - z^2/(8 - ...))).
//! Limiting cases: 1 at r << delta; r/(2 delta) + 1/4 at r >> delta.

use std::f64::consts::PI;

/// Permeability of free space, H/m.
const PERMEABILITY_H_PER_M: f64 = 4e-7 * PI;

/// From here on the expansion for large r/delta, which is exact to (delta/r)^3.
const LARGE: f64 = 100.0;

/// Skin depth, mm, of a conductor without magnetism.
pub fn depth_mm(resistivity_ohm_m: f64, frequency_hz: f64) -> f64 {
    1e3 * (resistivity_ohm_m / (PI * frequency_hz * PERMEABILITY_H_PER_M)).sqrt()
}

/// Resistance of a round wire over that to direct current, -, for its radius over the skin depth.
pub(crate) fn wire_ratio(radius_over_depth: f64) -> f64 {
    if radius_over_depth > LARGE {
        return 0.5 * radius_over_depth + 0.25 + 3.0 / (32.0 * radius_over_depth);
    }
    let square = 2.0 * radius_over_depth * radius_over_depth;
    // Backward from a term that is far beyond |z|: each one needs d = 2 k - z^2/d' with z^2 = -i square.
    let terms = 20 + 2 * crate::number::count_at_least(square.sqrt());
    let (mut real, mut imaginary) = (0.0, 0.0);
    for k in (2..terms).rev() {
        // i square/(real + i imaginary), nothing below the last term.
        let norm: f64 = real * real + imaginary * imaginary;
        let (re, im) = if norm > 0.0 {
            (square * imaginary / norm, square * real / norm)
        } else {
            (0.0, 0.0)
        };
        (real, imaginary) = (2.0 * crate::number::real(k) + re, im);
    }
    1.0 + 0.5 * square * imaginary / (real * real + imaginary * imaginary)
}

#[cfg(test)]
mod tests {
    use super::*;

    const COPPER: f64 = 1.68e-8;
    const BECU: f64 = 7.7e-8;

    #[test]
    fn copper_at_a_gigahertz_conducts_in_two_micrometres() {
        let depth = 1e3 * depth_mm(COPPER, 1e9);
        assert!((depth - 2.062_9).abs() < 1e-4, "{depth}");
    }

    #[test]
    fn a_wire_of_25_um_gains_one_per_cent_at_the_frequencies_of_the_reference() {
        for (resistivity, frequency) in [(COPPER, 4.588e6), (BECU, 21.03e6)] {
            let ratio = wire_ratio(25.4e-3 / depth_mm(resistivity, frequency));
            assert!((ratio - 1.01).abs() < 1e-5, "{ratio}");
        }
    }

    #[test]
    fn the_resistance_of_a_wire_has_its_limits() {
        // 1 + (r/delta)^4/48 of a thin wire.
        let thin = wire_ratio(0.1);
        assert!((thin - 1.0 - 1e-4 / 48.0).abs() < 1e-10, "{thin}");
        let apart = wire_ratio(LARGE) / wire_ratio(LARGE * (1.0 + 1e-12)) - 1.0;
        assert!(apart.abs() < 1e-7, "{apart}");
        assert!(wire_ratio(0.0).to_bits() == 1.0_f64.to_bits());
    }
}
