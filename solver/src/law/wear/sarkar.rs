//! Sarkar's law: dh = (k/H) sqrt(1 + 3 mu^2) p |ds| (thesis, equation 9), Archard's with the asperities' junctions enlarged by
//! shear.
//!
//! k: wear coefficient without friction, -; H: hardness of the worn surface, MPa; mu: coefficient of friction, -; p: pressure,
//! MPa; ds: slip, mm. For metals that slide dry, up to p = H/3 as Archard's. Without friction it is Archard's.

use super::rate::{LocalState, Rate};

/// Specific wear rate for k/H in 1/MPa.
pub(super) fn rate(k_over_h: f64, friction: f64, _: LocalState) -> Rate {
    Rate::uniform(k_over_h * (1.0 + 3.0 * friction * friction).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p = 150 MPa, k = 1e-4, H = 1 700 MPa, mu = 0.3 over 0.02 mm of slip wear 1.988723e-7 mm; without friction as Archard.
    #[test]
    fn friction_increases_the_wear_of_a_plated_contact() {
        let at = LocalState {
            pressure: 150.0,
            slip: 0.02,
            ..LocalState::default()
        };
        let depth = |friction| rate(1e-4 / 1_700.0, friction, at).value * at.pressure * at.slip;
        assert!((depth(0.3) - 1.988_723e-7).abs() < 1e-13, "{}", depth(0.3));
        assert!((depth(0.0) - 1.764_706e-7).abs() < 1e-13, "{}", depth(0.0));
    }
}
