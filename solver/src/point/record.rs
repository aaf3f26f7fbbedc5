//! What a run reports of a point contact.

use super::field::Field;
use crate::contact::area::Cells;
use crate::sides::Sides;

/// A computed cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointCycle {
    /// Cycles done.
    pub cycle: u64,
    /// Cycles that this computed one stands for; 0 for the unworn contact.
    pub jump: u64,
    /// Largest worn depth, mm.
    pub max_depth_mm: Sides<f64>,
    /// Worn volume, mm^3.
    pub worn_volume_mm3: Sides<f64>,
    /// Specific wear rate times sliding work, k F s in gross slip, mm^3; `None` for rates that depend on the depth.
    pub ideal_volume_mm3: Sides<Option<f64>>,
    /// Peak pressure at the neutral position, MPa; without the skew of the jump, unless single cycles are skewed that much too.
    pub peak_pressure_mpa: f64,
    /// Half-length of that contact along the sliding direction, mm.
    pub half_length_along_mm: f64,
    /// Half-length of that contact across it, mm.
    pub half_length_across_mm: f64,
    /// Energy dissipated since the run began, mu F s in gross slip, mJ (N mm).
    pub dissipated_energy_mj: f64,
    /// Estimated relative error of the wear of the jump.
    pub jump_error: f64,
    /// Contact solves of the computed cycle.
    pub increments: usize,
    /// Iterations of these.
    pub iterations: usize,
}

/// Worn depth of a body over its cells, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMap {
    /// Centres of the cells along the sliding direction from the middle of the body, mm.
    pub x_mm: Vec<f64>,
    /// Centres of the cells across it, mm.
    pub z_mm: Vec<f64>,
    /// Depth at (i, j), with the index i times the number of z plus j, mm.
    pub depth_mm: Vec<f64>,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointOutcome {
    /// All cycles are done.
    Completed,
    /// The depth that ends it was reached.
    StopDepth,
    /// The receiver of its cycles ended it.
    Stopped,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSummary {
    /// How it ended.
    pub outcome: PointOutcome,
    /// The loaded contact before any wear.
    pub initial: PointCycle,
    /// The last computed cycle.
    pub last: PointCycle,
    /// Computed cycles.
    pub computed_cycles: usize,
    /// Contact solves of the whole run, and their iterations.
    pub solves: (usize, usize),
    /// Worn depths at the end.
    pub depth: Sides<DepthMap>,
    /// Pressure of the contact at the neutral position, MPa, on its window.
    pub pressure_mpa: Vec<f64>,
    /// That window.
    pub window: Cells,
}

impl DepthMap {
    /// The map of depths on cells.
    pub(super) fn new(cells: &Cells, depth_mm: Vec<f64>) -> Self {
        Self {
            x_mm: (0..cells.along_x).map(|i| cells.x_mm(i)).collect(),
            z_mm: (0..cells.along_z).map(|j| cells.z_mm(j)).collect(),
            depth_mm,
        }
    }
}

/// Half-lengths of a contact along and across, in cells: to where the line load of the pressure, extended from the two outermost rows
/// on either side, vanishes, at most a row further. Exact for Hertz' ellipse, whose line load is a parabola, to the second order.
pub(super) fn half_lengths(pressure: &Field) -> (f64, f64) {
    let width = pressure.width();
    let along: Vec<f64> = pressure
        .values
        .chunks_exact(width)
        .map(|row| row.iter().sum())
        .collect();
    let mut across = vec![0.0; width];
    for row in pressure.values.chunks_exact(width) {
        for (sum, pressure) in across.iter_mut().zip(row) {
            *sum += pressure;
        }
    }
    (half_length(&along), half_length(&across))
}

fn half_length(load: &[f64]) -> f64 {
    let first = load.iter().position(|load| *load > 0.0);
    let last = load.iter().rposition(|load| *load > 0.0);
    let (Some(first), Some(last)) = (first, last) else {
        return 0.0;
    };
    if last - first < 2 {
        return 0.5 * crate::number::real(last - first + 1);
    }
    let beyond = |outer: f64, inner: f64| {
        if inner > outer {
            (outer / (inner - outer)).min(1.0)
        } else {
            1.0
        }
    };
    let ends = beyond(load[first], load[first + 1]) + beyond(load[last], load[last - 1]);
    0.5 * (crate::number::real(last - first) + ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_half_length_of_a_parabola_is_found_between_cells() {
        for edge in [8.2_f64, 8.5, 8.9] {
            let load: Vec<f64> = (0..24)
                .map(|i| (1.0 - ((f64::from(i) - 11.5) / edge).powi(2)).max(0.0))
                .collect();
            let found = half_length(&load);
            assert!((found / edge - 1.0).abs() < 0.012, "{edge}: {found}");
        }
    }
}
