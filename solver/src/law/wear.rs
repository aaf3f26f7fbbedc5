//! Wear laws: recession of a surface from the local state of the contact.
//!
//! A law returns its rate with derivatives, and the contact solve knows no law. So far it takes the rate of the unloaded
//! surface as a constant (`coefficient`), which is exact for Archard's law only. One file a law.
//!
//! The thesis' own subroutine takes the signed velocity of the slider; here it is the magnitude of the local slip, so
//! that sticking points do not wear and a return stroke removes material like the stroke before.

pub mod archard;
mod rate;

pub use rate::{LocalState, Rate};

/// Wear laws: normal recession rate of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WearLaw {
    /// Archard: recession = (k/H) p |slip| (thesis, equations 5 and 6).
    Archard {
        /// k/H, 1/MPa.
        k_over_h_per_mpa: f64,
    },
}

impl WearLaw {
    /// Specific wear rate at a local state.
    pub fn rate(self, at: LocalState) -> Rate {
        match self {
            Self::Archard { k_over_h_per_mpa } => archard::rate(k_over_h_per_mpa, at),
        }
    }
}

/// Specific wear rate of an unloaded surface, 1/MPa; 0 where nothing wears.
pub fn coefficient(law: Option<WearLaw>) -> f64 {
    law.map_or(0.0, |law| law.rate(LocalState::default()).value)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [WearLaw; 1] = [WearLaw::Archard {
        k_over_h_per_mpa: 2.5761e-5,
    }];

    #[test]
    fn derivatives_are_those_of_the_value() {
        let at = LocalState {
            pressure: 150.0,
            slip: 0.02,
        };
        for law in LAWS {
            let rate = law.rate(at);
            let step = 1e-4;
            let value = |pressure: f64, slip: f64| law.rate(LocalState { pressure, slip }).value;
            let central = |more: f64, less: f64, h: f64| (more - less) / (2.0 * h);
            let h = step * at.pressure;
            let d_pressure = central(
                value(at.pressure + h, at.slip),
                value(at.pressure - h, at.slip),
                h,
            );
            let h = step * at.slip;
            let d_slip = central(
                value(at.pressure, at.slip + h),
                value(at.pressure, at.slip - h),
                h,
            );
            assert!((rate.d_pressure - d_pressure).abs() <= 1e-7 * rate.value / at.pressure);
            assert!((rate.d_slip - d_slip).abs() <= 1e-7 * rate.value / at.slip);
        }
    }

    #[test]
    fn a_surface_without_a_law_does_not_wear() {
        assert!(coefficient(None).abs() < f64::MIN_POSITIVE);
        assert!((coefficient(Some(LAWS[0])) - 2.5761e-5).abs() < 1e-20);
    }
}
