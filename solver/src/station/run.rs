//! The cycles of a line without a service around them.

use std::ops::ControlFlow;

use super::error::StationError;
use super::integrator::LineIntegrator;
use super::record::{StationOutcome, StationSummary};
use super::scene::StationScene;
use crate::along_line::{Ending, StationCycle};
use crate::effects;

/// Simulates a contact along a line. Its cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that stations do not describe, a section that cannot be meshed, a contact without a solution.
pub fn run(
    scene: &StationScene,
    mut on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
) -> Result<StationSummary, StationError> {
    let plan = effects::plan(&scene.plane());
    let (mut integrator, mut state) = LineIntegrator::start(scene, &plan)?;
    let initial = state.last().clone();
    let mut outcome = StationOutcome::Completed;
    while state.cycle() < scene.section.cycles {
        integrator.compute_cycle(&mut state, scene.section.cycles)?;
        if on_cycle(state.last()).is_break() {
            outcome = StationOutcome::Stopped;
            break;
        }
        if let Some(ending) = integrator.ending() {
            outcome = match ending {
                Ending::WornThrough(station) => StationOutcome::WornThrough { station },
                Ending::DeeperThanRadius(station) => StationOutcome::DeeperThanRadius { station },
            };
            break;
        }
    }
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
