//! Line simplification for clients that draw curves: Douglas-Peucker with a number of points instead of a tolerance.
//!
//! The ends and the extremes of every series are selected first. Then the segment with the largest distance between the
//! curve and its chord is split at the farthest point, until the number of points is reached. Distances are vertical
//! and relative to the range of each series, so that the choice of units does not matter.
//!
//! Source: D. H. Douglas and T. K. Peucker, *Cartographica* 10 (1973) 112-122, with a priority queue of the segments.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use api::results::{Loop, Pressure, Profile};
use solver::record::{CycleReport, Record};

use crate::export::columns;
use crate::number::real;

/// Fewest points that a client may request: enough for the ends and the extremes of a few series.
pub const FEWEST_POINTS: usize = 16;

/// Thins the rows of a wear history.
pub fn rows(rows: Vec<CycleReport>, points: usize) -> Vec<CycleReport> {
    if rows.len() <= points {
        return rows;
    }
    let stations = vec![0.0; rows[0].station_depth_mm.len()];
    let record = Record::new(&rows, &stations);
    let named = columns::of(&record);
    let series: Vec<&[f64]> = named
        .iter()
        .filter_map(|(_, values)| match values {
            columns::Values::Numbers(numbers) => Some(*numbers),
            columns::Values::Counts(_) => None,
        })
        .collect();
    let at: Vec<f64> = record.cycle.iter().map(|cycle| real(*cycle)).collect();
    let selected = select(&at, &series, points);
    let mut index = 0..;
    rows.into_iter()
        .filter(|_| index.next().is_some_and(|index| selected.contains(&index)))
        .collect()
}

/// Thins a profile, each side separately.
pub fn profile(mut profile: Profile, points: usize) -> Profile {
    for side in [&mut profile.receptacle, &mut profile.slider] {
        curves(&mut side.x_mm, vec![&mut side.depth_mm], points);
    }
    profile
}

/// Thins tractions, each position separately.
pub fn pressure(mut pressure: Pressure, points: usize) -> Pressure {
    for at in &mut pressure.positions {
        let series = vec![&mut at.pressure_mpa, &mut at.shear_mpa];
        curves(&mut at.x_mm, series, points);
    }
    pressure
}

/// Thins a friction loop, as a curve over its increments.
pub fn friction_loop(mut friction_loop: Loop, points: usize) -> Loop {
    let (x, force) = (
        &mut friction_loop.displacement_mm,
        &mut friction_loop.tangential_force_n_per_mm,
    );
    let mut increments = (0..u32::MAX).take(x.len()).map(f64::from).collect();
    let whole = Some(&mut friction_loop.tangential_force_n).filter(|whole| !whole.is_empty());
    let series = [x, force].into_iter().chain(whole).collect();
    curves(&mut increments, series, points);
    friction_loop
}

/// Thins curves over the ascending `at`.
pub fn curves<'a>(at: &'a mut Vec<f64>, mut series: Vec<&'a mut Vec<f64>>, points: usize) {
    let values: Vec<&[f64]> = series.iter().map(|values| &values[..]).collect();
    let selected = select(at, &values, points);
    series.push(at);
    for values in series {
        let chosen = selected.iter().filter_map(|index| values.get(*index));
        *values = chosen.copied().collect();
    }
}

/// A segment between two selected points with a point between them.
#[derive(Debug, PartialEq)]
struct Segment {
    /// Relative distance of the farthest point from the chord.
    distance: f64,
    farthest: usize,
    from: usize,
    to: usize,
}

impl Eq for Segment {}

impl Ord for Segment {
    fn cmp(&self, other: &Self) -> Ordering {
        // The earlier one of equals, so that the result is deterministic.
        self.distance
            .total_cmp(&other.distance)
            .then(other.farthest.cmp(&self.farthest))
    }
}

impl PartialOrd for Segment {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Indices of the selected points, at most `points`, of curves over the ascending `at`.
fn select(at: &[f64], series: &[&[f64]], points: usize) -> BTreeSet<usize> {
    let count = series
        .iter()
        .map(|values| values.len())
        .fold(at.len(), usize::min);
    if count <= points {
        return (0..count).collect();
    }
    let mut selected = BTreeSet::from([0, count - 1]);
    let mut scales = Vec::with_capacity(series.len());
    for values in series {
        let order = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let lowest = (0..count).min_by(order).unwrap_or(0);
        let highest = (0..count).max_by(order).unwrap_or(0);
        scales.push((values[highest] - values[lowest]).max(f64::MIN_POSITIVE));
        for extreme in [lowest, highest] {
            if selected.len() < points {
                selected.insert(extreme);
            }
        }
    }
    let curves = Curves { at, series, scales };
    let ends: Vec<usize> = selected.iter().copied().collect();
    let mut segments: BinaryHeap<Segment> = ends
        .windows(2)
        .filter_map(|pair| curves.segment(pair[0], pair[1]))
        .collect();
    while selected.len() < points
        && let Some(widest) = segments.pop()
    {
        selected.insert(widest.farthest);
        segments.extend(curves.segment(widest.from, widest.farthest));
        segments.extend(curves.segment(widest.farthest, widest.to));
    }
    selected
}

struct Curves<'a> {
    at: &'a [f64],
    series: &'a [&'a [f64]],
    scales: Vec<f64>,
}

impl Curves<'_> {
    /// The segment between two points, if there are points between them.
    fn segment(&self, from: usize, to: usize) -> Option<Segment> {
        let width = (self.at[to] - self.at[from]).max(f64::MIN_POSITIVE);
        let distance = |index: usize| {
            let share = (self.at[index] - self.at[from]) / width;
            self.series
                .iter()
                .zip(&self.scales)
                .map(|(values, scale)| {
                    let line = values[from] + share * (values[to] - values[from]);
                    (values[index] - line).abs() / scale
                })
                .fold(0.0, f64::max)
        };
        (from + 1..to)
            .map(|index| (distance(index), index))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
            .map(|(distance, farthest)| Segment {
                distance,
                farthest,
                from,
                to,
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(count: u32, value: fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        (0..count)
            .map(|index| (f64::from(index), value(f64::from(index))))
            .unzip()
    }

    #[test]
    fn ends_and_extremes_of_every_series_are_selected() {
        let (at, first) = curve(10_000, |x| {
            if (x - 777.0).abs() < 0.5 {
                1e3
            } else {
                x.sin()
            }
        });
        let (_, second) = curve(
            10_000,
            |x| if (x - 4242.0).abs() < 0.5 { -1e-9 } else { 0.0 },
        );
        let selected = select(&at, &[&first, &second], FEWEST_POINTS);
        assert_eq!(selected.len(), FEWEST_POINTS);
        for index in [0, 777, 4242, 9999] {
            assert!(selected.contains(&index), "{index}: {selected:?}");
        }
    }

    #[test]
    fn a_smooth_curve_keeps_its_shape() {
        let (at, values) = curve(100_000, f64::sqrt);
        let selected: Vec<usize> = select(&at, &[&values], 200).into_iter().collect();
        let worst = selected
            .windows(2)
            .flat_map(|pair| {
                let (from, to) = (pair[0], pair[1]);
                let slope = (values[to] - values[from]) / (at[to] - at[from]);
                let (at, values) = (&at, &values);
                (from..to)
                    .map(move |i| (values[i] - values[from] - slope * (at[i] - at[from])).abs())
            })
            .fold(0.0, f64::max);
        // On a segment of length h the chord of sqrt is off by h^2 / (32 x^(3/2)): 0.004 with 200 segments of equal
        // error, the optimum. The greedy choice loses a small factor.
        assert!(worst < 0.02, "{worst}");
    }

    #[test]
    fn short_curves_stay_as_they_are_and_constant_ones_are_thinned() {
        let (at, values) = curve(5, |_| 1.0);
        assert_eq!(select(&at, &[&values], FEWEST_POINTS).len(), 5);
        let flat = vec![0.0; 100];
        assert_eq!(select(&flat, &[&flat], 20).len(), 20);
    }
}
