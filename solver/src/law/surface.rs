//! Wear of a surface: one law at every depth, or a curve of the depth over the dose, as that of the layers of a plating.
//!
//! Laws of which a power of the depth adds have that power as equivalent. A depth and its equivalent, the depth that the initial rate alone would have worn by the same dose, are equal where one law
//! holds at every depth. Doses add where depths do not: the wear of cycles is extrapolated in equivalent depths.

use std::borrow::Cow;
use std::ops::Range;

use super::dose::DoseCurve;
use super::pace::Pace;
use super::plating::{Layer, Layers};
use super::softening::{MOLTEN, Margins};
use super::wear::power::{Exposure, PowerLaw};
use super::wear::{LocalState, WearLaw};

/// Wear of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceWear {
    /// One law at every depth.
    Law(WearLaw),
    /// A depth that the dose determines.
    ByDose(DoseCurve),
    /// A depth of which a power adds.
    ByPower {
        /// Law.
        law: PowerLaw,
        /// Exposure during an increment; zero outside of one.
        during: Exposure,
    },
}

impl SurfaceWear {
    /// Wear of a plating over a base; `None` for a bare base that does not wear. Under a plating the base has a rate that is the
    /// same in every state, and does not wear otherwise.
    pub fn new(plating: &[Layer], base: Option<WearLaw>) -> Option<Self> {
        if plating.is_empty() {
            return base.map(|law| match law {
                WearLaw::Barwell(law) => Self::ByDose(DoseCurve::Barwell(law)),
                WearLaw::Power(law) => match law.as_archard() {
                    Some(k_over_h_per_mpa) => Self::Law(WearLaw::Archard { k_over_h_per_mpa }),
                    None => Self::ByPower {
                        law,
                        during: Exposure::default(),
                    },
                },
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
            Self::ByDose(_) | Self::ByPower { .. } => None,
        }
    }

    /// Volume by Archard's identity, rate times work of the normal force in N mm, mm^3: 0 without wear, `None` where the rate varies.
    pub(crate) fn volume_by_work(wear: Option<Self>, work: f64) -> Option<f64> {
        let rate = wear.map_or(Some(0.0), Self::uniform);
        rate.map(|rate| rate * work)
    }

    /// The wear as it is in an increment of an imposed displacement in mm at a pace.
    #[must_use]
    pub fn during(self, pace: Pace, distance_mm: f64) -> Self {
        match self {
            Self::Law(law) => Self::Law(law.at_pace(pace)),
            Self::ByDose(_) => self,
            Self::ByPower { law, .. } => Self::ByPower {
                law,
                during: law.exposure(pace, distance_mm),
            },
        }
    }

    /// The wear of a contact that is warmer than its surroundings by a rise in K, below the melting temperatures.
    #[must_use]
    pub(crate) fn heated(self, margins: &Margins, rise_k: f64) -> Self {
        if matches!(self, Self::Law(law) if law.has_given_temperature()) {
            return self;
        }
        let softened = |law: WearLaw| law.softened(margins.ratio(0, rise_k)).heated(rise_k);
        match self {
            Self::Law(law) => Self::Law(softened(law)),
            Self::ByDose(DoseCurve::Layers(layers)) => Self::ByDose(DoseCurve::Layers(
                layers.softened(|layer| margins.ratio(layer, rise_k)),
            )),
            Self::ByDose(DoseCurve::Barwell(law)) => {
                Self::ByDose(DoseCurve::Barwell(law.softened(margins.ratio(0, rise_k))))
            }
            Self::ByPower { law, during } => Self::ByPower {
                law: law.heated(rise_k),
                during,
            },
        }
    }

    /// Largest relative change of the rate of a layer, or of the law in a representative state, by a temperature rise in K. `rate` is that
    /// of a law.
    pub(crate) fn change_by_heat(
        self,
        margins: &Margins,
        at: LocalState,
        rate: impl Fn(WearLaw) -> f64,
        rise_k: f64,
    ) -> f64 {
        let layers = match self {
            Self::ByDose(DoseCurve::Layers(layers)) => layers.count(),
            _ => 0,
        };
        if matches!(self, Self::Law(law) if law.has_given_temperature()) {
            return 0.0;
        }
        let by_hardness = (0..=layers).map(|layer| margins.change(layer, rise_k));
        let largest = by_hardness.fold(0.0, f64::max);
        let by_law = match self {
            Self::Law(law) => rate(law.heated(rise_k)) / rate(law),
            Self::ByPower { law, .. } => {
                law.heated(rise_k).equivalent_rate(at) / law.equivalent_rate(at)
            }
            Self::ByDose(_) => 1.0,
        };
        // Of a law that wears nothing before and after.
        let by_law = if by_law.is_nan() { 1.0 } else { by_law };
        largest + (by_law - 1.0).abs().min(MOLTEN)
    }

    /// Returns `true` if the rate depends on the depth.
    pub fn depends_on_depth(self) -> bool {
        match self {
            Self::Law(_) => false,
            Self::ByDose(_) | Self::ByPower { .. } => true,
        }
    }

    /// The rate at which the equivalent grows by p |ds| in a representative state, 1/MPa, where it is no depth.
    pub(crate) fn equivalent_rate(self, at: LocalState) -> Option<f64> {
        match self {
            Self::Law(_) => None,
            Self::ByDose(curve) => Some(curve.initial_rate()),
            Self::ByPower { law, .. } => Some(law.equivalent_rate(at)),
        }
    }

    /// Returns `true` if it is by the time of slip.
    pub(crate) fn is_by_time(self) -> bool {
        matches!(self, Self::Law(WearLaw::OfSpeed(law)) if law.is_by_time())
    }

    /// Returns `true` if a pass wears a flat floor evenly by distance or by time, so that jumps in grooves can extrapolate it.
    pub(crate) fn is_even(self) -> bool {
        self.uniform().is_some() || self.dose_curve().is_some() || self.is_by_time()
    }

    /// Returns `true` if the wear of a pass is in proportion to its load, however this is distributed.
    pub(crate) fn is_proportional(self) -> bool {
        !matches!(self, Self::ByPower { .. })
    }

    /// The specific wear rate whose product with load and distance is the worn area of whole cycles at a mean pace, 1/MPa, if there
    /// is one.
    pub(crate) fn area_rate(self, mean: Pace) -> Option<f64> {
        if self.is_by_time() {
            self.during(mean, 0.0).uniform()
        } else {
            self.uniform()
        }
    }

    /// The rate at which the equivalent grows by the dose, 1/MPa, where it is the same in every state.
    pub fn dose_rate(self) -> Option<f64> {
        match self {
            Self::Law(law) => law.uniform(),
            Self::ByDose(curve) => Some(curve.initial_rate()),
            Self::ByPower { .. } => None,
        }
    }

    /// The curve of its depth over the dose, if it has one.
    pub(crate) fn dose_curve(self) -> Option<DoseCurve> {
        match self {
            Self::Law(_) | Self::ByPower { .. } => None,
            Self::ByDose(curve) => Some(curve),
        }
    }

    /// Returns `true` if a layer below the surface wears faster than the surface.
    pub(crate) fn quickens(self) -> bool {
        match self {
            Self::ByDose(curve) => curve.largest_rate(f64::INFINITY) > curve.initial_rate(),
            Self::Law(_) | Self::ByPower { .. } => false,
        }
    }

    /// Largest specific wear rate from the surface down to a depth in mm, at a representative state, 1/MPa.
    pub(crate) fn largest_rate(self, depth: f64, at: LocalState) -> f64 {
        match self {
            Self::Law(law) => law.rate(at).value,
            Self::ByDose(curve) => curve.largest_rate(depth),
            // A rate that falls has no bound on the unworn surface; that of the deepest place counts.
            Self::ByPower { law, .. } => WearLaw::Power(law).rate(LocalState { depth, ..at }).value,
        }
    }

    /// Mean specific wear rate from the surface down to a depth in mm, at a representative state, 1/MPa; 0 for a depth that wear
    /// does not reach.
    pub(crate) fn mean_rate(self, depth: f64, at: LocalState) -> f64 {
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
            Self::ByPower { law, .. } if depth > 0.0 => {
                depth * law.equivalent_rate(at) / law.equivalent(depth)
            }
            Self::ByPower { law, .. } => WearLaw::Power(law).rate(at).value,
        }
    }

    /// Largest depth that wear reaches, mm.
    pub fn deepest(self) -> f64 {
        match self {
            Self::Law(_) | Self::ByPower { .. } => f64::INFINITY,
            Self::ByDose(curve) => curve.deepest(),
        }
    }

    /// Equivalent of a depth, mm.
    pub fn equivalent(self, depth: f64) -> f64 {
        match self {
            Self::Law(_) => depth,
            Self::ByDose(curve) => curve.equivalent(depth),
            Self::ByPower { law, .. } => law.equivalent(depth),
        }
    }

    /// Depths around one between which no layer wears faster than the one above it, mm.
    pub(crate) fn without_faster(self, depth: f64) -> Range<f64> {
        match self {
            Self::Law(_) | Self::ByPower { .. } => 0.0..f64::INFINITY,
            Self::ByDose(curve) => curve.without_faster(depth),
        }
    }

    /// Depth of an equivalent, mm.
    pub fn depth(self, equivalent: f64) -> f64 {
        match self {
            Self::Law(_) => equivalent,
            Self::ByDose(curve) => curve.depth(equivalent),
            Self::ByPower { law, .. } => law.depth(equivalent),
        }
    }

    /// Specific wear rate at a depth in mm over that of the unworn surface, -.
    pub(crate) fn relative_rate(self, depth: f64) -> f64 {
        match self {
            Self::Law(_) => 1.0,
            Self::ByDose(curve) => curve.rate(depth) / curve.initial_rate(),
            Self::ByPower { law, .. } => law.depth_per_equivalent(depth),
        }
    }
}

/// Equivalents of the depths of a surface, mm.
pub(crate) fn equivalents(wear: Option<SurfaceWear>, depth: &[f64]) -> Cow<'_, [f64]> {
    match wear.filter(|wear| wear.depends_on_depth()) {
        None => Cow::Borrowed(depth),
        Some(wear) => depth.iter().map(|depth| wear.equivalent(*depth)).collect(),
    }
}

/// Depths of equivalents, mm.
pub fn depths(wear: Option<SurfaceWear>, equivalent: Vec<f64>) -> Vec<f64> {
    match wear.filter(|wear| wear.depends_on_depth()) {
        None => equivalent,
        Some(wear) => equivalent.iter().map(|depth| wear.depth(*depth)).collect(),
    }
}

/// Depths of a surface a part of the way from one state to a later one, mm, its doses growing evenly. Where wear has ended at the later
/// depth, the dose that reached it is not known: it grew at least by the `pace`, what the equivalents would grow by on the whole way as
/// before; none is known of nodes beyond its end.
pub(crate) fn between(
    wear: Option<SurfaceWear>,
    before: &[f64],
    after: &[f64],
    pace: impl Iterator<Item = f64>,
    part: f64,
) -> Vec<f64> {
    let ways = before.iter().zip(after);
    let Some(wear) = wear else {
        let even = |(before, after): (&f64, &f64)| before + part * (after - before);
        return ways.map(even).collect();
    };
    let node = |((before, after), pace): ((&f64, &f64), f64)| {
        let (from, to) = (wear.equivalent(*before), wear.equivalent(*after));
        let grown = if *after >= wear.deepest() {
            pace.max(to - from)
        } else {
            to - from
        };
        let equivalent = from + part * grown;
        if equivalent >= to {
            *after
        } else {
            wear.depth(equivalent)
        }
    };
    ways.zip(pace.chain(std::iter::repeat(0.0)))
        .map(node)
        .collect()
}

/// Values at the nodes of a surface times the rates at their depths in mm over that of the unworn surface.
pub(crate) fn at_relative_rates<'a>(
    wear: Option<SurfaceWear>,
    values: &'a [f64],
    depth: &[f64],
) -> Cow<'a, [f64]> {
    match wear.filter(|wear| wear.depends_on_depth()) {
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
mod tests;
