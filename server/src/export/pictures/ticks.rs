//! Range and ticks of an axis, as coordinates along it.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

use crate::export::pictures::axis::{Axis, AxisRange, Scale};

/// Margin on either side over the range of the data.
const MARGIN: f64 = 0.03;
/// Maximum number of intervals between the ticks of a linear axis.
const MOST_TICKS: f64 = 7.0;
/// Below this number of decades, 2 and 5 are labelled too.
const FEW_DECADES: f64 = 2.5;

/// Ends of an axis, and its labelled (major) and unlabelled (minor) ticks, as coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ticks {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) major: Vec<f64>,
    pub(crate) minor: Vec<f64>,
}

impl Ranged for Ticks {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, coordinate: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range()).map(coordinate, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.minor.clone()
        } else {
            self.major.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

/// Range and ticks for values along an axis.
pub(crate) fn ticks(axis: &Axis, values: impl Iterator<Item = f64>) -> Ticks {
    let (from, to) = range(axis, values);
    match axis.scale {
        Scale::Linear | Scale::Downward => linear(from, to),
        Scale::Logarithmic => logarithmic(from, to),
    }
}

fn range(axis: &Axis, values: impl Iterator<Item = f64>) -> (f64, f64) {
    let coordinate = |value: f64| axis.scale.coordinate(value);
    if let AxisRange::Fixed(from, to) = axis.range
        && let (Some(from), Some(to)) = (coordinate(from), coordinate(to))
    {
        return (from.min(to), from.max(to));
    }
    let zero = (axis.range == AxisRange::DataAndZero).then_some(0.0);
    let coordinates = values.chain(zero).filter_map(coordinate);
    let (low, high) = coordinates.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(low, high), coordinate| (low.min(coordinate), high.max(coordinate)),
    );
    if low > high {
        return (0.0, 1.0);
    }
    // Constant data get a range around their value.
    let width = if high > low {
        high - low
    } else {
        high.abs().max(1.0)
    };
    let margin = MARGIN * width;
    let touches_zero = |end: f64| axis.range == AxisRange::DataAndZero && end == 0.0;
    let from = if touches_zero(low) { low } else { low - margin };
    let to = if touches_zero(high) {
        high
    } else {
        high + margin
    };
    (from, to)
}

/// Ticks at 1, 2 or 5 times a power of ten.
fn linear(from: f64, to: f64) -> Ticks {
    let step = step(to - from);
    Ticks {
        from,
        to,
        major: multiples(from, to, step),
        minor: Vec::new(),
    }
}

fn step(width: f64) -> f64 {
    let coarse = width / MOST_TICKS;
    let decade = 10.0_f64.powf(coarse.log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|factor| factor * decade)
        .find(|step| *step >= coarse)
        .unwrap_or(10.0 * decade)
}

/// Multiples of a step within a range.
fn multiples(from: f64, to: f64, step: f64) -> Vec<f64> {
    let first = (from / step - 1e-9).ceil();
    (0_u32..64)
        .map(|index| (first + f64::from(index)) * step)
        .take_while(|coordinate| *coordinate <= to + 1e-9 * step)
        .collect()
}

fn logarithmic(from: f64, to: f64) -> Ticks {
    let inside = |coordinate: &f64| (from - 1e-9..=to + 1e-9).contains(coordinate);
    let at = |factors: &[f64]| -> Vec<f64> {
        let decades = multiples(from.floor(), to.ceil(), 1.0);
        let coordinates = decades
            .iter()
            .flat_map(|decade| factors.iter().map(move |factor| decade + factor.log10()));
        coordinates.filter(inside).collect()
    };
    let major: &[f64] = if to - from < FEW_DECADES {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    Ticks {
        from,
        to,
        major: at(major),
        minor: at(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
    }
}

/// The label of a tick, with as many decimals as the tick interval has.
pub(crate) fn label(scale: Scale, ticks: &Ticks, coordinate: f64) -> String {
    let value = scale.value(coordinate);
    let unit = match scale {
        Scale::Linear | Scale::Downward => step(ticks.to - ticks.from),
        Scale::Logarithmic => value,
    };
    if value.abs() >= 1e6 {
        return format!("{value:.0e}");
    }
    let (mut decimals, mut unit) = (0, unit);
    while unit < 0.999 && decimals < 12 {
        unit *= 10.0;
        decimals += 1;
    }
    // Avoids "-0".
    let value = if value.abs() < 1e-9 * 10.0_f64.powi(-decimals) {
        0.0
    } else {
        value
    };
    let decimals = usize::try_from(decimals).unwrap_or_default();
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, values: &[f64]) -> Vec<String> {
        let ticks = ticks(axis, values.iter().copied());
        let label = |coordinate: &f64| label(axis.scale, &ticks, *coordinate);
        ticks.major.iter().map(label).collect()
    }

    #[test]
    fn linear_ticks_are_round_numbers_inside_the_data() {
        let axis = Axis::new("x", Scale::Linear);
        assert_eq!(
            labels(&axis, &[-0.31, 0.3]),
            ["-0.3", "-0.2", "-0.1", "0.0", "0.1", "0.2", "0.3"]
        );
        assert_eq!(
            labels(&axis, &[0.0, 18_000.0]).last().map(String::as_str),
            Some("15000")
        );
    }

    #[test]
    fn depths_grow_downwards_from_zero() {
        let axis = Axis::new("depth", Scale::Downward).with_range(AxisRange::DataAndZero);
        assert_eq!(
            labels(&axis, &[0.5, 2.7]),
            ["2.5", "2.0", "1.5", "1.0", "0.5", "0.0"]
        );
        assert!(ticks(&axis, [2.7].into_iter()).to.abs() < 1e-12);
    }

    #[test]
    fn decades_are_labelled_and_values_that_are_not_positive_are_omitted() {
        let axis = Axis::new("error", Scale::Logarithmic);
        assert_eq!(
            labels(&axis, &[0.0, -1.0, 0.009, 0.9, 20.0]),
            ["0.01", "0.1", "1", "10"]
        );
        assert_eq!(labels(&axis, &[0.9, 6.0]), ["1", "2", "5"]);
    }

    #[test]
    fn an_axis_without_data_has_ticks() {
        for scale in [Scale::Linear, Scale::Downward, Scale::Logarithmic] {
            assert!(!labels(&Axis::new("", scale), &[]).is_empty());
        }
    }
}
