//! Increments of a periodic cycle that turns between its outermost turning points.
//!
//! Each stroke is divided into equal steps, as many as its length over the amplitude times the steps of a quarter of a reciprocating
//! motion, and that on which the neutral position is passed to +x for the last time also there.

use super::step::{MOST_STEPS, Named, Position, Step};
use crate::number::{count_at_least, real};
use crate::scene::TurningPoints;

/// Part of a step that round-off may add to a stroke without another step.
const ROUND_OFF: f64 = 1e-9;

/// A part of a stroke in equal steps, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part {
    stroke: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// The named position at its end.
    pub(crate) at: Option<Position>,
}

impl Part {
    /// Number of its steps for so many over the amplitude, mm.
    fn steps(&self, amplitude: f64, quarter: usize) -> usize {
        let steps = (self.to - self.from).abs() / amplitude * real(quarter);
        count_at_least(steps - ROUND_OFF)
    }
}

/// Number of increments of a cycle for so many over the amplitude.
pub(super) fn count(turns: &TurningPoints, quarter: usize) -> usize {
    let amplitude = turns.amplitude_mm().abs();
    // As many in a cycle as the longest of a reciprocating motion.
    let most = count_at_least(4.0 * amplitude / turns.path_mm() * real(MOST_STEPS));
    in_all(&parts(turns), amplitude, quarter.min(most))
}

fn in_all(parts: &[Part], amplitude: f64, quarter: usize) -> usize {
    let counts = parts.iter().map(|part| part.steps(amplitude, quarter));
    counts.sum()
}

/// The increments of a cycle of so many.
pub(super) fn steps(turns: &TurningPoints, count: usize) -> Vec<Step> {
    let (parts, amplitude) = (parts(turns), turns.amplitude_mm().abs());
    // Their number increases with that over the amplitude.
    let (mut fewer, mut enough) = (0, MOST_STEPS);
    while enough - fewer > 1 {
        let middle = fewer.midpoint(enough);
        if in_all(&parts, amplitude, middle) < count {
            fewer = middle;
        } else {
            enough = middle;
        }
    }
    let mut steps = Vec::with_capacity(count);
    for part in parts {
        let n = part.steps(amplitude, enough);
        steps.extend((1..=n).map(|i| {
            let is_last = i == n;
            Step {
                slider_x: if is_last {
                    part.to
                } else {
                    part.from + (part.to - part.from) * (real(i) / real(n))
                },
                surface_slip: 0.0,
                at: part.at.filter(|_| is_last),
                stroke: part.stroke,
            }
        }));
    }
    steps
}

/// The leftmost, the neutral and the rightmost position in a cycle of so many increments; what leads to one does not turn.
pub(super) fn named(turns: &TurningPoints, count: usize) -> [Named; 3] {
    let steps = steps(turns, count);
    [Position::Leftmost, Position::Neutral, Position::Rightmost].map(|position| {
        let end = steps.iter().position(|step| step.at == Some(position));
        let end = end.unwrap_or_default();
        let same = |step: &Step| step.stroke == steps[end].stroke;
        Named {
            from: steps.iter().position(same).unwrap_or_default(),
            end,
        }
    })
}

/// The strokes, that of the last way through the neutral position in two parts.
pub(crate) fn parts(turns: &TurningPoints) -> Vec<Part> {
    let direction = turns.amplitude_mm().signum();
    let strokes: Vec<(f64, f64)> = turns.strokes().collect();
    let passes = |&(from, to): &(f64, f64)| from * direction < 0.0 && to * direction >= 0.0;
    let neutral = strokes.iter().rposition(passes);
    let lowest = strokes
        .iter()
        .fold(f64::INFINITY, |low, (_, to)| low.min(to * direction));
    let leftmost = strokes.iter().rposition(|(_, to)| to * direction <= lowest);
    let mut parts = Vec::with_capacity(strokes.len() + 1);
    for (stroke, &(from, to)) in strokes.iter().enumerate() {
        let whole = Part {
            stroke,
            from,
            to,
            at: if stroke + 1 == strokes.len() {
                Some(Position::Rightmost)
            } else if Some(stroke) == leftmost {
                Some(Position::Leftmost)
            } else {
                None
            },
        };
        if Some(stroke) != neutral {
            parts.push(whole);
            continue;
        }
        parts.push(Part {
            to: 0.0,
            at: Some(Position::Neutral),
            ..whole
        });
        if to * direction > 0.0 {
            parts.push(Part { from: 0.0, ..whole });
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns(x_mm: &[f64]) -> TurningPoints {
        TurningPoints::new(x_mm).expect("turning points")
    }

    fn places(steps: &[Step]) -> Vec<f64> {
        steps.iter().map(|step| step.slider_x).collect()
    }

    #[test]
    fn a_cycle_visits_all_turning_points_in_steps_of_one_length() {
        let turns = turns(&[2.0, -1.0, 1.0, -2.0]);
        assert_eq!(count(&turns, 2), 12);
        assert_eq!(
            places(&steps(&turns, 12)),
            [
                1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, -2.0, -1.0, 0.0, 1.0, 2.0
            ]
        );
    }

    #[test]
    fn two_turning_points_are_those_of_a_reciprocating_motion() {
        let turns = turns(&[2.0, -2.0]);
        let steps = steps(&turns, count(&turns, 2));
        assert_eq!(places(&steps), [1.0, 0.0, -1.0, -2.0, -1.0, 0.0, 1.0, 2.0]);
        let named = named(&turns, 8);
        assert_eq!(named.map(|named| named.end), [3, 5, 7]);
        assert_eq!(named.map(|named| named.from), [0, 4, 4]);
    }

    /// The neutral position is the last one on the way to +x, before an inner loop here.
    #[test]
    fn positions_are_named_once() {
        let turns = turns(&[1.0, -1.0, 0.8, 0.2]);
        for quarter in [1, 3, 10, 77] {
            let count = count(&turns, quarter);
            let steps = steps(&turns, count);
            assert_eq!(steps.len(), count);
            let named = named(&turns, count).map(|named| steps[named.end].slider_x);
            assert_eq!(named.as_slice(), &[-1.0, 0.0, 1.0]);
            assert_eq!(steps.iter().filter(|step| step.at.is_some()).count(), 3);
            let mut last = 1.0;
            for step in steps {
                assert!((step.slider_x - last).abs() <= (1.0 + 1e-9) / real(quarter));
                last = step.slider_x;
            }
        }
    }

    /// Two periods of one motion in one: the last leftmost position is named.
    #[test]
    fn a_position_that_is_reached_twice_is_named_the_last_time() {
        let turns = turns(&[1.0, -1.0, 1.0, -1.0]);
        let named = named(&turns, count(&turns, 2));
        assert_eq!(named.map(|named| named.end), [11, 13, 15]);
    }
}
