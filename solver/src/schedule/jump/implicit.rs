//! Length of jumps that are implicit in the worn shapes (`cycle::implicit`).
//!
//! With the doses of one cycle d0 and d1 on the shapes before and after a jump, and the mean r of its cycles, the error is
//!   e = sum w |r - (d0 + d1)/2| / sum w r
//! over the nodes of both surfaces with their widths times specific rates w: the difference from the trapezoidal rule, of first order in
//! the jump for the Euler step, where r = d1, and of second order for the formula of two steps. No leading-edge step bounds the
//! jump.

pub(crate) mod formulas;

use super::formula::Formula;
use super::{JumpControl, LEAST_OF_DONE, REJECTED, SHORTEST_REJECTED, SMALLEST_ERROR, even_share};
use crate::number::real_cycles;
use crate::scene::Accuracy;
use crate::schedule::stroke::Stroke;
use crate::sides::Sides;

/// Allowed error of an implicit jump over that of a computed cycle: where a contact widens, the errors of all jumps have one sign. With 0.5
/// the lives of the presets' gold at 2 % are 0.3 % off (`verify_implicit_jumps.rs`).
const ALLOWED: f64 = 0.5;

/// Least jump over the cycles done and the tolerance, over that of computed cycles: the iteration converges however fast a layer
/// is that opens.
const LEAST: f64 = 5.0;

/// Least jump over the longest one of a computed cycle where its end needs a computed cycle, too.
const LEAST_SAVING: f64 = 2.0;

/// Largest jump over the one before for the formula of two steps, which is stable up to 2.4.
const MOST_RATIO: f64 = 2.1;

/// The last jump, if it was implicit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LastJump<'a> {
    /// Cycles.
    pub(crate) cycles: f64,
    /// Mean wear of a cycle in it, as equivalent depth, mm.
    pub(crate) rates: Sides<&'a [f64]>,
}

/// Wear of an implicit jump.
#[derive(Debug, Clone)]
pub(crate) struct ImplicitWear {
    pub(crate) formula: Formula,
    /// Mean wear of a cycle in it, as equivalent depth, mm.
    pub(crate) rates: Sides<Vec<f64>>,
    /// Estimated relative error.
    pub(crate) error: f64,
    /// Worn area of a cycle, mm^2.
    pub(crate) area: f64,
}

impl JumpControl {
    /// The next implicit jump, never beyond `remaining`.
    pub(crate) fn next_implicit(
        &mut self,
        accuracy: &Accuracy,
        stroke: Stroke,
        remaining: u64,
    ) -> u64 {
        let jump = self.chosen_implicit(accuracy, stroke, remaining);
        if self.most == 0 {
            jump
        } else {
            jump.min(self.most)
        }
    }

    fn chosen_implicit(&mut self, accuracy: &Accuracy, stroke: Stroke, remaining: u64) -> u64 {
        if self.base <= 0.0 || self.error <= 0.0 {
            return 1;
        }
        let last = Earlier {
            cycles: self.base,
            unshortened: self.unshortened,
            error: self.error,
            formula: self.formula,
        };
        let target = bounds(accuracy, stroke).target(last, self.done);
        self.unshortened = target;
        even_share(target, remaining.max(1))
    }

    /// Returns `true` if a jump of so many cycles and one computed cycle are less work than computed cycles alone.
    pub(crate) fn saves_cycles(&self, accuracy: &Accuracy, stroke: Stroke, jump: u64) -> bool {
        real_cycles(jump) >= LEAST_SAVING * stroke.most(accuracy, self.done)
    }

    /// The last jump, if it was implicit.
    pub(crate) fn last_implicit(&self) -> Option<LastJump<'_>> {
        (self.formula != Formula::ComputedCycle).then(|| LastJump {
            cycles: real_cycles(self.last),
            rates: self.rate.as_slices(),
        })
    }

    /// Updates the control with the wear of an implicit jump.
    pub(crate) fn update_implicit(&mut self, wear: ImplicitWear, jump: u64) {
        let ImplicitWear {
            formula,
            rates,
            error,
            area,
        } = wear;
        let cycles = real_cycles(jump);
        self.formula = formula;
        self.rate = rates;
        self.error = error.max(SMALLEST_ERROR);
        self.friction = 0.0;
        self.last = jump;
        self.base = cycles;
        self.done += jump;
        self.most = self.most.saturating_mul(2);
        self.weighted_error += self.error * area * cycles;
        self.worn += area * cycles;
    }

    /// A smaller jump in place of an implicit one whose estimated error is too large; `None` if it is accepted.
    pub(crate) fn rejected_implicit(
        &self,
        accuracy: &Accuracy,
        stroke: Stroke,
        jump: u64,
    ) -> Option<u64> {
        bounds(accuracy, stroke).rejected(self.error, jump, self.done)
    }
}

/// Bounds of the jumps of a stroke.
fn bounds(accuracy: &Accuracy, stroke: Stroke) -> ImplicitBounds {
    let finer = accuracy.refinement.cycles;
    let (least, most) = accuracy.tuning.jump_change;
    ImplicitBounds {
        allowed: ALLOWED * stroke.largest_error(accuracy) / finer,
        least: LEAST * LEAST_OF_DONE * accuracy.tolerance,
        most: accuracy.tuning.jump_of_done,
        shortest_rejected: SHORTEST_REJECTED,
        finer,
        change: (least, most.powf(1.0 / finer)),
    }
}

/// Bounds of implicit jumps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ImplicitBounds {
    /// Largest estimated error.
    pub(crate) allowed: f64,
    /// Least and largest jump over the cycles done, times the factor on the number of jumps.
    pub(crate) least: f64,
    pub(crate) most: f64,
    /// Shortest jump over the cycles done that is not accepted.
    pub(crate) shortest_rejected: f64,
    /// That factor.
    pub(crate) finer: f64,
    /// Least and largest jump over the one before.
    pub(crate) change: (f64, f64),
}

/// The jump before another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Earlier {
    pub(crate) cycles: f64,
    /// Cycles before it was shortened.
    pub(crate) unshortened: f64,
    /// Estimated error.
    pub(crate) error: f64,
    pub(crate) formula: Formula,
}

impl ImplicitBounds {
    /// Cycles of the next jump after so many.
    pub(crate) fn target(&self, last: Earlier, done: u64) -> f64 {
        let order = match last.formula {
            Formula::ComputedCycle | Formula::ImplicitEuler => 1.0,
            Formula::TwoSteps => 2.0,
        };
        let (least, most) = self.change;
        let longer = (self.allowed / last.error).powf(1.0 / order);
        let longest = most * last.cycles.max(last.unshortened);
        let target = (last.cycles * longer).clamp(least * last.cycles, longest);
        let done = real_cycles(done);
        target
            .max(self.least * done / self.finer)
            .min(self.most * done / self.finer)
            .max(1.0)
    }

    /// A smaller jump after so many cycles in place of one whose error is too large; `None` if it is accepted.
    pub(crate) fn rejected(&self, error: f64, jump: u64, done: u64) -> Option<u64> {
        let is_rejected = error > REJECTED * self.allowed;
        let is_long = real_cycles(jump) > self.shortest_rejected * real_cycles(done);
        (is_rejected && is_long && jump > 1).then(|| jump.div_ceil(super::CUT))
    }
}

/// The formula of a jump of a number of cycles after an implicit one, and the weight b of the doses at its end.
pub(crate) fn two_steps(last: Option<f64>, cycles: f64) -> (Formula, f64) {
    match last.filter(|last| cycles <= MOST_RATIO * last) {
        None => (Formula::ImplicitEuler, 1.0),
        Some(last) => {
            let ratio = cycles / last;
            (Formula::TwoSteps, (1.0 + ratio) / (1.0 + 2.0 * ratio))
        }
    }
}
