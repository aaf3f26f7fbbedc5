//! One computed cycle of a run, or the update that it requires.

use super::contact::{Contact, RunOfContact};
use super::progress::next_cycle;
use crate::SolveError;
use crate::effects::{Crossing, EffectsPlan};
use crate::scene::Scene;

/// Update that a run needs before its next cycle.
pub(super) enum RequiredUpdate {
    /// The stiffness of the bodies: the geometry has drifted, or the contact has outgrown its zones.
    Stiffness,
    /// Effects that were skipped.
    Effects,
    /// The next block of a mission.
    Block,
}

/// Result of a step.
pub(super) enum Step<S> {
    /// A computed cycle, and the state before it.
    Cycle(S),
    /// The motion of the block.
    MotionChanged,
    /// The state before, which needs something else.
    Update(RequiredUpdate),
}

/// Computes the next cycle, up to `until_limit` at most, or changes the motion to that of the present block.
///
/// # Errors
/// A contact without a solution, whatever effects are simulated.
pub(super) fn step<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &mut C,
    run: &mut RunOfContact<C>,
    worn: &C::Worn,
    until_limit: u64,
) -> Result<Step<C::State>, SolveError> {
    let back_to = C::cycle(&run.state);
    if run.is_block_done(back_to) {
        return Ok(Step::Update(RequiredUpdate::Block));
    }
    if contact.has_drifted(scene, &run.state) {
        return Ok(Step::Update(RequiredUpdate::Stiffness));
    }
    let before = run.state.clone();
    let left = run.motion_left(scene);
    let computed = if let Some(from) = left {
        contact.change_motion(&mut run.state, from)
    } else {
        let next = next_cycle(scene, contact, run, worn, until_limit);
        contact.compute_cycle(&mut run.state, next.cycle, next.is_reported)
    };
    if let Err(error) = computed {
        if error.needs_wider_zones() {
            run.state = before;
            C::widen(&mut run.state);
            return Ok(Step::Update(RequiredUpdate::Stiffness));
        }
        let required = required_after(&error, plan, back_to);
        if required.is_empty() {
            return Err(error);
        }
        run.go_back(before, required);
        return Ok(Step::Update(RequiredUpdate::Effects));
    }
    if left.is_some() {
        run.motion_changed();
        return Ok(Step::MotionChanged);
    }
    let (cycle, depth) = (C::cycle(&run.state), C::max_depth_mm(&run.state));
    let required = plan.crossed(scene, back_to, cycle, depth);
    if required.is_empty() {
        return Ok(Step::Cycle(before));
    }
    run.go_back(before, required);
    Ok(Step::Update(RequiredUpdate::Effects))
}

/// The skipped effects that an error after so many cycles requires: those that a contact without a solution may have one with.
pub(super) fn required_after(error: &SolveError, plan: &EffectsPlan, cycle: u64) -> Vec<Crossing> {
    if error.may_need_effects() {
        plan.required_after_failure(cycle)
    } else {
        Vec::new()
    }
}
