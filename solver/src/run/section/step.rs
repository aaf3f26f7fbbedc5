//! One computed cycle of a run, or what the run needs in its place.

use super::progress::now;
use crate::SolveError;
use crate::checkpoint::SectionRun;
use crate::cycle::{CycleError, CycleRecord, CycleState, Integrator};
use crate::effects::{Crossing, EffectsPlan};
use crate::model::Model;
use crate::record::{self, Exposed};
use crate::scene::{Motion, Scene};
use crate::schedule::stops;

/// Update that a run needs before its next cycle.
pub(super) enum RequiredUpdate {
    /// The stiffness of the bodies: the geometry has drifted, or the contact has outgrown its zones.
    Stiffness,
    /// Effects that were skipped.
    Effects,
    /// The motion of the next block of a mission.
    Motion,
}

/// Result of a step.
pub(super) enum Step {
    /// A computed cycle, and the state before it.
    Cycle(Box<CycleState>, Box<CycleRecord>),
    /// The motion of the block.
    MotionChanged,
    /// The state before, which needs something else.
    Update(RequiredUpdate),
}

/// Computes the next cycle, up to `until_limit` at most, or changes the motion to that of the present block from the one that the run has
/// `left`.
///
/// # Errors
/// A contact without a solution, whatever effects are simulated.
pub(super) fn step(
    scene: &Scene,
    plan: &EffectsPlan,
    model: &Model,
    integrator: &mut Integrator<'_>,
    run: &mut SectionRun,
    left: Option<Motion>,
    until_limit: u64,
) -> Result<Step, SolveError> {
    let before = run.state.cycle_state.clone();
    let record = match left {
        Some(motion) => integrator
            .change_motion(&mut run.state.cycle_state, motion)
            .map(|()| None),
        None => next_cycle(scene, model, integrator, run, until_limit).map(Some),
    };
    let record = match record {
        Ok(Some(record)) => record,
        Ok(None) => {
            run.motion_changed();
            return Ok(Step::MotionChanged);
        }
        Err(error) if error.needs_wider_zones() => {
            run.state.cycle_state = before;
            run.state.widen();
            return Ok(Step::Update(RequiredUpdate::Stiffness));
        }
        Err(error) => {
            let required = required_after(error, plan, before.cycle);
            if required.is_empty() {
                return Err(error.into());
            }
            run.state.cycle_state = before;
            run.crossings.extend(required);
            return Ok(Step::Update(RequiredUpdate::Effects));
        }
    };
    let state = &run.state.cycle_state;
    let depth = state.depth.largest_of_each();
    let required = plan.crossed(scene, before.cycle, state.cycle, depth);
    if required.is_empty() {
        return Ok(Step::Cycle(Box::new(before), Box::new(record)));
    }
    run.state.cycle_state = before;
    run.crossings.extend(required);
    Ok(Step::Update(RequiredUpdate::Effects))
}

/// The skipped effects that an error after so many cycles requires: those that a contact without a solution may have one with.
fn required_after(error: CycleError, plan: &EffectsPlan, cycle: u64) -> Vec<Crossing> {
    match error {
        CycleError::Increment { .. } => plan.required_after_failure(cycle),
        CycleError::Melts { .. } => Vec::new(),
    }
}

/// The next computed cycle, within the present block of a mission and up to a cycle.
fn next_cycle(
    scene: &Scene,
    model: &Model,
    integrator: &mut Integrator<'_>,
    run: &mut SectionRun,
    until_limit: u64,
) -> Result<CycleRecord, CycleError> {
    let state = &run.state.cycle_state;
    let depth = |side, part| record::worn_surface(model, state, side).depth_of_part(part);
    let now = now(scene, model, &integrator.spines, run);
    let next = stops::next(scene, now, depth).min(until_limit);
    let position = run.mission.as_ref().map(|mission| mission.position);
    let (until, is_reported) =
        position.map_or((next, true), |position| position.next_reported(scene, next));
    integrator.compute_cycle(&mut run.state.cycle_state, until, is_reported)
}
