//! Cycle jump: the number of physical cycles that the next computed one represents.
//!
//! A computed cycle multiplies its wear by the jump dN, an Euler step in cycles. Its error is half the change of
//! the wear-rate profiles over the jump: with r = (worn depth of the cycle)/dN,
//!   e = 1/2 * integral |r_new - r_old| dx / integral r_new dx  over both surfaces,
//! relative to the wear of the step, and that of a coefficient of friction that follows from the wear (`cycle/friction.rs`). The next
//! jump scales with the tolerance over e. A coefficient of friction by cycle bounds it too, and no jump passes a point of its table.

use serde::{Deserialize, Serialize};

use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Accuracy, Motion, Scene, Tuning};
use crate::sides::{Side, Sides};

/// A computed cycle wears `jump` passes at once, so that scar and pressure are skewed toward the last pass, the
/// pressure by about a third of k jump s E*/b (b: half-width, s: stroke), which stays below this.
fn largest_skew(accuracy: &Accuracy) -> f64 {
    let tuning = &accuracy.tuning;
    tuning.skew.at(accuracy.tolerance).max(tuning.least_skew)
}

/// The same over the tolerance where the skew is not removed from what is reported. Measured with an inner loop in `McColl`'s scar: the
/// pressure is off by 9.7 % for 0.29 and by 2.6 % for 0.06.
const REPORTED_SKEW: f64 = 2.0;

/// A jump without a solution is divided by this; jumps may double again afterwards. Arbitrary: no result depends on it
/// as long as one of the jumps has a solution.
const CUT: u64 = 4;

/// Estimated error of a jump over the largest that is allowed, from which on it is not accepted. Arbitrary: accepted jumps
/// follow each other with errors of up to twice that.
const REJECTED: f64 = 3.0;

/// Shortest jump over the cycles done that is not accepted: a shorter one is no large part of the wear, and nodes that pass an interface
/// one by one leave an error of their own in jumps of any length. Arbitrary.
const SHORTEST_REJECTED: f64 = 0.01;

/// Least jump over the cycles done and the tolerance. Where a soft layer comes to be exposed under a hard one, the wear of the nodes at its
/// edge changes in jumps of any length, and the error does not fall with the jump. Measured in eight random plated lives to base metal at 2 %:
/// lives differ by less than 4e-5 from those without it, for a fifth to the whole of the time.
const LEAST_OF_DONE: f64 = 0.05;

/// Largest relative change of a coefficient of friction by cycle within a jump, over the tolerance. A jump takes the mean of its
/// cycles, so that energy and wear are exact to the second order in it, and the reported contact is off by half of it.
const CHANGE_OF_FRICTION: f64 = 1.0;

/// Floor of the error estimate: where nothing changes, or nothing wears, jumps grow as fast as they may. Any value far
/// below the smallest tolerance does the same.
const SMALLEST_ERROR: f64 = 1e-6;

/// Passes of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Passes {
    /// One to either side.
    Whole,
    /// Several of different lengths: no skew of a jump is removed from what is reported.
    Unequal,
}

/// Limits of a jump besides its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    /// Whether it is gross reciprocating sliding: the contact leaves its own width.
    pub(crate) gross: bool,
    /// k E*, by which a pass wears off the waves that earlier increments have left; 0 where the slider wears too.
    pub(crate) smoothing: f64,
    /// Whether only the receptacle wears, in a groove that is longer than the contact: jumps extrapolate single cycles.
    pub(crate) is_groove: bool,
    /// Whether both bodies wear, or one whose wear is in no proportion to the pressure.
    both: bool,
    /// Factor on the allowed error of a jump.
    error_factor: f64,
    passes: Passes,
    /// Pressure skew of a single cycle, k s E*/b.
    pub(crate) skew: f64,
    /// Cycles of the whole run.
    cycles: u64,
    /// Cycles within which the coefficient of friction changes by as much as it may in a jump.
    even_friction: f64,
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
            passes: Passes::Whole,
            skew: wear * 2.0 * amplitude * modulus / half_width,
            cycles,
            even_friction: f64::INFINITY,
        }
    }

    /// The stroke of a body whose wear is in no proportion to the pressure: the step of a jump lowers the pressure of a longer contact,
    /// which leaves the wear of other laws as it is.
    #[must_use]
    pub(crate) fn of_uneven_wear(self) -> Self {
        Self { both: true, ..self }
    }

    /// Limits jumps from a number of cycles on by the change of a coefficient of friction by cycle.
    pub(crate) fn limit_change_of_friction(&mut self, scene: &Scene, done: u64) {
        self.even_friction = even_friction(scene, done);
    }

    /// One that turns between its outermost turning points: several passes of different lengths wear the groove, which the
    /// extrapolation of two whole ones does not describe.
    #[must_use]
    pub(crate) fn turning_inside(self, motion: Motion) -> Self {
        let amplitude = motion.amplitude_mm().abs();
        Self {
            // Half of the path is passed to either side.
            skew: self.skew * motion.distance_per_cycle_mm() / (4.0 * amplitude),
            smoothing: 0.0,
            is_groove: false,
            passes: Passes::Unequal,
            ..self
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
            let tolerated = REPORTED_SKEW * tolerance / self.skew.max(f64::MIN_POSITIVE);
            let most = if self.passes == Passes::Unequal && tolerated >= 1.0 {
                tolerated
            } else {
                unskewed.max(sufficient)
            };
            (tuning.jump_of_done * done).min(most)
        };
        most.min(self.even_friction) / accuracy.refinement.cycles
    }
}

/// Cycles after so many within which a coefficient of friction by cycle changes by as much as it may in a jump.
pub(crate) fn even_friction(scene: &Scene, done: u64) -> f64 {
    let part = CHANGE_OF_FRICTION * scene.accuracy.tolerance;
    let table = scene.friction.by_cycle();
    table.map_or(f64::INFINITY, |table| {
        table.distance_of_change(real_cycles(done), part)
    })
}

/// The least jump after `done` cycles, unless its length is limited.
pub(crate) fn least_jump(accuracy: &Accuracy, done: u64) -> f64 {
    LEAST_OF_DONE * accuracy.tolerance * real_cycles(done)
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
    /// That by the change of friction in the last jump, however short.
    friction: f64,
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
        let error = self.error.max(self.friction);
        let is_rejected = accuracy.cycle_jump.is_none() && error > REJECTED * allowed;
        let is_long = real_cycles(jump) > SHORTEST_REJECTED * real_cycles(self.done);
        (is_rejected && is_long && jump > 1).then(|| jump.div_ceil(CUT))
    }

    /// Records that the next jump is that of several controls, which a longer one of this control does not count for: its error is
    /// estimated whatever it would have chosen alone.
    pub(crate) fn share(&mut self, jump: u64) {
        self.unshortened = self.unshortened.min(real_cycles(jump));
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
        let target = target.max(least_jump(accuracy, self.done));
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
    /// depths before and after it. The widths of the nodes weigh bare surfaces; the rate of the layer there counts as well. An
    /// error by the change of friction in it is added.
    pub(crate) fn update(
        &mut self,
        (weights, friction): (Sides<&[f64]>, f64),
        (before, after): (Sides<&[f64]>, Sides<&[f64]>),
        jump: u64,
    ) {
        let dn = real_cycles(jump);
        self.last = jump;
        self.done += jump;
        self.friction = friction;
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
            (true, true) => (0.5 * change / total + friction).max(SMALLEST_ERROR),
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

    /// Sum of estimated error times wear, and of wear.
    pub(crate) fn weighted_error(&self) -> (f64, f64) {
        (self.weighted_error, self.worn)
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
mod tests;
