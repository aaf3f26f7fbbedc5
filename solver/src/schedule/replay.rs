//! Single-cycle replay: the reported contact where a computed cycle represents many.
//!
//! In gross reciprocating sliding the contact rests on the leading-edge step that its pass wears. Where the slider wears too, the
//! computed cycle wears as its whole jump; that step is then as many passes high, the contact wider and its pressure lower.
//! The contact reported at a position is therefore that of a copy of the state whose last increments before the position,
//! the lead-in, wear as a single cycle.
//!
//! Where the increments of the computed cycle are longer than the contact of a single cycle needs, they leave waves in the
//! floor. The position is then followed by a smoothing pass: there and back on either side of it.

use crate::number::count_at_least;
use crate::scene::Accuracy;
use crate::schedule::step::{Named, Step};

/// The steps that replays are taken from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ReplayedCycle {
    /// The leftmost, the neutral and the rightmost position.
    pub(crate) named: [Named; 3],
    /// Length of a step, mm.
    pub(crate) length: f64,
    /// Amplitude of the stroke, mm.
    pub(crate) amplitude: f64,
}

/// Plan of the replays of one computed cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ReplayPlan {
    /// First and last step of each replay.
    pub(crate) spans: Vec<(usize, usize)>,
    /// Length of the smoothing pass on either side of the place, mm; 0 where there is none.
    smoothing: f64,
    /// Part of it next to the place with short steps, mm.
    fine: f64,
    /// Steps of the cycle, and longest ones next to the place, mm.
    long_step: f64,
    short_step: f64,
    /// Amplitude of the stroke, mm.
    amplitude: f64,
}

impl ReplayPlan {
    /// Plans replays that end at the neutral position, or at all named ones, of a cycle, for
    /// a lead-in of a length, mm, and the half-width of the contact of a single cycle, mm.
    pub(crate) fn new(
        cycle: ReplayedCycle,
        accuracy: &Accuracy,
        lead_in: f64,
        single: f64,
        all: bool,
    ) -> Self {
        if single <= 0.0 {
            return Self::default();
        }
        let ReplayedCycle {
            named,
            length,
            amplitude,
        } = cycle;
        let tuning = &accuracy.tuning;
        let count = if lead_in > 0.0 {
            count_at_least(lead_in / length)
        } else {
            0
        };
        let ends = if all { &named[..] } else { &named[1..2] };
        let begin = |named: &Named| named.end.saturating_sub(count).max(named.from);
        let spans = ends.iter().map(|named| (begin(named), named.end));
        let short_step = accuracy.largest_step(single);
        // Steps divide the stroke evenly.
        let smoothing = if length > (1.0 + 1e-9) * short_step {
            tuning.smoothing_pass.at(accuracy.tolerance) * single
        } else {
            0.0
        };
        Self {
            spans: spans.collect(),
            smoothing,
            fine: smoothing.min(tuning.fine_pass * single),
            long_step: length,
            short_step,
            amplitude,
        }
    }

    /// Where the parts of a replay end, and the number of increments of each: the steps of the lead-in from a place in mm on, then the
    /// smoothing pass.
    pub(crate) fn path(&self, from: f64, steps: &[Step]) -> Vec<(f64, usize)> {
        let mut path: Vec<(f64, usize)> = steps.iter().map(|step| (step.slider_x, 1)).collect();
        if let Some(last) = steps.last() {
            let direction = (last.slider_x - from).signum();
            path.extend(self.smoothing(last.slider_x, direction));
        }
        path
    }

    /// Parts of the smoothing pass about a place, within the stroke: where each ends, and the number of its increments. It
    /// begins in a direction (its sign).
    fn smoothing(&self, place: f64, direction: f64) -> Vec<(f64, usize)> {
        let (far, near) = (self.smoothing * direction, self.fine * direction);
        let (long, short) = (self.long_step, self.short_step);
        let there = [(far, long), (near, long)];
        let back = [(-near, short), (-far, long), (-near, long), (0.0, short)];
        let mut last = place;
        let mut parts = Vec::new();
        for (offset, step) in there.into_iter().chain(back) {
            let end = (place + offset).clamp(-self.amplitude, self.amplitude);
            let distance = (end - last).abs();
            if distance > 0.0 {
                parts.push((end, count_at_least(distance / step)));
            }
            last = end;
        }
        parts
    }

    /// Number of increments of all replays.
    pub(crate) fn increments(&self) -> usize {
        let increments = |(begin, end): &(usize, usize)| end + 1 - begin;
        let smoothing = self.smoothing(0.0, 1.0);
        let smoothing: usize = smoothing.iter().map(|(_, parts)| parts).sum();
        self.spans
            .iter()
            .map(|span| increments(span) + smoothing)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACCURACY: Accuracy = Accuracy::from_tolerance(0.02);

    /// Steps of 0.5 over a stroke from -10 to 10 under a contact of half-width 2.
    fn plan(single: f64, all: bool) -> ReplayPlan {
        let cycle = ReplayedCycle {
            named: [39, 59, 79].map(|end| Named { from: 0, end }),
            length: 0.5,
            amplitude: 10.0,
        };
        ReplayPlan::new(cycle, &ACCURACY, 8.0, single, all)
    }

    #[test]
    fn replays_end_at_the_neutral_position_or_at_all() {
        assert_eq!(plan(2.0, false).spans, [(43, 59)]);
        assert_eq!(plan(2.0, true).spans, [(23, 39), (43, 59), (63, 79)]);
        assert_eq!(plan(0.0, true).spans, []);
    }

    #[test]
    fn long_steps_are_followed_by_a_smoothing_pass_within_the_stroke() {
        // Steps of a contact of half-width 1 are 0.2 long.
        let narrow = plan(1.0, false);
        let (there, back) = (
            [(8.0, 16), (4.0, 8)],
            [(-4.0, 40), (-8.0, 8), (-4.0, 8), (0.0, 20)],
        );
        assert_eq!(narrow.smoothing(0.0, 1.0), [&there[..], &back].concat());
        // From a turning point only back.
        let back = [(6.0, 20), (2.0, 8), (6.0, 8), (10.0, 20)];
        assert_eq!(narrow.smoothing(10.0, 1.0), back);
        let mirrored = back.map(|(place, increments)| (-place, increments));
        assert_eq!(narrow.smoothing(-10.0, -1.0), mirrored);
        assert_eq!(narrow.increments(), 17 + 100);
        let wide = plan(2.5, false);
        assert_eq!(wide.smoothing(0.0, 1.0), []);
        assert_eq!(wide.increments(), 17);
    }
}
