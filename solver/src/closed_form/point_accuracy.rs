//! Grid and integration of a point contact, by the tolerance and what the user gives.

use crate::scene::Scene;

/// Tolerance that a grid of 12 cells and steps of a quarter suffice for. The powers below it are arbitrary: errors are stated, and grids that
/// are too coarse refined.
const SUFFICIENT_FOR: f64 = 0.02;

/// `part_over_distance` at that tolerance. The deepest places are those with a pressure for each cell within 0.2 %, of a long groove within 0.1 %
/// (`point::integrator::implicit::tests`).
const PART_OVER_DISTANCE: f64 = 1.0;

/// Grid and integration settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointAccuracy {
    /// Largest estimated relative error of the wear of a jump.
    pub tolerance: f64,
    /// Cells along each half-length of the unworn contact; the grid coarsens as the contact grows.
    pub cells_per_half_length: f64,
    /// Displacement of an increment over the half-length of the contact.
    pub step_over_half_length: f64,
    /// Length of the part of a long stroke that has one pressure in an implicit jump, over its distance from where such parts begin; 0 for none.
    pub part_over_distance: f64,
    /// Cycles of a computed one; chosen from the tolerance if absent.
    pub cycle_jump: Option<u64>,
    /// Factor on the number of computed cycles: jumps, and what bounds them, are divided by it.
    pub cycles_refinement: f64,
    /// True if jumps are implicit in the worn shapes where they can be and where that saves work (`Tuning::implicit_jumps`).
    pub implicit_jumps: bool,
}

impl PointAccuracy {
    /// Grid and steps for a tolerance: those that suffice for 2 %, and finer ones below. Coarser grids leave their companions too few
    /// cells.
    pub fn from_tolerance(tolerance: f64) -> Self {
        let finer = (SUFFICIENT_FOR / tolerance).max(1.0);
        Self {
            tolerance,
            cells_per_half_length: 12.0 * finer.powf(0.25),
            step_over_half_length: 0.25 * finer.powf(-0.2),
            part_over_distance: PART_OVER_DISTANCE * finer.powf(-0.2),
            cycle_jump: None,
            cycles_refinement: 1.0,
            implicit_jumps: false,
        }
    }
    /// Grid and steps for the tolerance of a scene whose contact has a half-length in mm, with what the user gives, and refined.
    pub(super) fn of(scene: &Scene, along: f64) -> Self {
        let accuracy = &scene.accuracy;
        let chosen = Self::from_tolerance(accuracy.tolerance);
        let refinement = accuracy.refinement;
        let given = accuracy.contact_element_mm.map(|cell| along / cell);
        let cells = given.unwrap_or(chosen.cells_per_half_length);
        let path = scene.motion.distance_per_cycle_mm();
        // Increments of no motion have no length.
        let given = accuracy
            .increments_per_cycle
            .map(|count| path / (f64::from(count) * along))
            .filter(|step| *step > 0.0);
        let step = given.unwrap_or(chosen.step_over_half_length);
        Self {
            cells_per_half_length: cells * refinement.mesh,
            step_over_half_length: step / refinement.increments,
            part_over_distance: chosen.part_over_distance / refinement.increments,
            cycle_jump: accuracy.cycle_jump,
            cycles_refinement: refinement.cycles,
            implicit_jumps: accuracy.tuning.implicit_jumps && !scene.friction.changes(),
            ..chosen
        }
    }
}
