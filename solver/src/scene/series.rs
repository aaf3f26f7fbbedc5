//! Fourier series of a periodic motion: u(t) = sum over i of s_i sin(n_i w t) + c_i cos(n_i w t), w = 2 pi/T.
//!
//! Quasi-static contact depends on where the motion turns alone; laws of time and speed take the time of each displacement from
//! the series, in which a stroke between two turning points passes it once.

use std::f64::consts::TAU;

use super::turning_points::TurningPoints;
use crate::number::real_cycles;

/// Highest order of a term.
pub const HIGHEST_ORDER: u64 = 64;
/// Times in a period of the highest order at which the series is evaluated: a turning point between two of them is off by at most
/// 1 - cos(pi/256), 8e-5 of that term.
const TIMES: u64 = 256;
/// Part of the whole range that a motion may turn back without being another turning point: round-off of a flat maximum.
const FLAT: f64 = 1e-9;
/// Halvings of the time of a stroke in which a displacement is passed: to the precision of the time.
const HALVINGS: usize = 52;

/// A term of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Order n: periods of the term in one of the motion; at most [`HIGHEST_ORDER`].
    pub order: u64,
    /// Amplitude s of the sine, mm.
    pub sine_mm: f64,
    /// Amplitude c of the cosine, mm.
    pub cosine_mm: f64,
}

/// A turning point of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Turn {
    /// Part of the period at which it is reached, -; beyond 1 in the next one.
    at: f64,
    /// Displacement, mm.
    u_mm: f64,
}

/// A series with its turning points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    terms: Vec<Term>,
    /// From the first of the highest ones on; none without an amplitude.
    turns: Vec<Turn>,
    /// Lowest and highest displacement, mm.
    range_mm: (f64, f64),
}

impl Series {
    /// A series of some terms.
    pub fn new(terms: Vec<Term>) -> Self {
        let mut turns = turns(&terms);
        // Of a series that turns twice only the range counts, which is found well enough.
        if turns.len() > 2 {
            for (number, turn) in turns.iter_mut().enumerate() {
                *turn = extremum(&terms, turn.at, number.is_multiple_of(2));
            }
        }
        let range_mm = range(turns.iter().map(|turn| turn.u_mm));
        Self {
            terms,
            turns,
            range_mm,
        }
    }

    /// Number of its turning points in a period; none without an amplitude.
    pub fn count(&self) -> usize {
        self.turns.len()
    }

    /// Lowest and highest displacement, mm.
    pub fn range_mm(&self) -> (f64, f64) {
        self.range_mm
    }

    /// The turning points about the middle of the range, from the highest on; `None` if there are too many.
    pub fn turning_points(&self) -> Option<TurningPoints> {
        let middle = self.middle_mm();
        let places: Vec<f64> = self.turns.iter().map(|turn| turn.u_mm - middle).collect();
        TurningPoints::new(&places)
    }

    fn middle_mm(&self) -> f64 {
        let (low, high) = self.range_mm();
        0.5 * (low + high)
    }

    /// Part of the period, counted from the same one, at which a stroke passes a displacement about the middle, mm.
    pub(super) fn time(&self, stroke: usize, x_mm: f64) -> f64 {
        let Some(begin) = self.turns.get(stroke) else {
            return 0.0;
        };
        let u = x_mm + self.middle_mm();
        let end = self.turns.get(stroke + 1).copied().unwrap_or(Turn {
            at: self.turns[0].at + 1.0,
            ..self.turns[0]
        });
        let rises = end.u_mm > begin.u_mm;
        let (mut before, mut after) = (begin.at, end.at);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            if (displacement(&self.terms, middle) < u) == rises {
                before = middle;
            } else {
                after = middle;
            }
        }
        0.5 * (before + after)
    }

    /// Highest speed, mm a period, at the times of evaluation.
    pub(super) fn fastest(&self) -> f64 {
        self.speeds().fold(0.0, f64::max)
    }

    /// Speeds at the times of evaluation, mm a period.
    pub(super) fn speeds(&self) -> impl Iterator<Item = f64> {
        let times = times(&self.terms);
        let parts = (0..times).map(move |time| real_cycles(time) / real_cycles(times));
        parts.map(|part| velocity(&self.terms, part).abs())
    }
}

/// Number of times in a period at which a series is evaluated.
fn times(terms: &[Term]) -> u64 {
    let highest = terms.iter().map(|term| term.order.min(HIGHEST_ORDER)).max();
    TIMES * highest.unwrap_or(1).max(1)
}

/// Displacement at a part of the period, mm.
fn displacement(terms: &[Term], part: f64) -> f64 {
    terms.iter().fold(0.0, |sum, term| {
        let (sine, cosine) = (TAU * real_cycles(term.order) * part).sin_cos();
        sum + term.sine_mm * sine + term.cosine_mm * cosine
    })
}

/// Velocity at a part of the period, mm a period.
fn velocity(terms: &[Term], part: f64) -> f64 {
    terms.iter().fold(0.0, |sum, term| {
        let order = TAU * real_cycles(term.order);
        let (sine, cosine) = (order * part).sin_cos();
        sum + order * (term.sine_mm * cosine - term.cosine_mm * sine)
    })
}

/// The extremum within a time of evaluation of one that was found among those.
fn extremum(terms: &[Term], near: f64, is_high: bool) -> Turn {
    let time = 1.0 / real_cycles(times(terms));
    let (mut before, mut after) = (near - time, near + time);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        if (velocity(terms, middle) > 0.0) == is_high {
            before = middle;
        } else {
            after = middle;
        }
    }
    let at = 0.5 * (before + after);
    Turn {
        at,
        u_mm: displacement(terms, at),
    }
}

/// Turning points in one period, in their order, to the nearest time of evaluation.
fn turns(terms: &[Term]) -> Vec<Turn> {
    let times = times(terms);
    let at = |time: u64| Turn {
        at: real_cycles(time) / real_cycles(times),
        u_mm: displacement(terms, real_cycles(time % times) / real_cycles(times)),
    };
    let points: Vec<Turn> = (0..times).map(at).collect();
    let (low, high) = range(points.iter().map(|point| point.u_mm));
    let flat = FLAT * (high - low);
    if flat <= 0.0 {
        return Vec::new();
    }
    // From the highest point on, each point that the motion goes back from by more than round-off.
    // Of two alike the first, whatever round-off is.
    let is_highest = |point: &Turn| point.u_mm >= high - flat;
    let start = points.iter().position(is_highest).unwrap_or_default();
    let (first, later) = (&points[start..], &points[..start]);
    let next_period = later.iter().map(|point| Turn {
        at: point.at + 1.0,
        ..*point
    });
    let mut turn = points[start];
    let (mut turns, mut falling) = (vec![turn], true);
    for point in first.iter().copied().chain(next_period) {
        let advances = if falling {
            point.u_mm < turn.u_mm
        } else {
            point.u_mm > turn.u_mm
        };
        if advances {
            turn = point;
        } else if (point.u_mm - turn.u_mm).abs() > flat {
            turns.push(turn);
            (turn, falling) = (point, !falling);
        }
    }
    turns
}

/// Least and largest of some values.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| {
        (low.min(u), high.max(u))
    });
    if low > high { (0.0, 0.0) } else { (low, high) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(terms: &[(u64, f64, f64)]) -> Series {
        let term = |&(order, sine_mm, cosine_mm): &(u64, f64, f64)| Term {
            order,
            sine_mm,
            cosine_mm,
        };
        Series::new(terms.iter().map(term).collect())
    }

    #[test]
    fn a_series_that_turns_twice_has_the_range_of_its_turning_points() {
        for (terms, (low, high)) in [
            (&[(1, 3.0, 4.0)][..], (-5.0, 5.0)),
            (&[(1, 0.9, 0.0), (3, -0.1, 0.0)], (-1.0, 1.0)),
            // cos x + 0.2 cos 2x: 1.2 and -0.8.
            (&[(1, 0.0, 1.0), (2, 0.0, 0.2)], (-0.8, 1.2)),
        ] {
            let series = series(terms);
            let (found_low, found_high) = series.range_mm();
            assert_eq!(series.count(), 2, "{terms:?}");
            for (found, value) in [(found_low, low), (found_high, high)] {
                assert!(
                    (found - value).abs() < 1e-4 * (high - low),
                    "{found} {value}"
                );
            }
        }
        assert_eq!(series(&[(2, 0.0, 0.0)]).count(), 0);
        assert_eq!(series(&[]).count(), 0);
    }

    #[test]
    fn inner_turning_points_are_found_in_their_order() {
        // sin x + sin 3x turns six times: at +-1.5396 and +-1, 0 in between.
        let both = series(&[(1, 1.0, 0.0), (3, 1.0, 0.0)]);
        let turns = both.turning_points().expect("few turning points");
        let largest = 8.0 / 27.0_f64.sqrt();
        let expected = [largest, 0.0, largest, -largest, 0.0, -largest];
        let apart = turns.as_slice().iter().zip(expected);
        assert_eq!(turns.as_slice().len(), 6);
        assert!(
            apart
                .clone()
                .all(|(found, value)| (found - value).abs() < 2e-4),
            "{turns:?}"
        );
        // A second order alone is two periods of one reciprocating motion.
        assert_eq!(series(&[(2, 1.0, 0.0)]).count(), 4);
        assert_eq!(
            series(&[(1, 1.0, 0.0), (32, 1.0, 0.0)]).turning_points(),
            None
        );
    }

    #[test]
    fn a_stroke_passes_each_displacement_at_its_time() {
        let series = series(&[(1, 0.7, 0.2), (3, 0.5, -0.3)]);
        let turns = series.turning_points().expect("few turning points");
        let mut all = 0.0;
        for (stroke, (from, to)) in turns.strokes().enumerate() {
            let mut last = series.time(stroke, from);
            assert!((last - series.turns[stroke].at).abs() < 1e-7);
            for part in [0.2, 0.5, 0.9, 1.0] {
                let x = from + part * (to - from);
                let time = series.time(stroke, x);
                let found = displacement(&series.terms, time) - series.middle_mm();
                assert!((found - x).abs() < 1e-9, "{stroke} {x}: {found}");
                assert!(time > last, "{stroke} {part}");
                (all, last) = (all + time - last, time);
            }
        }
        // The time of an extremum is found to the root of the precision of its displacement.
        assert!((all - 1.0).abs() < 1e-6, "{all}");
        // One sine of amplitude 2 has its highest speed in the middle.
        let sine = Series::new(vec![Term {
            order: 1,
            sine_mm: 2.0,
            cosine_mm: 0.0,
        }]);
        assert!((sine.fastest() - 2.0 * TAU).abs() < 1e-12);
    }
}
