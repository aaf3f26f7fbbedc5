//! An observer that records everything.

use solver::SolveError;
use solver::history::{CycleReport, DepthProfile, Snapshot, Summary};
use solver::observer::{Event, Flow, Observer};
use solver::scene::Scene;

/// All reports and snapshots of a run.
#[derive(Default)]
pub(crate) struct Recorder {
    pub(crate) reports: Vec<CycleReport>,
    pub(crate) snapshots: Vec<Snapshot>,
}

impl Observer for Recorder {
    fn on(&mut self, event: Event<'_>) -> Flow {
        match event {
            Event::Phase(_) | Event::Checkpoint(_) => {}
            Event::Cycle(report) => self.reports.push(report.clone()),
            Event::Snapshot(snapshot) => self.snapshots.push(snapshot.clone()),
        }
        Flow::Continue
    }
}

impl Recorder {
    /// The report at a physical cycle.
    pub(crate) fn at(&self, cycle: u64) -> &CycleReport {
        let found = self.reports.iter().find(|report| report.cycle == cycle);
        found.expect("the cycle is reported")
    }

    /// Receptacle profile after the last cycle.
    pub(crate) fn last_profile(&self) -> &DepthProfile {
        &self
            .snapshots
            .last()
            .expect("the last cycle has a snapshot")
            .receptacle
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

/// Solves a scene; returns its summary with all reports and snapshots.
pub(crate) fn solve(scene: &Scene) -> Result<(Summary, Recorder), SolveError> {
    let mut recorder = Recorder::default();
    let summary = solver::run::solve(scene, &mut recorder)?;
    Ok((summary, recorder))
}
