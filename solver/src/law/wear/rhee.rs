//! Rhee's law of friction materials (thesis, equation 4): dW = K F^a V^b t^c, here as depth under a pressure,
//!   h = K p^a v^b t^c.
//!
//! K, a, b, c: fitted constants; p: pressure, MPa; v: speed, mm/s; t: time of slip, s; h: worn depth, mm. The source gives the loss of
//! weight under a force that does not change. Under one that does, h^(1/c) adds (`power`): d(h^(1/c)) = (K p^a v^b)^(1/c) dt.
//!
//! Range: empirical, of brake linings against iron (Rhee 1970); the constants of other pairs are not published. a >= 1 and a >= c.
//! Limiting case: a = b = c = 1 is Archard's law with k/H = K.

use super::power::{Measure, PowerLaw};

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rhee {
    /// Factor K, mm/(MPa^a (mm/s)^b s^c).
    pub factor: f64,
    /// Exponent a of the pressure, -.
    pub pressure_exponent: f64,
    /// Exponent b of the speed, -.
    pub speed_exponent: f64,
    /// Exponent c of the time, -.
    pub time_exponent: f64,
}

impl Rhee {
    /// The law in the form in which it adds.
    pub fn power_law(&self) -> PowerLaw {
        let Self {
            factor,
            pressure_exponent: a,
            speed_exponent: b,
            time_exponent: c,
        } = *self;
        PowerLaw {
            exponent: c,
            factor: factor.powf(c.recip()),
            pressure_exponent: a / c,
            measure: Measure::SlipTime {
                speed_exponent: b / c,
            },
            thermal: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::pace::Pace;
    use crate::law::wear::LocalState;
    use crate::law::wear::power;

    /// K = 2e-9, a = 1.2, b = 0.8 under 150 MPa over 0.02 mm at 10 mm/s.
    #[test]
    fn recession_of_a_lining() {
        let depth = |c: f64, depth: f64| {
            let law = Rhee {
                factor: 2e-9,
                pressure_exponent: 1.2,
                speed_exponent: 0.8,
                time_exponent: c,
            };
            let at = LocalState {
                pressure: 150.0,
                slip: 0.02,
                depth,
                pace: Pace::at_speed(10.0),
            };
            let rate = power::rate(law.power_law(), at);
            let by_pressure = (rate.value + rate.d_pressure * at.pressure) * at.slip;
            (rate.value * at.pressure * at.slip, by_pressure)
        };
        let (worn, _) = depth(1.0, 0.0);
        assert!((worn / 1.031_263e-8 - 1.0).abs() < 1e-6, "{worn}");
        let (worn, by_pressure) = depth(0.9, 1e-5);
        assert!((worn / 8.622_415e-9 - 1.0).abs() < 1e-6, "{worn}");
        assert!(
            (by_pressure / 7.664_0e-11 - 1.0).abs() < 1e-4,
            "{by_pressure}"
        );
    }
}
