//! Wear of a surface: one law at every depth, or a curve of the depth over the dose, as that of the layers of a plating.
//!
//! A depth and its equivalent, the depth that the initial rate alone would have worn by the same dose, are equal where one law
//! holds at every depth. Doses add where depths do not: the wear of cycles is extrapolated in equivalent depths.

use std::borrow::Cow;

use super::dose::DoseCurve;
use super::pace::Pace;
use super::plating::{Layer, Layers};
use super::wear::{LocalState, WearLaw};

/// Wear of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceWear {
    /// One law at every depth.
    Law(WearLaw),
    /// A depth that the dose determines.
    ByDose(DoseCurve),
}

impl SurfaceWear {
    /// That of a plating over a base; `None` for a bare base that does not wear. Under a plating the base has a rate that is the
    /// same in every state, and does not wear otherwise.
    pub fn new(plating: &[Layer], base: Option<WearLaw>) -> Option<Self> {
        if plating.is_empty() {
            return base.map(|law| match law {
                WearLaw::Barwell(law) => Self::ByDose(DoseCurve::Barwell(law)),
                law => Self::Law(law),
            });
        }
        let base = base.and_then(WearLaw::uniform).unwrap_or(0.0);
        Some(Self::ByDose(DoseCurve::Layers(Layers::new(plating, base))))
    }

    /// The specific wear rate of one that is the same in every state and at every depth, 1/MPa.
    pub fn uniform(self) -> Option<f64> {
        match self {
            Self::Law(law) => law.uniform(),
            Self::ByDose(_) => None,
        }
    }

    /// The wear as it is at a pace.
    #[must_use]
    pub fn at_pace(self, pace: Pace) -> Self {
        match self {
            Self::Law(law) => Self::Law(law.at_pace(pace)),
            Self::ByDose(_) => self,
        }
    }

    /// Whether it is by the time of slip.
    pub fn is_by_time(self) -> bool {
        matches!(self, Self::Law(WearLaw::OfSpeed(law)) if law.is_by_time())
    }

    /// Whether a pass wears a flat floor evenly by distance or by time, so that jumps in grooves can extrapolate it.
    pub fn is_even(self) -> bool {
        self.uniform().is_some() || self.dose_curve().is_some() || self.is_by_time()
    }

    /// The specific wear rate whose product with load and distance is the worn area of whole cycles at a mean pace, 1/MPa, if there
    /// is one.
    pub fn area_rate(self, mean: Pace) -> Option<f64> {
        if self.is_by_time() {
            self.at_pace(mean).uniform()
        } else {
            self.uniform()
        }
    }

    /// The curve of its depth over the dose, if it has one.
    pub fn dose_curve(self) -> Option<DoseCurve> {
        match self {
            Self::Law(_) => None,
            Self::ByDose(curve) => Some(curve),
        }
    }

    /// Largest specific wear rate from the surface down to a depth in mm, at a representative state, 1/MPa.
    pub fn largest_rate(self, depth: f64, at: LocalState) -> f64 {
        match self {
            Self::Law(law) => law.rate(at).value,
            Self::ByDose(curve) => curve.largest_rate(depth),
        }
    }

    /// Mean specific wear rate from the surface down to a depth in mm, at a representative state, 1/MPa; 0 for a depth that wear
    /// does not reach.
    pub fn mean_rate(self, depth: f64, at: LocalState) -> f64 {
        match self {
            Self::Law(law) => law.rate(at).value,
            Self::ByDose(curve) => {
                let equivalent = curve.equivalent(depth);
                let share = if depth > curve.deepest() {
                    0.0
                } else if equivalent > 0.0 {
                    depth / equivalent
                } else {
                    1.0
                };
                share * curve.initial_rate()
            }
        }
    }

    /// Largest depth that wear reaches, mm.
    pub fn deepest(self) -> f64 {
        match self {
            Self::Law(_) => f64::INFINITY,
            Self::ByDose(curve) => curve.deepest(),
        }
    }

    /// Equivalent of a depth, mm.
    pub fn equivalent(self, depth: f64) -> f64 {
        match self {
            Self::Law(_) => depth,
            Self::ByDose(curve) => curve.equivalent(depth),
        }
    }

    /// Depth of an equivalent, mm.
    pub fn depth(self, equivalent: f64) -> f64 {
        match self {
            Self::Law(_) => equivalent,
            Self::ByDose(curve) => curve.depth(equivalent),
        }
    }

    /// Specific wear rate at a depth in mm over that of the unworn surface, -.
    pub fn relative_rate(self, depth: f64) -> f64 {
        match self {
            Self::Law(_) => 1.0,
            Self::ByDose(curve) => curve.rate(depth) / curve.initial_rate(),
        }
    }
}

/// Equivalents of the depths of a surface, mm.
pub fn equivalents(wear: Option<SurfaceWear>, depth: &[f64]) -> Cow<'_, [f64]> {
    match wear.and_then(SurfaceWear::dose_curve) {
        None => Cow::Borrowed(depth),
        Some(curve) => depth.iter().map(|depth| curve.equivalent(*depth)).collect(),
    }
}

/// Depths of equivalents, mm.
pub fn depths(wear: Option<SurfaceWear>, equivalent: Vec<f64>) -> Vec<f64> {
    match wear.and_then(SurfaceWear::dose_curve) {
        None => equivalent,
        Some(curve) => equivalent.iter().map(|depth| curve.depth(*depth)).collect(),
    }
}

/// Values at the nodes of a surface times the rates at their depths in mm over that of the unworn surface.
pub fn at_relative_rates<'a>(
    wear: Option<SurfaceWear>,
    values: &'a [f64],
    depth: &[f64],
) -> Cow<'a, [f64]> {
    match wear.filter(|wear| wear.dose_curve().is_some()) {
        None => Cow::Borrowed(values),
        Some(wear) => {
            let nodes = values.iter().zip(depth);
            nodes
                .map(|(value, depth)| value * wear.relative_rate(*depth))
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_without_a_plating_has_its_depth_as_equivalent() {
        let law = WearLaw::Archard {
            k_over_h_per_mpa: 2e-8,
        };
        let bare = SurfaceWear::new(&[], Some(law));
        let depth = [0.0, 1e-3];
        assert!(matches!(equivalents(bare, &depth), Cow::Borrowed(_)));
        assert_eq!(SurfaceWear::new(&[], None), None);
        assert_eq!(bare.and_then(SurfaceWear::uniform), Some(2e-8));
    }

    #[test]
    fn a_plated_surface_wears_by_the_mean_rate_of_its_layers() {
        let layer = Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-8,
        };
        let base = WearLaw::Archard {
            k_over_h_per_mpa: 4e-8,
        };
        let plated = SurfaceWear::new(&[layer], Some(base));
        let at = LocalState::default();
        let rate = |depth| plated.map_or(0.0, |wear| wear.mean_rate(depth, at));
        // 1 um at 1e-8 takes as long as 4 um at 4e-8: 5 um at 2.5e-8.
        assert!((rate(5e-3) - 2.5e-8).abs() < 1e-20, "{}", rate(5e-3));
        assert!((rate(0.0) - 1e-8).abs() < 1e-22);
        let depth = [0.5e-3, 5e-3];
        let equivalent = equivalents(plated, &depth).into_owned();
        assert!((equivalent[1] - 2e-3).abs() < 1e-17, "{}", equivalent[1]);
        assert!((depths(plated, equivalent)[1] - 5e-3).abs() < 1e-17);
        assert_eq!(
            at_relative_rates(plated, &[1.0, 1.0], &depth)[..],
            [1.0, 4.0]
        );
    }
}
