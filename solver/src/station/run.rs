//! The cycles of a line without a service around them.

use std::ops::ControlFlow;

use super::error::StationError;
use super::integrator::LineIntegrator;
use super::record::StationSummary;
use super::scene::StationScene;
use crate::along_line::StationCycle;
use crate::effects;

/// Simulates a contact along a line. Its cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that stations do not describe, a section that cannot be meshed, a contact without a solution.
pub fn run(
    scene: &StationScene,
    on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
) -> Result<StationSummary, StationError> {
    let plan = effects::plan(&scene.plane());
    let mut integrator = LineIntegrator::unloaded(scene, &plan)?;
    let mut state = integrator.load()?;
    let initial = state.last().clone();
    let outcome = integrator.run(&mut state, on_cycle)?;
    Ok(StationSummary {
        outcome,
        initial,
        last: state.last().clone(),
        computed_cycles: state.computed().0,
        solves: state.solves(),
        relocations: state.relocations(),
        profiles: (0..scene.stations)
            .map(|station| integrator.profile(station))
            .collect(),
    })
}
