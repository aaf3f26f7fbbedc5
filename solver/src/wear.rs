//! Archard's law as a recession per slip: dh = (k/H) p |ds| along the normal (thesis, equations 5, 6 and 21).
//!
//! The thesis' own subroutine takes the signed velocity of the slider; here it is the magnitude of the local
//! slip, so that sticking points do not wear and a return stroke removes material like the stroke before.

use crate::scene::WearLaw;

/// Recession per pressure and slip, 1/MPa; 0 where nothing wears.
pub fn coefficient(law: Option<WearLaw>) -> f64 {
    match law {
        None => 0.0,
        Some(WearLaw::Archard { k_over_h_per_mpa }) => k_over_h_per_mpa,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_without_a_law_does_not_wear() {
        assert!(coefficient(None).abs() < f64::MIN_POSITIVE);
        let law = WearLaw::Archard {
            k_over_h_per_mpa: 2.5761e-5,
        };
        assert!((coefficient(Some(law)) - 2.5761e-5).abs() < 1e-20);
    }
}
