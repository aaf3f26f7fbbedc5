//! Saracibar and Chiumenti's law: dh = k q |ds| / (mu0 H) with q = mu p where the contact slips (thesis, equation 10).
//!
//! k: wear coefficient that was measured at the coefficient of friction mu0, -; H: hardness of the worn surface, MPa; mu: the
//! present coefficient of friction, -; p: pressure, MPa; ds: slip, mm. The thesis writes a state variable alpha for the frictional
//! slip "or" dissipation; only the dissipation, an energy per area, has the right unit. With mu = mu0 it is Archard's.

use super::rate::{LocalState, Rate};

/// Specific wear rate for k/H in 1/MPa.
pub(super) fn rate(k_over_h: f64, friction: f64, reference_friction: f64, _: LocalState) -> Rate {
    Rate::uniform(k_over_h * friction / reference_friction)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p = 150 MPa, k = 1e-4 at mu0 = 0.3, H = 1 700 MPa, mu = 0.6 over 0.02 mm of slip wear 3.529412e-7 mm.
    #[test]
    fn twice_the_friction_wears_twice_as_much() {
        let at = LocalState {
            pressure: 150.0,
            slip: 0.02,
            ..LocalState::default()
        };
        let depth =
            |friction| rate(1e-4 / 1_700.0, friction, 0.3, at).value * at.pressure * at.slip;
        assert!((depth(0.6) - 3.529_412e-7).abs() < 1e-13, "{}", depth(0.6));
        assert!((depth(0.3) - 1.764_706e-7).abs() < 1e-13, "{}", depth(0.3));
    }
}
