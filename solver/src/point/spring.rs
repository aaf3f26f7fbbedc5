//! The load of a spring, which relaxes as the slider sinks: F = F_0 - k (delta - delta_0), with the approach delta of the increment before.
//!
//! The contact gives way to a change of the load by its own stiffness, 2 E* sqrt(a b), so that the change converges for a spring that is
//! stiffer, too: dF (1 + k/(2 E* sqrt(a b))) = F_0 - k (delta - delta_0) - F. Limiting case: a dead load.

use super::section::half_lengths;
use super::state::State;
use crate::closed_form::PointScene;

/// Smallest part of the load that a spring keeps: a contact without load has no solution.
const LEAST_LOAD: f64 = 1e-4;

/// Load of the next increment, N.
pub(super) fn next_force_n(scene: &PointScene, state: &State) -> f64 {
    let spring = scene.spring_n_per_mm;
    if spring <= 0.0 {
        return scene.force_n;
    }
    let unworn = state.unworn_approach_mm.unwrap_or(state.approach_mm);
    let (along, across) = half_lengths(&state.pressure);
    let cells = state.lattice.cells();
    let half_length = (along * cells.dx_mm * across * cells.dz_mm).sqrt();
    let stiffness = 2.0 * scene.modulus() * half_length;
    let lost = spring * (state.approach_mm - unworn);
    let change = (scene.force_n - lost - state.force_n) / (1.0 + spring / stiffness);
    let least = LEAST_LOAD * scene.force_n;
    (state.force_n + change).clamp(least, scene.force_n)
}
