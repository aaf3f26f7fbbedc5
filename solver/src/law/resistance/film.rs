//! Resistance of a film on a metal: R = sigma_f/A over the area of real contact A, with the specific resistance sigma_f, ohm mm^2 (Holm,
//! *Electric Contacts*, 1967, section 1). A film that grows has
//!   sigma_f(t) = sigma_f (t/t0)^m,
//! m = 1/2 parabolic, 1 linear, from none at t = 0. The current crosses it evenly, that of a film far more resistive than the
//! constriction. Range: films that do not break, neither by the voltage nor by the slip. Limiting case: m = 0, a film that is there at once.

/// A film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Specific resistance sigma_f, ohm mm^2; of a film that grows after the time t0.
    pub specific_resistance_ohm_mm2: f64,
    /// Growth; `None` for a film that is there at once.
    pub growth: Option<Growth>,
}

/// Growth of a film by a power of the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Exponent m, -.
    pub exponent: f64,
    /// Time t0, s.
    pub time_s: f64,
}

impl Film {
    /// Specific resistance at an age in s, ohm mm^2.
    pub(crate) fn at_age(&self, age_s: f64) -> f64 {
        let grown = self.growth.map_or(1.0, |growth| {
            (age_s.max(0.0) / growth.time_s).powf(growth.exponent)
        });
        self.specific_resistance_ohm_mm2 * grown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabolic_film_is_twice_as_resistive_after_four_times_the_time() {
        let film = |growth| Film {
            specific_resistance_ohm_mm2: 3e-5,
            growth,
        };
        assert!((film(None).at_age(0.0) - 3e-5).abs() < 1e-20);
        let growing = film(Some(Growth {
            exponent: 0.5,
            time_s: 100.0,
        }));
        let at = |age| growing.at_age(age);
        assert!((at(400.0) - 6e-5).abs() < 1e-18 && at(0.0) <= 0.0);
    }
}
