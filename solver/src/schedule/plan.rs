//! Increments and replays of a computed cycle.
//!
//! Increments must be short against the contact, or their wear leaves waves in the floor that the next contacts stand on.
//! In gross reciprocating sliding a single pass wears off the waves of longer increments where k E* is large. They can then be
//! chosen for a wider contact if replays resolve the present one where it is reported: of both plans the one of fewer
//! increments is taken.

use std::ops::Range;

use super::increments;
use super::replay::{ReplayPlan, ReplayedCycle};
use super::stroke::Stroke;
use crate::number::{real, real_cycles};
use crate::scene::{Accuracy, Motion};

/// Longest step over the half-width of the contact of a single cycle: that is as wide, and no pass of it wears off the waves of
/// longer ones. The coarse companions of `fuzz_button.json` would take steps of 4.8, and their peak pressure would be half.
const LONGEST_STEP: f64 = 2.0;

/// Contact that the increments are chosen for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Followed {
    /// Half-widths of the present contact and of that of a single cycle, mm.
    pub(crate) half_width: f64,
    pub(crate) single: f64,
    /// True if part of it may stick through the whole stroke.
    pub(crate) sticks: bool,
}

/// Physical cycles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cycles {
    /// Done before the computed cycle.
    pub(crate) done: u64,
    /// That the computed cycle represents.
    pub(crate) jump: u64,
}

impl Cycles {
    /// From those done before the computed cycle to those done after it.
    pub(crate) fn range(self) -> Range<f64> {
        let done = real_cycles(self.done);
        done..done + real_cycles(self.jump)
    }
}

impl Followed {
    /// The narrower half-width, mm.
    pub(crate) fn narrower(&self) -> f64 {
        if self.single > 0.0 {
            self.half_width.min(self.single)
        } else {
            self.half_width
        }
    }

    /// The wider half-width within a limit, mm: one for whose increments a pass wears off the waves.
    fn wider(&self, accuracy: &Accuracy, stroke: Stroke, cycles: Cycles) -> f64 {
        let tuning = &accuracy.tuning;
        let longest = tuning.smoothed_step.at(accuracy.tolerance) * stroke.smoothing;
        let early = tuning.smoothed_early * real_cycles(cycles.done + cycles.jump).sqrt();
        let smoothed = early.min(longest / accuracy.step_over_half_width());
        let limit = (LONGEST_STEP / accuracy.largest_step(1.0)).min(tuning.widest_followed);
        self.narrower().max(smoothed.min(limit) * self.single)
    }
}

/// Increments and replays of a computed cycle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CyclePlan {
    /// Number of increments.
    pub(crate) steps: usize,
    pub(crate) replays: ReplayPlan,
    /// Number of increments to the contacts on the surfaces without the skew of the jump: two to the neutral position, one to
    /// each turning point.
    pub(crate) unskewed: usize,
}

impl CyclePlan {
    /// Plans a computed cycle of a stroke; with replays at all named positions where `detailed`.
    pub(crate) fn new(
        motion: Motion,
        accuracy: &Accuracy,
        contact: Followed,
        stroke: Stroke,
        cycles: Cycles,
        detailed: bool,
    ) -> Self {
        // A single cycle needs none, and that to the neutral position need not begin before the turning point.
        let amplitude = motion.amplitude_mm().abs();
        let path = match motion {
            Motion::Periodic { turns, .. } => turns.path_mm(),
            Motion::Reciprocating { .. } | Motion::Continuous { .. } => 4.0 * amplitude,
        };
        let lead_in = if cycles.jump > 1 {
            (accuracy.tuning.lead_in * contact.half_width).min(amplitude)
        } else {
            0.0
        };
        let is_evenly_worn = stroke.skew <= accuracy.tuning.unskewed_to;
        let plan = |half_width, replayed| {
            let steps = increments::count(motion, accuracy, half_width, contact.sticks);
            let length = path / real(steps);
            let is_skewed = is_evenly_worn && !stroke.gross && steps > 1 && !motion.turns_inside();
            let replays = if replayed {
                let cycle = ReplayedCycle {
                    named: increments::named(motion, steps),
                    length,
                    amplitude: amplitude / path * length * real(steps),
                };
                ReplayPlan::new(cycle, accuracy, lead_in, contact.single, detailed)
            } else {
                ReplayPlan::default()
            };
            Self {
                steps,
                replays,
                unskewed: match (is_skewed, detailed) {
                    (false, _) => 0,
                    (true, false) => 2,
                    (true, true) => 4,
                },
            }
        };
        let narrow = plan(contact.narrower(), stroke.gross && cycles.jump > 1);
        // A run of single cycles is a reference.
        let is_reference = accuracy.cycle_jump == Some(1);
        if !stroke.gross || is_reference || stroke.smoothing <= 0.0 || contact.single <= 0.0 {
            return narrow;
        }
        let wide = plan(contact.wider(accuracy, stroke, cycles), true);
        if wide.increments() < narrow.increments() {
            wide
        } else {
            narrow
        }
    }

    /// Number of increments of the cycle, of its replays and of its unskewed contacts.
    pub(crate) fn increments(&self) -> usize {
        self.steps + self.replays.increments() + self.unskewed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Tuning;
    use crate::schedule::stroke::Movement;
    use crate::sides::Sides;

    const ACCURACY: Accuracy = Accuracy::from_tolerance(0.02);

    const MOTION: Motion = Motion::Reciprocating {
        amplitude_mm: 50.0,
        period_s: 1.0,
    };

    /// Strokes of half-widths under wear rates k, 1/MPa, with E* = 1 MPa.
    fn stroke_of(amplitude: f64, rates: Sides<f64>) -> Stroke {
        let movement = Movement {
            amplitude,
            half_width: 1.0,
            travel: 1.0,
            sticks: false,
        };
        Stroke::new(&Tuning::FITTED, rates, 1.0, movement, 1_000)
    }

    /// A stroke of 50 half-widths.
    fn stroke(receptacle: f64, slider: f64) -> Stroke {
        stroke_of(50.0, Sides { slider, receptacle })
    }

    fn contact(half_width: f64) -> Followed {
        Followed {
            half_width,
            single: 1.0,
            sticks: false,
        }
    }

    fn cycles(done: u64, jump: u64) -> Cycles {
        Cycles { done, jump }
    }

    fn plan(half_width: f64, stroke: Stroke, cycles: Cycles) -> CyclePlan {
        CyclePlan::new(
            MOTION,
            &ACCURACY,
            contact(half_width),
            stroke,
            cycles,
            false,
        )
    }

    #[test]
    fn increments_follow_the_narrower_contact_where_no_pass_wears_off_the_waves() {
        // Steps of a fifth of a half-width over 200 half-widths.
        let steps = |half_width| plan(half_width, stroke(0.01, 0.0), cycles(100, 1)).steps;
        assert_eq!((steps(1.0), steps(2.0), steps(0.5)), (1_000, 1_000, 2_000));
    }

    #[test]
    fn single_cycles_are_replayed_where_a_pass_wears_off_the_waves() {
        let of = |receptacle, slider, done| {
            let plan = plan(1.0, stroke(receptacle, slider), cycles(done, 1));
            (plan.steps, plan.replays.spans.len())
        };
        assert_eq!(of(1.2, 0.0, 99), (336, 1));
        assert_eq!(of(0.1, 0.0, 99), (1_000, 0));
        assert_eq!(of(1.2, 0.01, 99), (1_000, 0));
        // In the first cycles waves are not yet small against the depth.
        assert_eq!(of(1.2, 0.0, 0), (500, 1));
    }

    #[test]
    fn runs_of_single_cycles_and_short_strokes_follow_the_narrower_contact() {
        let single = Accuracy {
            cycle_jump: Some(1),
            ..ACCURACY
        };
        let plan = |accuracy, stroke| {
            let cycles = cycles(99, 1);
            CyclePlan::new(MOTION, accuracy, contact(1.0), stroke, cycles, false).steps
        };
        assert_eq!(plan(&single, stroke(1.2, 0.0)), 1_000);
        // An amplitude of half a half-width.
        let rates = Sides {
            slider: 0.0,
            receptacle: 1.2,
        };
        assert_eq!(plan(&ACCURACY, stroke_of(0.5, rates)), 1_000);
    }
}
