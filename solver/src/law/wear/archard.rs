//! Archard's law: dh = (k/H) p |ds| (thesis, equations 5, 6 and 21), a constant specific wear rate.
//!
//! k: wear coefficient, -; H: hardness of the worn surface, MPa; p: pressure, MPa; ds: slip, mm. Published for
//! p <= H/3. The recession vanishes with the pressure and does not depend on speed.

use super::rate::{LocalState, Rate};

/// Specific wear rate for k/H in 1/MPa.
pub(super) fn rate(k_over_h: f64, _: LocalState) -> Rate {
    Rate::uniform(k_over_h)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p = 150 MPa, k = 1e-4, H = 1 700 MPa over 0.02 mm of slip wear 1.764706e-7 mm.
    #[test]
    fn recession_of_a_plated_contact() {
        let at = LocalState {
            pressure: 150.0,
            slip: 0.02,
            ..LocalState::default()
        };
        let depth = rate(1e-4 / 1_700.0, at).value * at.pressure * at.slip;
        assert!((depth - 1.764_706e-7).abs() < 1e-13, "{depth}");
    }
}
