//! Resolves and solves a specification, recording all reports and snapshots.

use std::ops::ControlFlow;

use serde_json::Value;
use server::spec;
use solver::SolveError;
use solver::observer::{Event, Observer};
use solver::record::{CycleReport, Snapshot, Summary};
use solver::scene::Scene;

/// A run that has ended, with or without success.
pub(crate) struct Run {
    pub(crate) scene: Scene,
    pub(crate) reports: Vec<CycleReport>,
    pub(crate) snapshots: Vec<Snapshot>,
    pub(crate) end: Result<Summary, SolveError>,
}

impl Run {
    /// The summary of a run that succeeded.
    pub(crate) fn summary(&self) -> &Summary {
        self.end.as_ref().expect("the run goes through")
    }

    /// Deepest wear of the receptacle, mm.
    pub(crate) fn depth(&self) -> f64 {
        self.summary().last.receptacle.max_depth_mm
    }

    /// Worn area of the receptacle over k P s.
    pub(crate) fn area_ratio(&self) -> f64 {
        let worn = self.summary().last.receptacle;
        worn.worn_area_mm2
            / worn
                .ideal_area_mm2
                .expect("the receptacle wears under a dead load")
    }
}

/// Records a run, and stops it after a number of computed cycles.
struct Recorder {
    reports: Vec<CycleReport>,
    snapshots: Vec<Snapshot>,
    most_cycles: usize,
}

impl Observer for Recorder {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Checkpoint(_) => {}
            Event::Restart(_) => {
                self.reports.clear();
                self.snapshots.clear();
            }
            Event::Cycle(report) => self.reports.push(report.clone()),
            Event::Snapshot(snapshot) => self.snapshots.push(snapshot.clone()),
        }
        if self.reports.len() > self.most_cycles {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Scene of a valid specification.
pub(crate) fn scene(spec: &Value) -> Scene {
    let resolved = spec::read(spec.to_string().as_bytes());
    resolved.expect("the specification is accepted").scene
}

/// Solves a specification to its end.
pub(crate) fn solve(spec: &Value) -> Run {
    solve_part(scene(spec), usize::MAX)
}

/// Solves at most `most_cycles` computed cycles of a scene.
pub(crate) fn solve_part(scene: Scene, most_cycles: usize) -> Run {
    let mut recorder = Recorder {
        reports: Vec::new(),
        snapshots: Vec::new(),
        most_cycles,
    };
    let end = solver::run::solve(&scene, &mut recorder);
    Run {
        scene,
        reports: recorder.reports,
        snapshots: recorder.snapshots,
        end,
    }
}
