//! Depths over doses of both surfaces.

use std::ops::Range;

use crate::law::surface::SurfaceWear;
use crate::sides::{Side, Sides};

/// Wear of both surfaces, each a function of the dose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DoseLaws(Sides<Option<SurfaceWear>>);

impl DoseLaws {
    /// The laws of surfaces that wear by dose alone, one of them at least.
    pub(crate) fn of(wear: &Sides<Option<SurfaceWear>>) -> Option<Self> {
        let is_by_dose = |wear: Option<SurfaceWear>| wear.is_none_or(|wear| rate(wear) > 0.0);
        let wears = wear.slider.is_some() || wear.receptacle.is_some();
        (wears && is_by_dose(wear.slider) && is_by_dose(wear.receptacle)).then_some(Self(*wear))
    }

    /// The sides that wear.
    pub(crate) fn wears(&self) -> Sides<bool> {
        self.0.map(|wear| wear.is_some())
    }

    /// Rate at which the equivalent of a side grows by the dose, 1/MPa; 0 of one that does not wear.
    pub(crate) fn rate(&self, side: Side) -> f64 {
        self.0.of(side).map_or(0.0, rate)
    }

    /// Doses of depths in mm, MPa mm; none of a side that does not wear.
    pub(crate) fn doses(&self, depth: &Sides<Vec<f64>>) -> Sides<Vec<f64>> {
        Sides::from_fn(|side| match self.0.of(side) {
            None => vec![0.0; depth.of(side).len()],
            Some(wear) => {
                let dose = |depth: &f64| wear.equivalent(*depth) / rate(*wear);
                depth.of(side).iter().map(dose).collect()
            }
        })
    }

    /// Depth of a dose, mm.
    pub(crate) fn depth(&self, side: Side, dose: f64) -> f64 {
        self.0
            .of(side)
            .map_or(0.0, |wear| wear.depth(dose * rate(wear)))
    }

    /// Doses around that of a depth in mm between which no layer wears faster than the one above it, MPa mm.
    pub(crate) fn without_faster(&self, side: Side, depth: f64) -> Range<f64> {
        let Some(wear) = self.0.of(side) else {
            return 0.0..f64::INFINITY;
        };
        let layer = wear.without_faster(depth);
        let dose = |depth: f64| {
            if depth.is_finite() {
                wear.equivalent(depth) / rate(*wear)
            } else {
                f64::INFINITY
            }
        };
        dose(layer.start)..dose(layer.end)
    }

    /// Specific wear rate at a depth in mm, 1/MPa.
    pub(crate) fn slope(&self, side: Side, depth: f64) -> f64 {
        let wear = self.0.of(side);
        wear.map_or(0.0, |wear| wear.relative_rate(depth) * rate(wear))
    }
}

/// Rate at which the equivalent grows by the dose, 1/MPa; 0 of one whose wear is no function of the dose.
fn rate(wear: SurfaceWear) -> f64 {
    wear.dose_rate().unwrap_or(0.0)
}
