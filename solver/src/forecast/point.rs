//! Cost model of the run of a point contact, before anything is solved: its schedule on worn shapes of closed form.
//!
//! The jump control of the run is applied to a contact whose half-length b grows as the arc that has worn off, b^2 = a^2 + 2 R h. The
//! wear per cycle of a contact that grows from b_0 to b_1 changes by the part 1 - (b_0/b_1)^2 of it, of which the run's estimate is a
//! share.

use crate::law::surface::SurfaceWear;
use crate::model::resolution::{self, worn_depth_after};
use crate::number::{count_at_least, real, real_cycles};
use crate::point::{JumpForecast, PointScene, SlipRegime};
use crate::scene::Scene;
use crate::sides::Side;

/// Estimated work of the run of a point contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PointForecast {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// Most contact solves of a cycle.
    pub most_increments: usize,
    /// Contact solves of the whole run.
    pub increments: f64,
    /// Iterations of these times the cells of their windows.
    pub cell_iterations: f64,
    /// Most cells of a window.
    pub most_cells: usize,
    /// Most cells of the grids of both bodies together.
    pub surface_cells: usize,
}

/// Share of the change of the wear per cycle in the estimate of the run. Fitted to runs of `sd_card` and of a ball of steel.
const SHARE: f64 = 0.25;
/// Half-length of the window over that of the contact; mean over a run of windows that widen by thirds.
const WINDOW: f64 = 1.6;
/// Iterations of a solve: about 12 of an unworn contact, 6 where it wears.
const ITERATIONS: f64 = 7.0;
/// Solves of an increment through layers.
const REPETITIONS: f64 = 2.5;
/// Cells along a half-length from which on they are merged, over the chosen ones.
const MERGED: f64 = 2.2;

/// Forecasts the run of a scene; `None` for one that is no point contact.
pub fn point_forecast(scene: &Scene) -> Option<PointForecast> {
    let contact = PointScene::of(scene, SlipRegime::Gross)?;
    let (along, across) = contact.half_lengths_mm();
    let radius = resolution::radius(scene);
    let cycles = resolution::expected_cycles(scene, along);
    let wear = scene.surface_wear();
    let half_length = |done: u64| {
        let depth = worn_depth_after(scene, (along, &wear), done);
        (along * along + 2.0 * radius * depth.slider.max(depth.receptacle)).sqrt()
    };
    let layered = Side::BOTH.map(|side| wear.of(side).is_some_and(SurfaceWear::depends_on_depth));
    let repetitions = if layered.contains(&true) {
        REPETITIONS
    } else {
        1.0
    };
    let amplitude = scene.motion.amplitude_mm();
    let (mut forecast, mut jumps) = (PointForecast::default(), JumpForecast::of(&contact));
    let (mut done, mut length) = (0, along);
    while done < cycles {
        let jump = jumps.next((done, cycles - done), length);
        let grown = half_length(done + jump);
        jumps.update(jump, SHARE * (1.0 - (length / grown).powi(2)));
        (done, length) = (done + jump, grown);
        let solves = solves(&contact, amplitude, length);
        let cells_along = contact.accuracy.cells_per_half_length * coarsened(length / along);
        let cells = (2.0 * WINDOW * cells_along).powi(2);
        forecast.computed_cycles += 1.0;
        forecast.most_increments = forecast.most_increments.max(solves);
        forecast.increments += repetitions * real(solves);
        forecast.cell_iterations += repetitions * real(solves) * ITERATIONS * cells;
        forecast.most_cells = forecast.most_cells.max(count_at_least(cells));
        let strip = (amplitude / length + WINDOW) / WINDOW;
        let both = 2.0 * cells * strip * (across / along).max(1.0);
        forecast.surface_cells = forecast.surface_cells.max(count_at_least(both));
        if forecast.computed_cycles >= MOST_CYCLES {
            let rest = real_cycles(cycles) / real_cycles(done);
            forecast.computed_cycles *= rest;
            forecast.increments *= rest;
            forecast.cell_iterations *= rest;
            break;
        }
    }
    Some(forecast)
}

/// Computed cycles that are forecast one by one; the rest is extrapolated from them.
const MOST_CYCLES: f64 = 3_000.0;

/// Contact solves of a cycle of a contact of a half-length, mm.
fn solves(contact: &PointScene, amplitude: f64, length: f64) -> usize {
    let cell = length / contact.accuracy.cells_per_half_length;
    if amplitude < 0.5 * cell {
        return 1;
    }
    let step = contact.accuracy.step_over_half_length * length;
    4 * count_at_least(amplitude / step) + 1
}

/// Cells over the chosen ones of a contact that has grown by a factor and whose cells are merged in pairs.
fn coarsened(grown: f64) -> f64 {
    let mut cells = grown;
    while cells > MERGED {
        cells *= 0.5;
    }
    cells
}
