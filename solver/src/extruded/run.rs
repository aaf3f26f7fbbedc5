//! The cycles of extruded bodies without a service around them.

use std::ops::ControlFlow;

use super::error::ExtrudedError;
use super::integrator::ExtrudedIntegrator;
use super::record::ExtrudedSummary;
use super::scene::ExtrudedScene;
use crate::along_line::StationCycle;
use crate::effects;

/// Simulates extruded bodies. Cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that extruded bodies do not describe, a body that cannot be meshed or condensed, a contact without a solution.
pub fn run(
    scene: &ExtrudedScene,
    on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
) -> Result<ExtrudedSummary, ExtrudedError> {
    let plan = effects::plan(&scene.plane());
    let mut integrator = ExtrudedIntegrator::unloaded(scene, &plan)?;
    let mut state = integrator.load()?;
    let (initial, approach_mm) = (state.last().clone(), integrator.approach_mm());
    let outcome = integrator.run(&mut state, on_cycle)?;
    Ok(ExtrudedSummary {
        outcome,
        initial,
        approach_mm,
        last: state.last().clone(),
        computed_cycles: state.computed().0,
        solves: state.solves(),
        relocations: state.relocations(),
        profiles: (0..state.last().stations.len())
            .map(|plane| integrator.profile(plane))
            .collect(),
        pressures_mpa: integrator.pressures_mpa(),
    })
}
