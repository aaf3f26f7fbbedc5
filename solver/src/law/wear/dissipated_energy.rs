//! Dissipated energy: dh = alpha q |ds| with q = mu p where the contact slips.
//!
//! alpha: worn volume per energy, mm^3/J; mu: coefficient of friction, -; p: pressure, MPa; ds: slip, mm; q |ds| is an energy in
//! mJ/mm^2. Fitted to fretting in gross slip (Fouvry, Kapsa and Vincent 1996), where it covers strokes and coefficients of
//! friction for which k of Archard's law varies. At a constant coefficient of friction it is Archard's with k/H = 1e-3 alpha mu.

use super::rate::{LocalState, Rate};

/// J per mJ.
const JOULE: f64 = 1e-3;

/// Specific wear rate for alpha in mm^3/J.
pub(super) fn rate(mm3_per_j: f64, friction: f64, _: LocalState) -> Rate {
    Rate::uniform(JOULE * mm3_per_j * friction)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4.23e-5 mm^3/J and mu = 0.8 are 3.384e-8 1/MPa.
    #[test]
    fn energy_wears_as_archard_at_a_constant_friction() {
        let rate = rate(4.23e-5, 0.8, LocalState::default());
        assert!((rate.value - 3.384e-8).abs() < 1e-20, "{}", rate.value);
    }
}
