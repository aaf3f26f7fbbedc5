//! Fewer points of a curve for a client that draws it: the ends, the highest and lowest point of every series, and
//! then, one by one, the point that lies farthest from the straight line between its kept neighbours.
//!
//! Distances are measured in shares of each series' own range, so that no unit outweighs another.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use api::results::{Loop, Pressure, Profile, SideProfile};
use solver::record::{CycleReport, Record};

use crate::export::columns;

/// Fewest points that a client may ask for: room for the ends and the extremes of what is usually drawn.
pub const FEWEST_POINTS: usize = 16;

/// Rows of a wear history.
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
    let kept = kept(&at, &series, points);
    let mut index = 0..;
    rows.into_iter()
        .filter(|_| index.next().is_some_and(|index| kept.contains(&index)))
        .collect()
}

/// A profile; each side for itself.
pub fn profile(profile: Profile, points: usize) -> Profile {
    let side = |side: SideProfile| {
        let kept = kept(&side.x_mm, &[&side.depth_mm], points);
        SideProfile {
            x_mm: picked(&side.x_mm, &kept),
            depth_mm: picked(&side.depth_mm, &kept),
        }
    };
    Profile {
        cycle: profile.cycle,
        receptacle: side(profile.receptacle),
        slider: side(profile.slider),
    }
}

/// Tractions; each position for itself.
pub fn pressure(mut pressure: Pressure, points: usize) -> Pressure {
    for position in &mut pressure.positions {
        let series = [&position.pressure_mpa[..], &position.shear_mpa[..]];
        let kept = kept(&position.x_mm, &series, points);
        position.x_mm = picked(&position.x_mm, &kept);
        position.pressure_mpa = picked(&position.pressure_mpa, &kept);
        position.shear_mpa = picked(&position.shear_mpa, &kept);
    }
    pressure
}

/// A friction loop, followed increment by increment.
pub fn friction_loop(friction_loop: Loop, points: usize) -> Loop {
    let (x, force) = (
        friction_loop.displacement_mm,
        friction_loop.tangential_force_n_per_mm,
    );
    let increments: Vec<f64> = (0..u32::MAX).take(x.len()).map(f64::from).collect();
    let kept = kept(&increments, &[&x, &force], points);
    Loop {
        cycle: friction_loop.cycle,
        displacement_mm: picked(&x, &kept),
        tangential_force_n_per_mm: picked(&force, &kept),
    }
}

fn picked(values: &[f64], kept: &BTreeSet<usize>) -> Vec<f64> {
    kept.iter()
        .filter_map(|index| values.get(*index))
        .copied()
        .collect()
}

#[expect(clippy::cast_precision_loss, reason = "cycles stay below 1e9")]
fn real(cycle: u64) -> f64 {
    cycle as f64
}

/// A stretch between two kept points, by its farthest point.
#[derive(Debug, PartialEq)]
struct Stretch {
    off: f64,
    farthest: usize,
    from: usize,
    to: usize,
}

impl Eq for Stretch {}

impl Ord for Stretch {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of equals the earlier one, so that the same curve is always thinned the same way.
        self.off
            .total_cmp(&other.off)
            .then(other.farthest.cmp(&self.farthest))
    }
}

impl PartialOrd for Stretch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Indices of at most so many points of curves over `at`, which does not fall.
fn kept(at: &[f64], series: &[&[f64]], points: usize) -> BTreeSet<usize> {
    let count = series
        .iter()
        .map(|values| values.len())
        .fold(at.len(), usize::min);
    if count <= points {
        return (0..count).collect();
    }
    let mut kept = BTreeSet::from([0, count - 1]);
    let mut scales = Vec::with_capacity(series.len());
    for values in series {
        let order = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let lowest = (0..count).min_by(order).unwrap_or(0);
        let highest = (0..count).max_by(order).unwrap_or(0);
        scales.push((values[highest] - values[lowest]).max(f64::MIN_POSITIVE));
        for extreme in [lowest, highest] {
            if kept.len() < points {
                kept.insert(extreme);
            }
        }
    }
    let curves = Curves { at, series, scales };
    let ends: Vec<usize> = kept.iter().copied().collect();
    let mut stretches: BinaryHeap<Stretch> = ends
        .windows(2)
        .filter_map(|pair| curves.stretch(pair[0], pair[1]))
        .collect();
    while kept.len() < points
        && let Some(widest) = stretches.pop()
    {
        kept.insert(widest.farthest);
        stretches.extend(curves.stretch(widest.from, widest.farthest));
        stretches.extend(curves.stretch(widest.farthest, widest.to));
    }
    kept
}

struct Curves<'a> {
    at: &'a [f64],
    series: &'a [&'a [f64]],
    scales: Vec<f64>,
}

impl Curves<'_> {
    /// The stretch between two points, if there is one between them.
    fn stretch(&self, from: usize, to: usize) -> Option<Stretch> {
        let width = (self.at[to] - self.at[from]).max(f64::MIN_POSITIVE);
        let off = |index: usize| {
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
            .map(|index| (off(index), index))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
            .map(|(off, farthest)| Stretch {
                off,
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
    fn ends_and_extremes_of_every_series_stay() {
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
        let kept = kept(&at, &[&first, &second], FEWEST_POINTS);
        assert_eq!(kept.len(), FEWEST_POINTS);
        for index in [0, 777, 4242, 9999] {
            assert!(kept.contains(&index), "{index}: {kept:?}");
        }
    }

    #[test]
    fn a_smooth_curve_keeps_its_shape() {
        let (at, values) = curve(100_000, f64::sqrt);
        let kept: Vec<usize> = kept(&at, &[&values], 200).into_iter().collect();
        let worst = kept
            .windows(2)
            .flat_map(|pair| {
                let (from, to) = (pair[0], pair[1]);
                let slope = (values[to] - values[from]) / (at[to] - at[from]);
                let (at, values) = (&at, &values);
                (from..to)
                    .map(move |i| (values[i] - values[from] - slope * (at[i] - at[from])).abs())
            })
            .fold(0.0, f64::max);
        // A piece h of sqrt errs by h^2 / (32 x^(3/2)): 0.004 with 200 pieces of equal error, the best there is. Each
        // choice is only the best of the moment, which costs a factor of a few.
        assert!(worst < 0.02, "{worst}");
    }

    #[test]
    fn short_curves_and_equal_points_are_left_alone() {
        let (at, values) = curve(5, |_| 1.0);
        assert_eq!(kept(&at, &[&values], FEWEST_POINTS).len(), 5);
        let flat = vec![0.0; 100];
        assert_eq!(kept(&flat, &[&flat], 20).len(), 20);
    }
}
