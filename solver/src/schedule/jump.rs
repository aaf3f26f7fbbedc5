//! Cycle jump: the number of physical cycles that the next computed one represents.
//!
//! A computed cycle multiplies its wear by the jump dN, an Euler step in cycles. Its error is half the change of
//! the wear-rate profiles over the jump: with r = (worn depth of the cycle)/dN,
//!   e = 1/2 * integral |r_new - r_old| dx / integral r_new dx  over both surfaces,
//! relative to the wear of the step. The next jump scales with the tolerance over e.

use serde::{Deserialize, Serialize};

use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Accuracy, Tuning};
use crate::sides::{Side, Sides};

/// A computed cycle wears `jump` passes at once, so that scar and pressure are skewed toward the last pass, the
/// pressure by about a third of k jump s E*/b (b: half-width, s: stroke), which stays below this.
fn largest_skew(accuracy: &Accuracy) -> f64 {
    let tuning = &accuracy.tuning;
    tuning.skew.at(accuracy.tolerance).max(tuning.least_skew)
}

/// A jump without a solution is divided by this; jumps may double again afterwards. Arbitrary: no result depends on it
/// as long as one of the jumps has a solution.
const CUT: u64 = 4;

/// Estimated error of a jump over the largest that is allowed, from which on it is not accepted. Arbitrary: accepted jumps
/// follow each other with errors of up to twice that.
const REJECTED: f64 = 3.0;

/// Shortest jump over the cycles done that is not accepted: a shorter one is no large part of the wear, and nodes that pass an interface
/// one by one leave an error of their own in jumps of any length. Arbitrary.
const SHORTEST_REJECTED: f64 = 0.01;

/// Floor of the error estimate: where nothing changes, or nothing wears, jumps grow as fast as they may. Any value far
/// below the smallest tolerance does the same.
const SMALLEST_ERROR: f64 = 1e-6;

/// Limits of a jump besides its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    /// Whether it is gross reciprocating sliding: the contact leaves its own width.
    pub(crate) gross: bool,
    /// k E*, by which a pass wears off the waves that earlier increments have left; 0 where the slider wears too.
    pub(crate) smoothing: f64,
    /// Whether only the receptacle wears, in a groove that is longer than the contact: jumps extrapolate single cycles.
    pub(crate) is_groove: bool,
    /// Whether both bodies wear.
    both: bool,
    /// Factor on the allowed error of a jump.
    error_factor: f64,
    /// Pressure skew of a single cycle, k s E*/b.
    pub(crate) skew: f64,
    /// Cycles of the whole run.
    cycles: u64,
}

impl Stroke {
    /// The stroke of an amplitude under a contact of a half-width, mm, for the wear rates k_s, k_r in 1/MPa and E* in MPa,
    /// for a contact that travels over the receptacle by a part of its displacement, and of which a part may stick.
    pub(crate) fn new(
        tuning: &Tuning,
        rates: Sides<f64>,
        modulus: f64,
        (amplitude, half_width): (f64, f64),
        (travel, sticks): (f64, bool),
        cycles: u64,
    ) -> Self {
        let wear = rates.slider + rates.receptacle;
        let only_receptacle = rates.slider <= 0.0 && rates.receptacle > 0.0;
        let gross = tuning.is_gross(amplitude, half_width);
        Self {
            gross,
            smoothing: if only_receptacle { wear * modulus } else { 0.0 },
            is_groove: only_receptacle && tuning.is_gross(amplitude * travel, half_width),
            both: rates.slider > 0.0 && rates.receptacle > 0.0,
            error_factor: if gross || sticks || amplitude <= 0.0 {
                1.0
            } else {
                tuning.scar_jump_error
            },
            skew: wear * 2.0 * amplitude * modulus / half_width,
            cycles,
        }
    }

    /// Largest estimated error of a jump.
    fn largest_error(self, accuracy: &Accuracy) -> f64 {
        let Accuracy {
            tolerance, tuning, ..
        } = accuracy;
        tolerance * self.error_factor * tuning.jump_error.at(*tolerance).max(1.0)
    }

    /// The largest jump after `done` cycles.
    fn most(self, accuracy: &Accuracy, done: u64) -> f64 {
        let Accuracy {
            tolerance, tuning, ..
        } = accuracy;
        let done = real_cycles(done);
        let most = if self.gross {
            let share = if self.both {
                tuning.gross_jump_of_both
            } else if self.is_groove {
                tuning.groove_jump_of_done
            } else {
                tuning.gross_jump_of_done
            };
            (share * tolerance).min(tuning.jump_of_done) * done
        } else {
            let sufficient = real_cycles(self.cycles) * tolerance / tuning.sufficient_cycles;
            let unskewed = largest_skew(accuracy) / self.skew.max(f64::MIN_POSITIVE);
            (tuning.jump_of_done * done).min(unskewed.max(sufficient))
        };
        most / accuracy.refinement.cycles
    }
}

/// State of the jump control.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JumpControl {
    /// Wear per physical cycle in the last computed one at the nodes of both surfaces, as equivalent depth, mm.
    rate: Sides<Vec<f64>>,
    /// The last jump; 0 before the first cycle.
    pub last: u64,
    /// The last jump whose error was estimated.
    base: f64,
    /// The last jump before it was shortened to hit a cycle exactly.
    unshortened: f64,
    /// Estimated relative error of the last jump.
    pub error: f64,
    /// Sum of error times wear, and of wear: their ratio is the error of the run so far.
    weighted_error: f64,
    worn: f64,
    done: u64,
    /// Largest jump after one without a solution; 0 if none failed recently.
    most: u64,
}

/// The wear of a jump that was shortened below this part differs in shape from that of long ones, by the step that a jump
/// wears in gross sliding: its error is not estimated. Arbitrary: 0.25 and 0.75 give the same depths and work of `fuzz_button.json` within
/// 0.1 %.
const SHORT: f64 = 0.5;

impl JumpControl {
    /// The next jump: fixed by the scene or chosen, and never beyond `remaining`.
    pub(crate) fn next(&mut self, accuracy: &Accuracy, stroke: Stroke, remaining: u64) -> u64 {
        let jump = match accuracy.cycle_jump {
            Some(fixed) => {
                let jump =
                    cycles_at_least((real_cycles(fixed) / accuracy.refinement.cycles).round());
                jump.clamp(1, remaining.max(1))
            }
            None => self.chosen(accuracy, stroke, remaining),
        };
        if self.most == 0 {
            jump
        } else {
            jump.min(self.most)
        }
    }

    /// A smaller jump in place of one that had no solution; `None` if it was a single cycle.
    pub(crate) fn cut(&mut self, failed: u64) -> Option<u64> {
        self.most = failed.div_ceil(CUT);
        (failed > 1).then_some(self.most)
    }

    /// A smaller jump in place of a long one whose estimated error is too large; `None` if it is accepted, or was fixed by the
    /// scene.
    pub(crate) fn rejected(&self, accuracy: &Accuracy, stroke: Stroke, jump: u64) -> Option<u64> {
        let allowed = stroke.largest_error(accuracy) / accuracy.refinement.cycles;
        let is_rejected = accuracy.cycle_jump.is_none() && self.error > REJECTED * allowed;
        let is_long = real_cycles(jump) > SHORTEST_REJECTED * real_cycles(self.done);
        (is_rejected && is_long && jump > 1).then(|| jump.div_ceil(CUT))
    }

    /// Limits the next jump.
    pub(crate) fn limit(&mut self, most: u64) {
        self.most = most;
    }

    /// The jump that the error allows, shortened to hit the end of what remains.
    fn chosen(&mut self, accuracy: &Accuracy, stroke: Stroke, remaining: u64) -> u64 {
        if self.base <= 0.0 || self.error <= 0.0 {
            return 1;
        }
        let (least, most) = accuracy.tuning.jump_change;
        let finer = accuracy.refinement.cycles;
        // A geometric sequence of jumps has `finer` times the members with this growth.
        let most = most.powf(1.0 / finer);
        let allowed = stroke.largest_error(accuracy) / finer;
        // A jump that was shortened does not slow down the growth.
        let longest = most * self.base.max(self.unshortened);
        let target = (self.base * allowed / self.error).clamp(least * self.base, longest);
        let most = stroke.most(accuracy, self.done);
        let target = target.min(most).max(1.0);
        self.unshortened = target;
        let short = if stroke.gross && !stroke.is_groove {
            cycles_at_least(most / accuracy.tuning.gross_taper)
        } else {
            0
        };
        // The last one before a cycle that is reported is a short one.
        match remaining.saturating_sub(short) {
            0 => remaining.max(1),
            before => even_share(target, before),
        }
    }

    /// Updates the control with the wear of a computed cycle on both surfaces, whose nodes have these weights: its equivalent
    /// depths before and after it. The widths of the nodes weigh bare surfaces; the rate of the layer there counts as well.
    pub(crate) fn update(
        &mut self,
        weights: Sides<&[f64]>,
        (before, after): (Sides<&[f64]>, Sides<&[f64]>),
        jump: u64,
    ) {
        let dn = real_cycles(jump);
        self.last = jump;
        self.done += jump;
        self.most = self.most.saturating_mul(2);
        if dn < SHORT * self.unshortened {
            return;
        }
        let (mut change, mut total, mut known) = (0.0, 0.0, true);
        for side in Side::BOTH {
            let (weights, rates) = (*weights.of(side), self.rate.of_mut(side));
            known &= rates.len() == weights.len();
            rates.resize(weights.len(), 0.0);
            let worn = before.of(side).iter().zip(*after.of(side));
            for ((old, (before, after)), width) in rates.iter_mut().zip(worn).zip(weights) {
                let rate = (after - before) / dn;
                change += width * (rate - *old).abs();
                total += width * rate;
                *old = rate;
            }
        }
        self.error = match (known, total > 0.0) {
            (false, _) => 0.0,
            (true, false) => SMALLEST_ERROR,
            (true, true) => (0.5 * change / total).max(SMALLEST_ERROR),
        };
        self.weighted_error += self.error * total * dn;
        self.worn += total * dn;
        self.base = dn;
    }

    /// Wear of each point of both surfaces per physical cycle in the last computed one, as equivalent depth, mm.
    pub(crate) fn rates(&self) -> Sides<&[f64]> {
        self.rate.as_slices()
    }

    /// Largest wear of a point of each surface per physical cycle in the last computed one, as equivalent depth, mm.
    pub fn fastest_rate(&self) -> Sides<f64> {
        self.rate.largest_of_each()
    }

    /// Estimated relative error of the worn depth so far.
    pub fn mean_error(&self) -> f64 {
        if self.worn > 0.0 {
            self.weighted_error / self.worn
        } else {
            0.0
        }
    }
}

/// Divides the remaining cycles into equal jumps not larger than the target, so that none is tiny.
fn even_share(target: f64, remaining: u64) -> u64 {
    let pieces = crate::number::count_at_least(real_cycles(remaining) / target);
    let share = real_cycles(remaining) / real(pieces);
    u64::try_from(crate::number::count_at_least(share))
        .unwrap_or(1)
        .min(remaining.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Refinement;

    const ACCURACY: Accuracy = Accuracy::from_tolerance(0.02);

    /// Wears the only node of the receptacle.
    fn wear(control: &mut JumpControl, before: f64, after: f64, jump: u64) {
        let depth = |receptacle: f64| Sides {
            slider: vec![0.0],
            receptacle: vec![receptacle],
        };
        let widths = Sides {
            slider: &[1.0][..],
            receptacle: &[1.0][..],
        };
        control.update(
            widths,
            (depth(before).as_slices(), depth(after).as_slices()),
            jump,
        );
    }

    const STROKE: Stroke = Stroke {
        gross: false,
        smoothing: 0.0,
        is_groove: false,
        both: false,
        error_factor: 1.0,
        skew: 0.0,
        cycles: 1_000,
    };

    #[test]
    fn a_steady_rate_lets_jumps_grow_and_a_changing_one_shrinks_them() {
        let mut control = JumpControl::default();
        assert_eq!(control.next(&ACCURACY, STROKE, 1000), 1);
        wear(&mut control, 0.0, 8.0, 8);
        wear(&mut control, 8.0, 16.0, 8);
        assert_eq!(control.next(&ACCURACY, STROKE, 64), 16);
        wear(&mut control, 16.0, 40.0, 8);
        assert!(control.next(&ACCURACY, STROKE, 1000) < 8);
    }

    #[test]
    fn either_surface_controls_the_jump() {
        let swap = |depth: &Sides<Vec<f64>>| Sides {
            slider: depth.receptacle.clone(),
            receptacle: depth.slider.clone(),
        };
        let depth = |receptacle: [f64; 2]| Sides {
            slider: vec![0.0; 3],
            receptacle: receptacle.to_vec(),
        };
        let (of_two, of_three) = ([1.0, 2.0], [1.0; 3]);
        let states = [[0.0, 0.0], [1.0, 2.0], [3.0, 3.0], [7.0, 4.0]].map(depth);
        let (mut one, mut other) = (JumpControl::default(), JumpControl::default());
        for step in states.windows(2) {
            let widths = Sides {
                slider: &of_three[..],
                receptacle: &of_two[..],
            };
            one.update(widths, (step[0].as_slices(), step[1].as_slices()), 5);
            let widths = Sides {
                slider: &of_two[..],
                receptacle: &of_three[..],
            };
            let swapped = [swap(&step[0]), swap(&step[1])];
            other.update(widths, (swapped[0].as_slices(), swapped[1].as_slices()), 5);
        }
        assert!((one.error - other.error).abs() < 1e-15 && one.error > 0.1);
        assert!((one.fastest_rate().receptacle - 0.8).abs() < 1e-15);
        assert!((other.fastest_rate().slider - 0.8).abs() < 1e-15);
        assert!((one.mean_error() - other.mean_error()).abs() < 1e-15);
    }

    const GROSS: Stroke = Stroke {
        gross: true,
        ..STROKE
    };

    #[test]
    fn gross_sliding_jumps_a_small_part_of_the_cycles_done() {
        let mut control = JumpControl::default();
        wear(&mut control, 0.0, 100.0, 100);
        wear(&mut control, 100.0, 200.0, 100);
        assert_eq!(control.next(&ACCURACY, STROKE, 10_000), 200);
        assert_eq!(control.next(&ACCURACY, GROSS, 10_000), 24);
    }

    #[test]
    fn a_jump_that_hits_a_cycle_does_not_slow_down_the_growth() {
        let mut control = JumpControl::default();
        wear(&mut control, 0.0, 100.0, 100);
        wear(&mut control, 100.0, 200.0, 100);
        // 200 are allowed, 10 remain before a report.
        assert_eq!(control.next(&ACCURACY, STROKE, 10), 10);
        wear(&mut control, 200.0, 210.0, 10);
        assert_eq!(control.next(&ACCURACY, STROKE, 10_000), 209);
    }

    #[test]
    fn the_last_jump_of_gross_sliding_before_a_report_is_a_short_one() {
        let mut control = JumpControl::default();
        wear(&mut control, 0.0, 100.0, 100);
        wear(&mut control, 100.0, 200.0, 100);
        let next = |remaining| control.clone().next(&ACCURACY, GROSS, remaining);
        assert_eq!([40, 20, 10, 5, 3].map(next), [19, 17, 7, 2, 3]);
        // Not that of a scar, nor of a groove.
        assert_eq!(control.clone().next(&ACCURACY, STROKE, 40), 40);
        let groove = Stroke {
            is_groove: true,
            ..GROSS
        };
        assert_eq!(control.next(&ACCURACY, groove, 40), 40);
    }

    #[test]
    fn a_jump_that_would_skew_the_pressure_is_reduced() {
        let mut control = JumpControl::default();
        wear(&mut control, 0.0, 100.0, 100);
        wear(&mut control, 100.0, 200.0, 100);
        let skewed = |skew| Stroke { skew, ..STROKE };
        assert_eq!(control.next(&ACCURACY, skewed(0.005), 8_000), 80);
        assert_eq!(control.next(&ACCURACY, skewed(1.0), 8_000), 8);
    }

    #[test]
    fn refined_jumps_are_shorter_and_grow_more_slowly() {
        let refined = |cycles| Accuracy {
            refinement: Refinement {
                cycles,
                ..Refinement::NONE
            },
            ..ACCURACY
        };
        let mut control = JumpControl::default();
        wear(&mut control, 0.0, 100.0, 100);
        wear(&mut control, 100.0, 200.0, 100);
        // As steady as it is, the jump grows by 2, 4 and the root of 2, up to the 200 cycles done over the refinement.
        for (cycles, jump) in [(1.0, 200), (0.5, 400), (2.0, 100)] {
            let next = control.next(&refined(cycles), STROKE, 1_000_000);
            assert!(next.abs_diff(jump) <= 1, "{cycles}: {next}");
        }
        let fixed = Accuracy {
            cycle_jump: Some(100),
            ..refined(0.25)
        };
        assert_eq!(control.next(&fixed, STROKE, 1_000), 400);
    }

    #[test]
    fn a_fixed_jump_stops_at_what_remains() {
        let fixed = Accuracy {
            cycle_jump: Some(100),
            ..ACCURACY
        };
        assert_eq!(JumpControl::default().next(&fixed, STROKE, 250), 100);
        assert_eq!(JumpControl::default().next(&fixed, STROKE, 50), 50);
    }
}
