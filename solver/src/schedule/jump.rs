//! Cycle jump: the number of physical cycles that the next computed one represents.
//!
//! A computed cycle multiplies its wear by the jump dN, an Euler step in cycles. Its error is half the change of
//! the wear-rate profiles over the jump: with r = (worn depth of the cycle)/dN,
//!   e = 1/2 * integral |r_new - r_old| dx / integral r_new dx  over both surfaces,
//! relative to the wear of the step, and that of a coefficient of friction that follows from the wear (`cycle/friction.rs`). The next
//! jump scales with the tolerance over e. A coefficient of friction by cycle bounds it too, and no jump passes a point of its table.

mod formula;
pub(crate) mod implicit;

use serde::{Deserialize, Serialize};

use super::stroke::Stroke;
use crate::change::Change;
use crate::law::surface::SurfaceWear;
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Accuracy, Scene};
use crate::sides::{Side, Sides};
pub(crate) use formula::Formula;

/// A jump without a solution is divided by this; jumps may double again afterwards. Arbitrary: no result depends on it
/// as long as one of the jumps has a solution.
pub(crate) const CUT: u64 = 4;

/// Estimated error of a jump over the largest that is allowed, from which on it is not accepted. Arbitrary: accepted jumps
/// follow each other with errors of up to twice that.
const REJECTED: f64 = 3.0;

/// Shortest jump over the cycles done that is not accepted: a shorter one is no large part of the wear, and nodes that pass an interface
/// one by one leave an error of their own in jumps of any length. Arbitrary.
pub(crate) const SHORTEST_REJECTED: f64 = 0.01;

/// Least jump over the cycles done and the tolerance. Where a soft layer comes to be exposed under a hard one, the wear of the nodes at its
/// edge changes in jumps of any length, and the error does not fall with the jump. Measured in eight random plated lives to base metal at 2 %:
/// lives differ by less than 4e-5 from those without it, for a fifth to the whole of the time.
const LEAST_OF_DONE: f64 = 0.05;

/// Floor of the error estimate: where nothing changes, or nothing wears, jumps grow as fast as they may. Any value far
/// below the smallest tolerance does the same.
const SMALLEST_ERROR: f64 = 1e-6;

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
    /// Formula of the last jump.
    formula: Formula,
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

    /// A smaller jump in place of a long one whose estimated error far exceeds what it may be, as where it has passed an interface of a
    /// plating: the rate before does not foresee that behind it. `None` if the jump is accepted, or was fixed by the scene, or where neither a
    /// rate nor the friction depends on the depth of a surface.
    pub(crate) fn shorter(
        &self,
        scene: &Scene,
        wear: &Sides<Option<SurfaceWear>>,
        stroke: Stroke,
        jump: u64,
    ) -> Option<u64> {
        let by_depth = |wear: Option<SurfaceWear>| wear.is_some_and(SurfaceWear::depends_on_depth);
        let friction = |side| scene.friction.follows_wear_of(side);
        let mut sides = Side::BOTH.into_iter();
        if !sides.any(|side| by_depth(*wear.of(side)) || friction(side)) {
            return None;
        }
        self.rejected(&scene.accuracy, stroke, jump)
    }

    /// The same whatever depends on the depth.
    fn rejected(&self, accuracy: &Accuracy, stroke: Stroke, jump: u64) -> Option<u64> {
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
        weights: Sides<&[f64]>,
        friction: f64,
        depth: Change<Sides<&[f64]>>,
        jump: u64,
    ) {
        let dn = real_cycles(jump);
        self.last = jump;
        self.done += jump;
        self.friction = friction;
        self.formula = Formula::ComputedCycle;
        self.most = self.most.saturating_mul(2);
        if dn < SHORT * self.unshortened {
            return;
        }
        let (mut change, mut total, mut known) = (0.0, 0.0, true);
        for side in Side::BOTH {
            let (weights, rates) = (*weights.of(side), self.rate.of_mut(side));
            known &= rates.len() == weights.len();
            rates.resize(weights.len(), 0.0);
            let worn = depth.before.of(side).iter().zip(*depth.after.of(side));
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
    pub(crate) fn fastest_rate(&self) -> Sides<f64> {
        self.rate.largest_of_each()
    }
}

/// Estimated relative error of the worn depth by the jumps of all controls so far, one for each motion of a run.
pub(crate) fn mean_error<'a>(controls: impl Iterator<Item = &'a JumpControl>) -> f64 {
    let (error, worn) = controls.fold((0.0, 0.0), |(error, worn), control| {
        (error + control.weighted_error, worn + control.worn)
    });
    if worn > 0.0 { error / worn } else { 0.0 }
}

/// Divides the remaining cycles into equal jumps not larger than the target, so that none is tiny.
pub(crate) fn even_share(target: f64, remaining: u64) -> u64 {
    let pieces = crate::number::count_at_least(real_cycles(remaining) / target);
    let share = real_cycles(remaining) / real(pieces);
    u64::try_from(crate::number::count_at_least(share))
        .unwrap_or(1)
        .min(remaining.max(1))
}

#[cfg(test)]
mod tests;
