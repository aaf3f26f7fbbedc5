//! The cycles of extruded bodies without a service around them.

use std::ops::ControlFlow;

use super::error::ExtrudedError;
use super::integrator::ExtrudedIntegrator;
use super::record::{ExtrudedOutcome, ExtrudedSummary};
use super::scene::ExtrudedScene;
use crate::along_line::{Ending, StationCycle};
use crate::effects;

/// Simulates extruded bodies. Cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that extruded bodies do not describe, a body that cannot be meshed or condensed, a contact without a solution.
pub fn run(
    scene: &ExtrudedScene,
    mut on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
) -> Result<ExtrudedSummary, ExtrudedError> {
    let plan = effects::plan(&scene.plane());
    let (mut integrator, mut state) = ExtrudedIntegrator::start(scene, &plan)?;
    let (initial, approach_mm) = (state.last().clone(), integrator.approach_mm());
    let mut outcome = ExtrudedOutcome::Completed;
    while state.cycle() < scene.section.cycles {
        integrator.compute_cycle(&mut state, scene.section.cycles)?;
        if on_cycle(state.last()).is_break() {
            outcome = ExtrudedOutcome::Stopped;
            break;
        }
        if let Some(ending) = integrator.ending() {
            outcome = match ending {
                Ending::WornThrough(plane) => ExtrudedOutcome::WornThrough { plane },
                Ending::DeeperThanRadius(plane) => ExtrudedOutcome::DeeperThanRadius { plane },
            };
            break;
        }
    }
    Ok(ExtrudedSummary {
        outcome,
        initial,
        approach_mm,
        last: state.last().clone(),
        computed_cycles: state.computed().0,
        solves: state.solves(),
        relocations: state.relocations(),
        profiles: (0..state.planes())
            .map(|plane| integrator.profile(plane))
            .collect(),
        pressures_mpa: integrator.pressures_mpa(),
    })
}
