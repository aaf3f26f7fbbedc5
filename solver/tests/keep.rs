//! An observer that keeps everything.

use std::ops::ControlFlow;

use solver::SolveError;
use solver::history::{CycleReport, DepthProfile, Snapshot, Summary};
use solver::observer::{Event, Observer};
use solver::scene::Scene;

/// All reports and snapshots of a run.
#[derive(Default)]
pub(crate) struct Keep {
    pub(crate) reports: Vec<CycleReport>,
    pub(crate) snapshots: Vec<Snapshot>,
}

impl Observer for Keep {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Checkpoint(_) => {}
            Event::Cycle(report) => self.reports.push(report.clone()),
            Event::Snapshot(snapshot) => self.snapshots.push(snapshot.clone()),
        }
        ControlFlow::Continue(())
    }
}

impl Keep {
    /// The report at a physical cycle.
    pub(crate) fn at(&self, cycle: u64) -> &CycleReport {
        let found = self.reports.iter().find(|report| report.cycle == cycle);
        found.expect("the cycle was asked for")
    }

    /// The receptacle's profile at the end.
    pub(crate) fn last_profile(&self) -> &DepthProfile {
        &self.snapshots.last().expect("the end is kept").receptacle
    }
}

/// Depth of a profile at a place, mm.
pub(crate) fn depth_at(profile: &DepthProfile, x: f64) -> f64 {
    let i = profile
        .x_mm
        .partition_point(|&p| p < x)
        .clamp(1, profile.x_mm.len() - 1);
    let t = (x - profile.x_mm[i - 1]) / (profile.x_mm[i] - profile.x_mm[i - 1]);
    (1.0 - t) * profile.depth_mm[i - 1] + t * profile.depth_mm[i]
}

/// Solves a scene and keeps what it told.
pub(crate) fn solve(scene: &Scene) -> Result<(Summary, Keep), SolveError> {
    let mut keep = Keep::default();
    let summary = solver::run::solve(scene, &mut keep)?;
    Ok((summary, keep))
}
