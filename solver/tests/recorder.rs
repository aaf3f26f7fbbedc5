//! An observer that records everything.

use std::ops::ControlFlow;

use solver::observer::{Event, Observer};
use solver::record::{CycleReport, DepthProfile, Snapshot, Summary};
use solver::scene::Scene;
use solver::{SolveError, interpolation};

/// All reports and snapshots of a run.
#[derive(Default)]
pub(crate) struct Recorder {
    pub(crate) reports: Vec<CycleReport>,
    pub(crate) snapshots: Vec<Snapshot>,
}

impl Observer for Recorder {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Checkpoint(_) => {}
            Event::Cycle(report) => self.reports.push(report.clone()),
            Event::Snapshot(snapshot) => self.snapshots.push(snapshot.clone()),
        }
        ControlFlow::Continue(())
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
    interpolation::linear(&profile.x_mm, &profile.depth_mm, x)
}

/// Solves a scene; returns its summary with all reports and snapshots.
pub(crate) fn solve(scene: &Scene) -> Result<(Summary, Recorder), SolveError> {
    let mut recorder = Recorder::default();
    let summary = solver::run::solve(scene, &mut recorder)?;
    Ok((summary, recorder))
}
