//! Contacts that are computed in sections along a line: their cycles, and what runs report of them. The sections of a line are its stations,
//! those of extruded bodies their node planes.

mod checks;
mod contact;
mod error;
mod integrator;
mod record;
mod report;
mod run;
mod schedule;
mod slide;
mod state;

use serde::{Deserialize, Serialize};

use crate::sides::{Side, Sides};
pub(crate) use checks::{check_section, check_slip};
pub(crate) use contact::{SectionedContact, WornSection};
pub use error::SectionsError;
pub(crate) use integrator::SectionsIntegrator;
pub(crate) use record::{PositionContacts, SectionContact};
pub use run::SectionsOutcome;
pub(crate) use schedule::FollowedSection;
pub(crate) use slide::{Sections, SectionsIncrement};
pub use state::SectionsState;

/// Where a section lies on its line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Along {
    /// Angle from the direction of motion on a ring, degrees.
    AngleDeg(f64),
    /// Distance from the middle of a straight line, mm.
    DistanceMm(f64),
}

/// A section after a computed cycle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StationReport {
    /// Where it lies.
    pub at: Along,
    /// Length of the line that it stands for, mm.
    pub weight_mm: f64,
    /// Largest worn depth, mm.
    pub max_depth_mm: Sides<f64>,
    /// Worn area, mm^2.
    pub worn_area_mm2: Sides<f64>,
    /// Integral of the pressure, as a mean over the sliding distance of the computed cycle, N/mm: on inclined walls more than the vertical
    /// force. The present vertical force before the first.
    pub line_load_n_per_mm: f64,
    /// Peak pressure at the neutral position, MPa.
    pub peak_pressure_mpa: f64,
    /// Half-width of the contact there, mm.
    pub half_width_mm: f64,
}

/// A computed cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StationCycle {
    /// Cycles done.
    pub cycle: u64,
    /// Cycles that this computed one stands for; 0 for the unworn contact.
    pub jump: u64,
    /// All sections in their order.
    pub stations: Vec<StationReport>,
    /// Vertical force of all sections at the neutral position, N.
    pub force_n: f64,
    /// Worn volume by the final shapes, mm^3.
    pub worn_volume_mm3: Sides<f64>,
    /// Wear rate times the integral of p |slip| over contact and time, mm^3; `None` of layers.
    pub sliding_work_volume_mm3: Sides<Option<f64>>,
    /// Wear rate times F s, mm^3; `None` of layers, and where a spring changes the force.
    pub ideal_volume_mm3: Sides<Option<f64>>,
    /// Energy dissipated by friction since the run began, mJ.
    pub dissipated_energy_mj: f64,
    /// Mean coefficient of friction over the contact at the neutral position, weighted by its pressure, -.
    pub friction_coefficient: f64,
    /// Largest estimated relative error of the wear of a section in the jump.
    pub jump_error: f64,
    /// Increments of the computed cycle.
    pub increments: usize,
    /// Iterations for the common height in these.
    pub iterations: usize,
}

/// Worn depths of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct StationProfile {
    /// Length of the line that it stands for, mm.
    pub weight_mm: f64,
    /// Places of the nodes of each body in its own frame, mm.
    pub x_mm: Sides<Vec<f64>>,
    /// Vertical worn depth there, mm.
    pub depth_mm: Sides<Vec<f64>>,
}

impl StationCycle {
    /// Largest worn depth of each side, mm.
    pub(crate) fn max_depth_mm(&self) -> Sides<f64> {
        let stations = self.stations.iter().map(|station| station.max_depth_mm);
        stations.fold(Sides::default(), |most, depth| {
            let both = most.zip(depth);
            both.map(|(most, depth): (f64, f64)| most.max(depth))
        })
    }
}

impl StationProfile {
    /// Depths of the nodes of a side, mm, with the areas of the line that they stand for, mm^2.
    pub(crate) fn cells(&self, side: Side) -> impl Iterator<Item = (f64, f64)> + Clone + '_ {
        let x = self.x_mm.of(side);
        let last = x.len().saturating_sub(1);
        let depths = self.depth_mm.of(side).iter().enumerate();
        depths.map(move |(i, depth)| {
            let width = 0.5 * (x[(i + 1).min(last)] - x[i.saturating_sub(1)]);
            (*depth, width * self.weight_mm)
        })
    }
}

/// Why sections along a line cannot be worn on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// A body is nearly consumed in the section of this number.
    WornThrough(usize),
    /// The groove of the section of this number is as deep below an end of its surface as the slider's radius.
    DeeperThanRadius(usize),
}

/// Depth of a groove below the higher one of the ends of its surface, mm.
pub(crate) fn groove_mm(depth: &[f64]) -> f64 {
    let ends = depth.first().zip(depth.last());
    let rim = ends.map_or(0.0, |(first, last)| first.min(*last));
    depth.iter().fold(0.0, |most: f64, depth| most.max(*depth)) - rim
}

/// |worn area of a profile - integral of the wear rate| over the latter, of the worse side.
pub(crate) fn worn_area_residual(worn: Sides<f64>, expected: Sides<f64>) -> f64 {
    let residual = worn.zip(expected).map(|(area, expected)| {
        if expected > 0.0 {
            (area / expected - 1.0).abs()
        } else {
            0.0
        }
    });
    residual.slider.max(residual.receptacle)
}
