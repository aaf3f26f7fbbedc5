//! State of a run along a line between two computed cycles.

use serde::{Deserialize, Serialize};

use super::height::Height;
use crate::along_line::SectionsState;
use crate::contact::{ContactState, Work};
use crate::cycle::{Checks, Neutral, WarmStarts};
use crate::model::Model;
use crate::schedule::jump::JumpControl;
use crate::sides::Sides;

/// Everything that the next cycle of a station depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct StationState {
    pub(super) contact: ContactState,
    /// Vertical worn depth at the contact nodes, mm.
    pub(super) depth: Sides<Vec<f64>>,
    /// Integrals of the wear rates, mm^2.
    pub(super) worn_area: Sides<f64>,
    /// Integral of p |slip| over contact and cycles, N/mm mm.
    pub(super) path: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub(super) energy: f64,
    /// Half-width of the unworn contact, and its mean over the last computed cycle, mm.
    pub(super) unworn_half_width: f64,
    pub(super) mean_half_width: f64,
    /// The contact at the last passage of the neutral position.
    pub(super) neutral: Neutral,
    pub(super) jump: JumpControl,
    pub(super) warm_starts: WarmStarts,
    /// Worn depths at which its operators were last built, mm; `None` of the unworn section.
    pub(super) built: Option<Sides<Vec<f64>>>,
    /// Width of its zones over that of the layout.
    pub(super) widened: f64,
    /// Worst residuals so far.
    pub(super) checks: Checks,
    /// Work of its contact solves.
    pub(super) work: Work,
}

/// State that all stations share.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct CommonLineState {
    /// Height of a rigid top.
    pub(super) height: Height,
    /// Displacement of the slider, mm.
    pub(super) slider_x: f64,
    /// Increments of the run, and iterations for the common height in these.
    pub(super) increments: usize,
    pub(super) iterations: usize,
    /// Worst imbalance of forces with the normals of the surfaces as worn, over the force.
    pub(super) imbalance: f64,
}

/// State of all stations between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StationsState {
    pub(super) stations: Vec<StationState>,
    pub(super) common: CommonLineState,
}

/// State of a run along a line between two computed cycles.
pub type LineState = SectionsState<StationsState>;

impl StationState {
    /// An unworn, unloaded station.
    pub(super) fn unworn(contact: ContactState, model: &Model) -> Self {
        let nodes = model.bodies.as_ref().map(|body| body.contact_x().len());
        Self {
            contact,
            depth: nodes.map(|nodes| vec![0.0; nodes]),
            worn_area: Sides::default(),
            path: 0.0,
            energy: 0.0,
            unworn_half_width: 0.0,
            mean_half_width: 0.0,
            neutral: Neutral::default(),
            jump: JumpControl::default(),
            warm_starts: WarmStarts::default(),
            built: None,
            widened: 1.0,
            checks: Checks::default(),
            work: Work::default(),
        }
    }
}

impl LineState {
    /// Largest wear of a place of each side per cycle in the last computed one, as equivalent depth, mm.
    pub(crate) fn fastest_rate(&self) -> Sides<f64> {
        let rates = self
            .sections
            .stations
            .iter()
            .map(|station| station.jump.fastest_rate());
        rates.fold(Sides::default(), |most, rate| {
            most.zip(rate)
                .map(|(most, rate): (f64, f64)| most.max(rate))
        })
    }

    /// Increments of the run, and iterations for the common height in these.
    pub(crate) fn solves(&self) -> (usize, usize) {
        (
            self.sections.common.increments,
            self.sections.common.iterations,
        )
    }

    /// Work of all contact solves.
    pub(crate) fn work(&self) -> Work {
        let mut work = Work::default();
        for station in &self.sections.stations {
            work += station.work;
        }
        work
    }
}
