//! Laws by dose: the worn depth of a point is a function h = G(D) of its dose D = int p |ds|, MPa mm.
//!
//! The dose of a depth, the inverse of G, is no state of its own, and an increment of a dose dD wears G(D + dD) - G(D) whatever the
//! increments: one of n cycles wears as n of one cycle. Doses add where depths do not: what is extrapolated or compared is the
//! equivalent of a depth, that which the initial rate alone would have worn by the same dose.

use std::ops::Range;

use super::plating::Layers;
use super::wear::barwell::Barwell;

/// A depth as a function of the dose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DoseCurve {
    /// Layers over a base.
    Layers(Layers),
    /// An exponential course.
    Barwell(Barwell),
}

impl DoseCurve {
    /// Specific wear rate at a depth in mm, 1/MPa.
    pub fn rate(&self, depth: f64) -> f64 {
        match self {
            Self::Layers(layers) => layers.rate(depth),
            Self::Barwell(law) => law.rate(depth),
        }
    }

    /// Specific wear rate of the unworn surface, 1/MPa.
    pub(crate) fn initial_rate(&self) -> f64 {
        match self {
            Self::Layers(layers) => layers.outer_rate(),
            Self::Barwell(law) => law.rate_per_mpa,
        }
    }

    /// Largest specific wear rate from the surface down to a depth in mm, 1/MPa.
    pub(crate) fn largest_rate(&self, depth: f64) -> f64 {
        match self {
            Self::Layers(layers) => layers.largest_rate(depth),
            Self::Barwell(law) => law.largest_rate(depth),
        }
    }

    /// Depth by which a dose in MPa mm recedes a surface that is worn to a depth, mm, and the rate that it ends with, 1/MPa.
    pub(crate) fn recession(&self, depth: f64, dose: f64) -> (f64, f64) {
        match self {
            Self::Layers(layers) => layers.recession(depth, dose),
            Self::Barwell(law) => law.recession(depth, dose),
        }
    }

    /// Equivalent of a depth, mm; from the largest depth that wear reaches on that of the least dose that reaches it.
    pub fn equivalent(&self, depth: f64) -> f64 {
        match self {
            Self::Layers(layers) => layers.equivalent(depth),
            Self::Barwell(law) => law.equivalent(depth),
        }
    }

    /// Depth whose equivalent is this, mm.
    pub fn depth(&self, equivalent: f64) -> f64 {
        self.recession(0.0, equivalent / self.initial_rate()).0
    }

    /// Depths around one between which no layer wears faster than the one above it, mm.
    pub(crate) fn without_faster(&self, depth: f64) -> Range<f64> {
        match self {
            Self::Layers(layers) => layers.without_faster(depth),
            Self::Barwell(_) => 0.0..f64::INFINITY,
        }
    }

    /// Largest depth that wear reaches, mm.
    pub fn deepest(&self) -> f64 {
        match self {
            Self::Layers(layers) => layers.deepest(),
            Self::Barwell(law) => law.deepest(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::plating::Layer;
    use crate::law::wear::barwell::Course;

    fn curves() -> [DoseCurve; 3] {
        let layer = |thickness_mm, rate_per_mpa| Layer {
            thickness_mm,
            rate_per_mpa,
        };
        let layers = Layers::new(&[layer(0.76e-3, 1e-8), layer(1.27e-3, 4e-8)], 2e-7);
        let barwell = |course| {
            DoseCurve::Barwell(Barwell {
                rate_per_mpa: 2e-8,
                dose_mpa_mm: 7e4,
                course,
            })
        };
        [
            DoseCurve::Layers(layers),
            barwell(Course::Decelerating),
            barwell(Course::Accelerating),
        ]
    }

    #[test]
    fn the_rate_is_the_derivative_of_the_depth() {
        for curve in curves() {
            for dose in [0.0, 1e3, 5e4, 9e4, 2e5] {
                let (worn, rate) = curve.recession(0.0, dose);
                let more = curve.recession(worn, 1.0).0;
                assert!((more / rate - 1.0).abs() < 1e-4, "{curve:?} {dose}");
                assert!((rate / curve.rate(worn) - 1.0).abs() < 1e-12);
                assert!(curve.largest_rate(worn) >= rate * (1.0 - 1e-15));
            }
        }
    }

    #[test]
    fn equivalents_are_the_initial_rate_times_the_dose() {
        for curve in curves() {
            for dose in [0.0, 10.0, 5e4, 9e4, 2e5] {
                let worn = curve.recession(0.0, dose).0;
                let (found, expected) = (curve.equivalent(worn), dose * curve.initial_rate());
                assert!((found - expected).abs() <= 1e-12 * expected, "{curve:?}");
                assert!((curve.depth(found) - worn).abs() <= 1e-12 * worn);
            }
        }
    }
}
