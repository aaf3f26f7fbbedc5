//! Number of physical cycles that the next computed one represents.
//!
//! As for line contacts (`schedule/jump.rs`), the error of a jump is half the change of the wear per cycle,
//!   e = 1/2 sum |r_new - r_old|/sum r_new over the cells of both surfaces,
//! and the next jump is the last one times the tolerance over e, at most twice and at least half of it, and no longer than the cycles
//! done.
//!
//! Where a part sticks, the wear per cycle ends: what slips is worn until it carries nothing. The change of a wear that adds little counts by
//! the share min(1, r N/h) of the wear per cycle in its mean over the N cycles that have worn h, so that the errors of all jumps
//! add up to the tolerance of the depth and not to that of a rate that vanishes.
//!
//! Each pass wears the whole jump, so that the contact rests on the leading-edge step that the pass leaves: over a body of the specific
//! wear rate k on which the contact travels by the length s, at most its own one 2 b, k jump s E*/b is the step over the
//! indentation. It skews the pressure by about a third of itself, and bounds the jump.

use serde::{Deserialize, Serialize};

use super::surface::WearSums;
use crate::closed_form::{CyclePath, PointAccuracy, PointScene, SlipRegime};
use crate::law::dose_laws::DoseLaws;
use crate::number::{cycles_at_least, real, real_cycles};
use crate::schedule::jump::implicit::{Earlier, ImplicitBounds};
use crate::schedule::jump::{CUT, Formula, SHORTEST_REJECTED, even_share};

/// Largest step over indentation of a jump from a tolerance of 2 % on; below, it falls with the root of the tolerance. A sphere on a flat
/// that alone wears by 2.6 um in 20 000 cycles of 0.3 of the unworn half-length, against jumps of a tenth of the tolerance: with 0.4 and
/// 2, 52 and 49 cycles, peak pressures 1.3 and 20 % off, depths 0.02 %.
const LARGEST_STEP: f64 = 0.4;
const AT_TOLERANCE: f64 = 0.02;

/// Estimated error of a jump over the tolerance: the volume is exact, and the depth of a scar follows from it. At 2 % depths were at most
/// 0.6 % off those of jumps by a fifth of the tolerance or less, where both bodies wear, and 0.1 % where one does.
const ALLOWED_ERROR: f64 = 2.0;

/// Estimated error of an implicit jump over the tolerance. A ball of 0.4 mm with gold over nickel on both sides is through to its base metal after
/// 15 347 cycles by 73 jumps at 2 %, 15 299 at 0.2 %.
const IMPLICIT_ERROR: f64 = 2.0;

/// Least implicit jump over the cycles done and the tolerance: cells that pass an interface leave an error of their own in jumps of any
/// length.
const LEAST_IMPLICIT: f64 = 2.0;

/// Largest implicit jump over the cycles done. With 0.3, 0.5 and 1 a thin gold lives 0.04, 0.13 and 0.36 % too short; with 1 the first jumps of a short
/// stroke at 10 % are 1.8 % off, and the pressures of a bare ball converge slowly where it wears tens of indentations at once.
const MOST_IMPLICIT: f64 = 0.3;

/// Change of a jump from one computed cycle to the next. Arbitrary.
const MOST_GROWTH: f64 = 2.0;
const LEAST_GROWTH: f64 = 0.5;

/// Estimated error over the tolerance from which on a jump is repeated with a part of its cycles (`CUT`).
const REJECTED: f64 = 3.0;

/// Floor of the estimate, far below any tolerance.
const SMALLEST_ERROR: f64 = 1e-9;

/// Iterations of a contact solve of a computed cycle, about 12 of an unworn contact and 3 to 8 where it wears, and of one of an implicit jump that
/// wears little against the indentation.
pub(crate) const ITERATIONS: f64 = 5.0;
pub(crate) const ITERATIONS_OF_IMPLICIT: f64 = 20.0;

/// The last jump and its error.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct JumpControl {
    last: f64,
    error: f64,
    most: u64,
    /// The last jump before it was shortened.
    unshortened: f64,
    formula: Formula,
}

/// Bounds of the next jump besides its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JumpBounds {
    /// Leading-edge step over the indentation that a cycle leaves.
    pub(crate) step: f64,
    /// Cycles within which a coefficient of friction by cycle changes by as much as it may in a jump.
    pub(crate) even_friction: f64,
}

impl JumpControl {
    /// The next jump.
    pub(crate) fn next(
        self,
        accuracy: &PointAccuracy,
        done: u64,
        remaining: u64,
        bounds: JumpBounds,
    ) -> u64 {
        if let Some(jump) = accuracy.cycle_jump {
            return jump.clamp(1, remaining.max(1));
        }
        if done == 0 || self.last <= 0.0 {
            return remaining.min(1);
        }
        let refinement = accuracy.cycles_refinement;
        let target = self.last * allowed_error(accuracy) / self.error;
        let target = target.clamp(LEAST_GROWTH * self.last, MOST_GROWTH * self.last);
        let by_step =
            largest_step(accuracy.tolerance) / (refinement * bounds.step.max(f64::MIN_POSITIVE));
        let by_growth = real_cycles(done) / refinement;
        let by_friction = bounds.even_friction / refinement;
        let target = target.min(by_step).min(by_growth).min(by_friction);
        let target = target.max(1.0);
        let target = if self.most > 0 {
            target.min(real_cycles(self.most))
        } else {
            target
        };
        // Equal shares of what remains, so that the last jump is no short one.
        let shares = cycles_at_least(real_cycles(remaining) / target);
        remaining.div_ceil(shares)
    }

    /// Bounds the next jump after one that was rejected.
    pub(super) fn limit(&mut self, most: u64) {
        self.most = most;
    }

    /// Takes the jump and the error of a computed cycle.
    pub(crate) fn update(&mut self, jump: u64, error: f64) {
        *self = Self {
            last: real_cycles(jump),
            error: error.max(SMALLEST_ERROR),
            most: 0,
            unshortened: 0.0,
            formula: Formula::ComputedCycle,
        };
    }

    /// Takes the jump and the error of an implicit jump.
    pub(crate) fn update_implicit(&mut self, jump: u64, error: f64, formula: Formula) {
        self.last = real_cycles(jump);
        self.error = error.max(SMALLEST_ERROR);
        self.most = self.most.saturating_mul(2);
        self.formula = formula;
    }

    /// The next implicit jump.
    pub(crate) fn next_implicit(
        &mut self,
        accuracy: &PointAccuracy,
        done: u64,
        remaining: u64,
    ) -> u64 {
        if self.last <= 0.0 || self.error <= 0.0 {
            return 1;
        }
        let last = Earlier {
            cycles: self.last,
            unshortened: self.unshortened,
            error: self.error,
            formula: self.formula,
        };
        let target = implicit_bounds(accuracy).target(last, done);
        self.unshortened = target;
        let jump = even_share(target, remaining.max(1));
        if self.most > 0 {
            jump.min(self.most)
        } else {
            jump
        }
    }

    /// Cycles of the last jump, implicit or computed, if there was one.
    pub(crate) fn last_jump(&self) -> Option<f64> {
        (self.last > 0.0).then_some(self.last)
    }
}

/// The laws of a contact whose jumps may be implicit in the worn shapes (`integrator::implicit`), unless it is that of a mission.
pub(crate) fn laws_of_implicit_jumps(contact: &PointScene) -> Option<DoseLaws> {
    let is_simple = contact.accuracy.implicit_jumps
        && contact.slip == SlipRegime::Gross
        && contact.path == CyclePath::ToAndFro
        && contact.spring_n_per_mm <= 0.0
        && contact.accuracy.cycle_jump.is_none();
    let wear = contact.bodies.as_ref().map(|body| body.wear);
    DoseLaws::of(&wear).filter(|_| is_simple)
}

/// Returns `true` if an implicit jump is longer than that of a computed cycle, or less work a cycle: computed cycles of long strokes take many
/// increments, whose contacts an implicit jump does not distinguish in the middle of the stroke.
pub(crate) fn saves_work(contact: &PointScene, along: f64, implicit: u64, computed: u64) -> bool {
    let step = contact.accuracy.step_over_half_length * along;
    let of_computed = ITERATIONS * contact.path_mm() / step;
    let pressures = contact.parts(along).pressures(contact.amplitude_mm.abs());
    // Before the jump and at its end.
    let of_implicit = ITERATIONS_OF_IMPLICIT * 2.0 * real(pressures);
    let (implicit, computed) = (real_cycles(implicit), real_cycles(computed));
    implicit >= computed || implicit * of_computed >= computed * of_implicit
}

/// Half the change of the wear per cycle over that wear.
pub(super) fn jump_error(sums: WearSums) -> f64 {
    if sums.total > 0.0 {
        0.5 * sums.change / sums.total
    } else {
        0.0
    }
}

/// Wear per cycle over its mean in the cycles before, at most 1.
pub(super) fn share_in_wear(sums: WearSums, done: u64) -> f64 {
    if sums.earlier > 0.0 {
        (sums.total * real_cycles(done) / sums.earlier).min(1.0)
    } else {
        1.0
    }
}

/// The jump to repeat a computed cycle with, if its error is too large and its jump not given.
pub(super) fn rejected(accuracy: &PointAccuracy, done: u64, jump: u64, error: f64) -> Option<u64> {
    let is_large = error > REJECTED * allowed_error(accuracy) && done > 1;
    (is_large && jump > 1 && accuracy.cycle_jump.is_none()).then(|| jump.div_ceil(CUT))
}

/// The jump to repeat an implicit one with, if its error is too large.
pub(super) fn rejected_implicit(
    accuracy: &PointAccuracy,
    done: u64,
    jump: u64,
    error: f64,
) -> Option<u64> {
    implicit_bounds(accuracy).rejected(error, jump, done)
}

fn allowed_error(accuracy: &PointAccuracy) -> f64 {
    ALLOWED_ERROR * accuracy.tolerance / accuracy.cycles_refinement
}

/// Bounds of implicit jumps.
fn implicit_bounds(accuracy: &PointAccuracy) -> ImplicitBounds {
    let (finer, tolerance) = (accuracy.cycles_refinement, accuracy.tolerance);
    ImplicitBounds {
        allowed: IMPLICIT_ERROR * tolerance / finer,
        least: LEAST_IMPLICIT * tolerance,
        // The error of the least jump is that of cells which pass an interface.
        shortest_rejected: SHORTEST_REJECTED.max(LEAST_IMPLICIT * tolerance / finer),
        most: MOST_IMPLICIT,
        finer,
        change: (LEAST_GROWTH, MOST_GROWTH.powf(1.0 / finer)),
    }
}

fn largest_step(tolerance: f64) -> f64 {
    LARGEST_STEP * (tolerance / AT_TOLERANCE).sqrt().min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of friction that does not change.
    fn even(step: f64) -> JumpBounds {
        JumpBounds {
            step,
            even_friction: f64::INFINITY,
        }
    }

    #[test]
    fn the_change_of_friction_bounds_a_jump() {
        let accuracy = PointAccuracy::from_tolerance(0.02);
        let mut control = JumpControl::default();
        control.update(100, 1e-6);
        let bounds = JumpBounds {
            even_friction: 30.0,
            ..even(1e-9)
        };
        assert_eq!(control.next(&accuracy, 10_000, 900, bounds), 30);
    }

    #[test]
    fn jumps_grow_while_the_wear_changes_little() {
        let accuracy = PointAccuracy::from_tolerance(0.02);
        let mut control = JumpControl::default();
        assert_eq!(control.next(&accuracy, 0, 1_000, even(1e-9)), 1);
        control.update(10, 1e-4);
        assert_eq!(control.next(&accuracy, 500, 1_000, even(1e-9)), 20);
        control.update(20, 0.03);
        assert_eq!(control.next(&accuracy, 520, 980, even(1e-9)), 27);
    }

    #[test]
    fn the_change_of_a_wear_that_ends_counts_by_what_it_adds() {
        let sums = WearSums {
            change: 1e-6,
            total: 1e-5,
            earlier: 0.1,
        };
        assert!((jump_error(sums) - 0.05).abs() < 1e-15);
        assert!((share_in_wear(sums, 1_000) - 0.1).abs() < 1e-15);
        assert!((share_in_wear(sums, 20_000) - 1.0).abs() < 1e-15);
        assert_eq!(
            (
                jump_error(WearSums::default()),
                share_in_wear(WearSums::default(), 0)
            ),
            (0.0, 1.0)
        );
    }

    #[test]
    fn the_leading_edge_step_bounds_a_jump() {
        let accuracy = PointAccuracy::from_tolerance(0.02);
        let mut control = JumpControl::default();
        control.update(100, 1e-6);
        assert_eq!(control.next(&accuracy, 10_000, 900, even(1e-2)), 40);
    }
}
