//! Mesh and integration settings.

use super::tuning::Tuning;
use crate::number::count_at_least;

/// Tolerance of pressures, and of the resistance that follows from them, over that of depth, width and area.
pub(crate) const PRESSURE_TOLERANCES: f64 = 3.0;

/// Mesh and integration settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Requested relative accuracy of worn depth and scar width.
    pub tolerance: f64,
    /// Surface element size under the contact, mm; chosen from the tolerance if absent.
    pub contact_element_mm: Option<f64>,
    /// Half-width of the narrowest contact that elements and increments of strokes are chosen for, mm; the unworn one if absent
    /// (`resolution::first_flat`).
    pub narrowest_contact_mm: Option<f64>,
    /// Increments a computed cycle; chosen from the contact width if absent.
    pub increments_per_cycle: Option<u32>,
    /// Physical cycles per computed cycle; chosen from the tolerance if absent.
    pub cycle_jump: Option<u64>,
    /// Constants by which the tolerance chooses these.
    pub tuning: Tuning,
    /// Factors on what is given or chosen.
    pub refinement: Refinement,
    /// True if companions estimate the error and choose the refinement (`error_control`).
    pub estimate_errors: bool,
}

/// Factors by which mesh, increments and jumps are finer than the tolerance chooses them or the user gives them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Factor on the number of elements everywhere: every size, and every growth from one element to the next, is
    /// divided by it.
    pub mesh: f64,
    /// Factor on the number of increments a cycle.
    pub increments: f64,
    /// Factor on the number of computed cycles: jumps, and what bounds them, are divided by it.
    pub cycles: f64,
}

impl Refinement {
    /// As chosen or given.
    pub const NONE: Self = Self {
        mesh: 1.0,
        increments: 1.0,
        cycles: 1.0,
    };
}

/// Most increments in which the load is applied: the error is far below any tolerance. Arbitrary.
const MOST_LOAD_STEPS: f64 = 200.0;

impl Accuracy {
    /// Everything chosen from a tolerance, without an estimate of errors.
    pub const fn from_tolerance(tolerance: f64) -> Self {
        Self {
            tolerance,
            contact_element_mm: None,
            narrowest_contact_mm: None,
            increments_per_cycle: None,
            cycle_jump: None,
            tuning: Tuning::FITTED,
            refinement: Refinement::NONE,
            estimate_errors: false,
        }
    }

    /// Largest displacement of an increment for a contact of a half-width, mm.
    pub(crate) fn largest_step(&self, half_width: f64) -> f64 {
        let half_width = half_width.max(self.narrowest_contact_mm.unwrap_or(0.0));
        self.step_over_half_width() * half_width / self.refinement.increments
    }

    /// Displacement of an increment over the half-width of the contact that it is chosen for, before any refinement.
    pub(crate) fn step_over_half_width(&self) -> f64 {
        let Tuning {
            step, loose_step, ..
        } = &self.tuning;
        let step = if self.tolerance > 0.02 {
            loose_step
        } else {
            step
        };
        step.at(self.tolerance)
    }

    /// The stiffness is rebuilt when a spine has lost this part of its length since it was last built.
    pub(crate) fn drift_share(&self) -> f64 {
        let (least, most) = self.tuning.drift_bounds;
        (self.tuning.drift.at(self.tolerance) / self.refinement.mesh).clamp(least, most)
    }

    /// Number of increments in which the load is applied.
    pub(crate) fn load_steps(&self) -> usize {
        let steps = self
            .tuning
            .load_steps
            .at(self.tolerance)
            .min(MOST_LOAD_STEPS);
        count_at_least(steps * self.refinement.increments)
    }
}
