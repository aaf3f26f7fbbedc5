//! State of a run of extruded bodies between two computed cycles.

use serde::{Deserialize, Serialize};

use crate::along_line::SectionsState;
use crate::contact::{ContactState, Work};
use crate::cycle::{Checks, Neutral, WarmStarts};
use crate::schedule::jump::JumpControl;
use crate::sides::Sides;

/// Everything that the next cycle of a node plane depends on, besides its contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct PlaneState {
    /// Vertical worn depth at the contact nodes, mm.
    pub(super) depth: Sides<Vec<f64>>,
    /// Integrals of the wear rates, mm^2.
    pub(super) worn_area: Sides<f64>,
    /// Integral of p |slip| over contact and cycles, N/mm mm.
    pub(super) path: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub(super) energy: f64,
    /// Vertical force at the end of the last increment, N/mm.
    pub(super) line_load: f64,
    /// The contact at the last passage of the neutral position.
    pub(super) neutral: Neutral,
    pub(super) warm_starts: WarmStarts,
}

/// State that increments change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Planes {
    pub(super) states: Vec<PlaneState>,
    /// Contact of each plane.
    pub(super) contacts: Vec<ContactState>,
    /// Mean half-width over the last computed cycle, mm, of planes in contact, weighted by their lengths.
    pub(super) mean_half_width: f64,
}

/// State that all planes share between two cycles.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct CommonPlaneState {
    /// Half-width of the unworn contact, mm.
    pub(super) unworn_half_width: f64,
    pub(super) jump: JumpControl,
    /// Worn depths of each plane at which the operators were last built, mm; none of the unworn bodies.
    pub(super) built: Vec<Sides<Vec<f64>>>,
    /// Width of the zones over that of the layout, in powers of 2.
    pub(super) widenings: u32,
}

/// Effort and worst residuals of the increments so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Effort {
    pub(super) increments: usize,
    pub(super) iterations: usize,
    pub(super) work: Work,
    pub(super) checks: Checks,
}

/// State of all planes between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlanesState {
    pub(super) planes: Planes,
    pub(super) common: CommonPlaneState,
    pub(super) effort: Effort,
}

/// State of a run of extruded bodies between two computed cycles.
pub type ExtrudedState = SectionsState<PlanesState>;

impl ExtrudedState {
    /// Largest wear of a node of each side per cycle in the last computed one, mm.
    pub(crate) fn fastest_rate(&self) -> Sides<f64> {
        self.sections.common.jump.fastest_rate()
    }

    /// Increments of the run, and Newton iterations in these.
    pub(crate) fn solves(&self) -> (usize, usize) {
        let effort = &self.sections.effort;
        (effort.increments, effort.iterations)
    }

    /// Work of all contact solves.
    pub(crate) fn work(&self) -> Work {
        self.sections.effort.work
    }
}
