//! Histories: what a run leaves behind, append only.

use serde::{Deserialize, Serialize};

use crate::fields::BodyFields;

/// State after a computed cycle; cycle 0 is the unworn, loaded state.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleReport {
    /// Physical cycles done.
    pub cycle: u64,
    /// Physical cycles that the last computed cycle stood for.
    pub jump: u64,
    /// Estimated relative error of worn depth made by the last jump.
    pub jump_error: f64,
    /// Accumulated imposed sliding distance, mm.
    pub sliding_distance_mm: f64,
    /// The receptacle's wear.
    pub receptacle: SideReport,
    /// The slider's wear.
    pub slider: SideReport,
    /// Worn depth of the receptacle at the stations of the scene, mm.
    pub station_depth_mm: Vec<f64>,
    /// Normal load that a spring leaves at the neutral position, N/mm.
    pub load_n_per_mm: f64,
    /// Highest contact pressure at the neutral position, on the way to +x, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the width of the contact at the neutral position, mm.
    pub contact_half_width_mm: f64,
    /// Accumulated energy dissipated by friction, mJ per mm of depth.
    pub dissipated_energy_mj_per_mm: f64,
}

/// One side's wear.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SideReport {
    /// Largest worn depth, mm.
    pub max_depth_mm: f64,
    /// Worn area of the section, mm^2.
    pub worn_area_mm2: f64,
    /// k P' s for the whole load sliding the whole imposed distance, mm^2; `None` where nothing wears or a spring
    /// changes the load.
    pub ideal_area_mm2: Option<f64>,
    /// Half the width of the scar, mm.
    pub scar_half_width_mm: f64,
}

/// Profiles, pressures and the friction loop at one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Physical cycles done.
    pub cycle: u64,
    /// Worn depth over the receptacle's surface.
    pub receptacle: DepthProfile,
    /// Worn depth over the slider's surface, x in the slider's own frame.
    pub slider: DepthProfile,
    /// Tractions at the neutral, rightmost and leftmost position of the cycle.
    pub positions: Vec<TractionField>,
    /// Friction force over the imposed displacement of the cycle.
    pub friction_loop: FrictionLoop,
    /// Fields inside the bodies at the same positions, if the scene asks for them.
    pub fields: Vec<PlacedFields>,
}

/// Fields of both bodies at one position of the slider.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedFields {
    /// Where in the cycle.
    pub position: Position,
    /// The slider's, its nodes where they are then.
    pub slider: BodyFields,
    /// The receptacle's.
    pub receptacle: BodyFields,
}

/// Worn depth along a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DepthProfile {
    /// Places along the surface, mm.
    pub x_mm: Vec<f64>,
    /// Worn depth, mm.
    pub depth_mm: Vec<f64>,
}

/// Contact tractions on the receptacle at one position of the slider.
#[derive(Debug, Clone, PartialEq)]
pub struct TractionField {
    /// Where in the cycle.
    pub position: Position,
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x_mm: f64,
    /// Places on the receptacle, mm.
    pub x_mm: Vec<f64>,
    /// Normal pressure, MPa.
    pub pressure_mpa: Vec<f64>,
    /// Shear traction on the receptacle, MPa.
    pub shear_mpa: Vec<f64>,
}

/// Named positions of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// Slider at x = 0 on its way to +x.
    Neutral,
    /// Slider at its rightmost place.
    Rightmost,
    /// Slider at its leftmost place.
    Leftmost,
}

/// Friction force over displacement during one cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrictionLoop {
    /// Imposed displacement, mm.
    pub displacement_mm: Vec<f64>,
    /// Force of the slider on the receptacle along x, N/mm.
    pub tangential_force_n_per_mm: Vec<f64>,
}

impl FrictionLoop {
    /// Lets the closed loop begin after its first `steps` increments.
    pub(crate) fn begin_at(&mut self, steps: usize) {
        self.displacement_mm.rotate_left(steps);
        self.tangential_force_n_per_mm.rotate_left(steps);
    }
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// All cycles were done.
    Completed,
    /// A stop condition was met.
    StopCondition,
    /// A body was nearly consumed.
    WornThrough,
    /// The observer asked to stop.
    Stopped,
}

/// What a finished run leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Why it ended.
    pub outcome: Outcome,
    /// The state at the end.
    pub last: CycleReport,
    /// The unworn, loaded state.
    pub initial: Initial,
    /// What the settings came to.
    pub resolution: Resolution,
    /// Worst residuals that were met.
    pub checks: Checks,
}

/// The unworn, loaded state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Initial {
    /// Highest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the width of the contact, mm.
    pub contact_half_width_mm: f64,
}

/// What the settings came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Elements along the receptacle's contact surface.
    pub contact_elements: usize,
    /// Increments a computed cycle (the most that were used).
    pub increments_per_cycle: u32,
    /// Computed cycles.
    pub computed_cycles: u64,
    /// Contact increments that were solved.
    pub increments: u64,
    /// Degrees of freedom of both meshes.
    pub dofs: usize,
    /// How often the operators were rebuilt after the first time.
    pub relocations: u64,
    /// Accumulated estimate of the relative error made by cycle jumps; the error of the mesh is not in it.
    pub estimated_relative_error: f64,
}

/// Worst residuals over the run, each relative to its scale.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// |sum of vertical forces - load| over the load on the unworn contact.
    pub force_balance: f64,
    /// |worn area of the profile - accumulated k times integral of p |slip|| / worn area.
    pub worn_area: f64,
    /// Largest violation of gap >= 0, p >= 0, p gap = 0, over its scale.
    pub complementarity: f64,
    /// Largest excess of |q| over mu p, over the peak pressure.
    pub friction_cone: f64,
    /// Largest |sum of shear forces| over mu times the sum of normal ones; 1 in gross slip.
    pub friction_use: f64,
}
