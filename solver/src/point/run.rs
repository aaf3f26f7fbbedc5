//! A run of a point contact by itself: its cycles, and its maps at the end.

use std::ops::ControlFlow;

use super::error::PointError;
use super::integrator::PointIntegrator;
use super::motions::PointMotions;
use super::record::{PointCycle, PointOutcome, PointSummary};
use crate::closed_form::PointScene;
use crate::sides::Sides;

/// Simulates a point contact. Its cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that is no point contact, a contact without a solution.
pub fn run(
    scene: &PointScene,
    mut on_cycle: impl FnMut(&PointCycle) -> ControlFlow<()>,
) -> Result<PointSummary, PointError> {
    let mut integrator = PointIntegrator::unloaded(&PointMotions::single(scene))?;
    let mut state = integrator.load()?;
    let initial = *state.last();
    let mut outcome = PointOutcome::Completed;
    while state.cycle() < scene.cycles {
        let cycle = integrator.compute_cycle(&mut state, scene.cycles)?;
        if on_cycle(&cycle).is_break() {
            outcome = PointOutcome::Stopped;
            break;
        }
    }
    Ok(PointSummary {
        outcome,
        initial,
        last: *state.last(),
        computed_cycles: state.computed,
        solves: state.sliding.work,
        depth: Sides::from_fn(|side| state.depth(side)),
        pressure_mpa: state.neutral.pressure_mpa,
        window: state.neutral.cells,
    })
}

#[cfg(test)]
mod tests;
