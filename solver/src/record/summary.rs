//! The summary of a run.

use serde::{Deserialize, Serialize};

use crate::contact::Work;
use crate::cycle::{Checks, CycleState};
use crate::effects::{Crossing, Verdict};
use crate::record::{Compared, CycleReport, Errors, Life, Warning};
use crate::scene::Effect;
use crate::schedule::mission_state::BlockWear;
use crate::schedule::stops::Outcome;
use crate::sides::Sides;

/// The unworn, loaded state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Initial {
    /// Highest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half-width of the contact, mm.
    pub contact_half_width_mm: f64,
    /// Resistance of the contact, mOhm; `None` where it is not computed.
    pub contact_resistance_mohm: Option<f64>,
}

/// Result of a finished run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Why it ended.
    pub outcome: Outcome,
    /// The state at the end.
    pub last: CycleReport,
    /// The unworn, loaded state.
    pub initial: Initial,
    /// Resolution that the accuracy settings led to.
    pub resolution: Resolution,
    /// Worst residuals of the run.
    pub checks: Checks,
    /// Estimated errors; `None` without companions.
    pub errors: Option<Errors>,
    /// Doubts about the result.
    pub warnings: Vec<Warning>,
    /// The decision about each effect at the end.
    pub effects: Vec<(Effect, Verdict)>,
    /// Skipped effects that the run has required, in their order.
    pub crossings: Vec<Crossing>,
    /// Life by the criteria of the scene.
    pub life: Life,
    /// Wear of each block of a mission; empty without a mission.
    pub blocks: Vec<BlockWear>,
    /// Histories that errors are estimated by.
    pub compared: Compared,
}

impl Summary {
    /// Wear of each block of a mission; of the whole run without a mission.
    pub fn block_wear(&self) -> Vec<BlockWear> {
        if !self.blocks.is_empty() {
            return self.blocks.clone();
        }
        let last = &self.last;
        let areas = Sides {
            slider: last.slider.worn_area_mm2,
            receptacle: last.receptacle.worn_area_mm2,
        };
        let energy = last.dissipated_energy_mj_per_mm;
        vec![BlockWear::whole(
            last.cycle,
            last.sliding_distance_mm,
            energy,
            areas,
        )]
    }
}

/// Resolution that the accuracy settings led to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Resolution {
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Elements along the receptacle's contact surface.
    pub contact_elements: usize,
    /// Increments per computed cycle (the maximum over the run).
    pub increments_per_cycle: u32,
    /// Computed cycles.
    pub computed_cycles: u64,
    /// Work of all contact solves.
    pub work: Work,
    /// Degrees of freedom of both meshes.
    pub dofs: usize,
    /// How often the operators were rebuilt after the first time.
    pub relocations: u64,
    /// Accumulated estimate of the relative error made by cycle jumps; the error of the mesh is not in it.
    pub estimated_relative_error: f64,
}

/// |worn area of the profile - accumulated integral of the wear rate| over the latter, of the worse side; 0 without
/// wear.
pub(crate) fn worn_area_residual(state: &CycleState, report: &CycleReport) -> f64 {
    let relative = |area: f64, expected: f64| {
        if expected > 0.0 {
            (area - expected).abs() / expected
        } else {
            0.0
        }
    };
    let Sides { slider, receptacle } = state.worn_area;
    relative(report.receptacle.worn_area_mm2, receptacle)
        .max(relative(report.slider.worn_area_mm2, slider))
}
