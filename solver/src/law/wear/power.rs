//! Laws of which a power of the depth adds: with the exponent c of a course h ~ w^c under a constant pressure,
//!   y = h^(1/c),  dy = A p^m dw,
//! p pressure, MPa; w the measure of the course: time of slip, time, or repetitions of the load; h depth, mm; A a factor in the units of
//! the others.
//!
//! The course depends on h alone, not on when it was worn (strain hardening): under another pressure it continues from the depth that has
//! been reached. An increment is exact for a constant pressure, h1 = (h0^(1/c) + A p^m dw)^c, whatever its length; Euler's backward
//! step is not, and where c < 1 has no finite rate to begin with. Limiting case: c = m = 1 with the time of slip is Archard's law.
//!
//! Range: m >= 1 and m c >= 1, so that the recession has a finite derivative where the contact opens, on worn and on unworn surfaces.

use super::rate::{LocalState, Rate};
use crate::law::pace::Pace;
use crate::law::temperature::Temperature;

/// Measure of the course of wear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// The time of slip, s, times a power of the speed, mm/s.
    SlipTime {
        /// Exponent of the speed, -.
        speed_exponent: f64,
    },
    /// The time, s, whether the point slips or sticks.
    Time,
    /// Cycles of the motion, of which an increment is the part of its displacement; whether the point slips or sticks.
    Repetitions,
}

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Exponent c of the course, -.
    pub exponent: f64,
    /// Factor A.
    pub factor: f64,
    /// Exponent m of the pressure, -.
    pub pressure_exponent: f64,
    /// Measure w of the course.
    pub measure: Measure,
    /// How the factor depends on the temperature, if it does.
    pub thermal: Option<Thermal>,
}

/// A factor exp(-C/T).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thermal {
    /// C, K.
    pub activation_k: f64,
    /// T.
    pub temperature: Temperature,
}

impl Thermal {
    /// The factor, -.
    pub fn factor(self) -> f64 {
        (-self.activation_k / self.temperature.kelvin()).exp()
    }
}

/// Increase of y during an increment: f p^m, times the slip in mm where it counts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Exposure {
    factor: f64,
    pressure_exponent: f64,
    by_slip: bool,
}

impl Exposure {
    /// The increase of y under a pressure in MPa and over a slip in mm, with its derivatives by both.
    pub(crate) fn increase(&self, pressure: f64, slip: f64) -> [f64; 3] {
        if pressure <= 0.0 {
            return [0.0; 3];
        }
        let below = self.factor * pressure.powf(self.pressure_exponent - 1.0);
        let power = below * pressure;
        let by_pressure = self.pressure_exponent * below;
        if self.by_slip {
            [power * slip, by_pressure * slip, power]
        } else {
            [power, by_pressure, 0.0]
        }
    }
}

impl PowerLaw {
    /// The law of a contact that is warmer than its surroundings by a rise in K.
    #[must_use]
    pub fn heated(self, rise_k: f64) -> Self {
        let Some(thermal) = self.thermal else {
            return self;
        };
        let heated = Thermal {
            temperature: thermal.temperature.raised(rise_k),
            ..thermal
        };
        Self {
            factor: self.factor / thermal.factor() * heated.factor(),
            thermal: Some(heated),
            ..self
        }
    }

    /// The specific wear rate where the law is Archard's: without exponents, by the path of slip; 1/MPa.
    pub(crate) fn as_archard(&self) -> Option<f64> {
        let is_one = |exponent: f64| (exponent - 1.0).abs() <= 0.0;
        let by_path =
            matches!(self.measure, Measure::SlipTime { speed_exponent } if is_one(speed_exponent));
        (by_path
            && is_one(self.exponent)
            && is_one(self.pressure_exponent)
            && self.thermal.is_none())
        .then_some(self.factor)
    }

    /// Returns `true` if it counts repetitions of the load.
    pub fn counts_repetitions(&self) -> bool {
        self.measure == Measure::Repetitions
    }

    /// Exposure of an increment of an imposed displacement in mm at a pace.
    pub(crate) fn exposure(&self, pace: Pace, distance_mm: f64) -> Exposure {
        let measure = match self.measure {
            Measure::SlipTime { .. } if pace.s_per_mm <= 0.0 => 0.0,
            Measure::SlipTime { speed_exponent } => pace.s_per_mm.powf(1.0 - speed_exponent),
            Measure::Time => pace.s_per_mm * distance_mm,
            Measure::Repetitions => pace.cycles_per_mm * distance_mm,
        };
        Exposure {
            factor: self.factor * measure,
            pressure_exponent: self.pressure_exponent,
            by_slip: matches!(self.measure, Measure::SlipTime { .. }),
        }
    }

    /// y of a depth in mm.
    pub fn equivalent(&self, depth: f64) -> f64 {
        depth.max(0.0).powf(self.exponent.recip())
    }

    /// Depth of y, mm.
    pub fn depth(&self, equivalent: f64) -> f64 {
        equivalent.max(0.0).powf(self.exponent)
    }

    /// Depth per y at a depth in mm; none where nothing has worn yet.
    pub(crate) fn depth_per_equivalent(&self, depth: f64) -> f64 {
        if depth > 0.0 {
            self.exponent * depth.powf(1.0 - self.exponent.recip())
        } else {
            0.0
        }
    }

    /// Depth by which an increase of y recedes a surface that is worn to a depth, mm, and the depth per y that it ends with.
    pub(crate) fn recession(&self, depth: f64, increase: f64) -> (f64, f64) {
        if increase <= 0.0 {
            return (0.0, self.depth_per_equivalent(depth));
        }
        let before = self.equivalent(depth);
        let after = self.depth(before + increase);
        let worn = if before > increase {
            // Not as a difference of nearly equal depths.
            depth * (self.exponent * (increase / before).ln_1p()).exp_m1()
        } else {
            after - depth.max(0.0)
        };
        (worn, self.exponent * after / (before + increase))
    }

    /// y that a slip adds under the pressure of a state, which slips as it is imposed.
    fn increase(&self, at: LocalState) -> [f64; 3] {
        self.exposure(at.pace, at.slip)
            .increase(at.pressure, at.slip)
    }

    /// y for each MPa mm of a state.
    pub(crate) fn equivalent_rate(&self, at: LocalState) -> f64 {
        self.increase(at)[0] / (at.pressure * at.slip)
    }
}

/// Mean specific wear rate over an increment that begins at the depth of a state, with its derivatives.
pub(super) fn rate(law: PowerLaw, at: LocalState) -> Rate {
    let [increase, by_pressure, _] = law.increase(at);
    let dose = at.pressure * at.slip;
    if dose <= 0.0 {
        return Rate::default();
    }
    let (worn, end) = law.recession(at.depth, increase);
    let value = worn / dose;
    Rate {
        value,
        d_pressure: end * by_pressure / dose - value / at.pressure,
        // All measures are in proportion to the imposed displacement.
        d_slip: end * increase / at.slip / dose - value / at.slip,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(exponent: f64) -> PowerLaw {
        PowerLaw {
            exponent,
            factor: 1e-6,
            pressure_exponent: 1.5,
            measure: Measure::SlipTime {
                speed_exponent: 0.5,
            },
            thermal: None,
        }
    }

    #[test]
    fn many_increments_wear_as_one() {
        for exponent in [0.5, 0.9, 1.0, 2.0] {
            let law = law(exponent);
            let mut depth = 0.0;
            for _ in 0..1_000 {
                depth += law.recession(depth, 1e-8).0;
            }
            let once = law.recession(0.0, 1e-5).0;
            assert!((depth / once - 1.0).abs() < 1e-11, "{exponent}: {depth}");
            assert!((law.depth(law.equivalent(once)) / once - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn the_end_of_a_recession_is_its_derivative() {
        for exponent in [0.5, 0.9, 1.0, 2.0] {
            for (depth, increase) in [(0.0, 1e-6), (1e-4, 1e-6), (1e-4, 1e-12)] {
                let recession = |increase| law(exponent).recession(depth, increase);
                let h = 1e-5 * increase;
                let slope = (recession(increase + h).0 - recession(increase - h).0) / (2.0 * h);
                let end = recession(increase).1;
                assert!(
                    (slope / end - 1.0).abs() < 1e-5,
                    "{exponent}: {slope} {end}"
                );
            }
        }
    }

    #[test]
    fn an_unloaded_point_does_not_wear() {
        let exposure = law(0.9).exposure(Pace::at_speed(10.0), 0.1);
        assert!(
            exposure
                .increase(0.0, 0.1)
                .iter()
                .all(|value| *value <= 0.0)
        );
        assert_eq!(law(0.9).recession(0.0, 0.0), (0.0, 0.0));
    }
}
