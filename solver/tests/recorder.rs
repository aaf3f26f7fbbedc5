//! An observer that records everything.

use std::ops::ControlFlow;

use solver::error_control;
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
            Event::Restart(_) => *self = Self::default(),
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
    let summary = error_control::solve(scene, &mut recorder)?;
    Ok((summary, recorder))
}

/// Largest distance of two profiles at the nodes of either, over the largest depth of the second.
pub(crate) fn largest_distance(a: &DepthProfile, b: &DepthProfile) -> f64 {
    let places = a.x_mm.iter().chain(&b.x_mm);
    let apart = |x: &f64| (depth_at(a, *x) - depth_at(b, *x)).abs();
    let deepest = b.depth_mm.iter().fold(0.0, |m: f64, d| m.max(*d));
    places.map(apart).fold(0.0, f64::max) / deepest
}

/// Area between two profiles over the area of the second.
pub(crate) fn area_between(a: &DepthProfile, b: &DepthProfile) -> f64 {
    const PLACES: u32 = 20_000;
    let (first, last) = (b.x_mm[0], b.x_mm[b.x_mm.len() - 1]);
    let places = (0..PLACES).map(|i| first + (last - first) * f64::from(i) / f64::from(PLACES));
    let (mut between, mut below) = (0.0, 0.0);
    for x in places {
        between += (depth_at(a, x) - depth_at(b, x)).abs();
        below += depth_at(b, x);
    }
    between / below
}

/// Asserts that the largest depth of a run of a tolerance of 2 % is within it, and within the error that the run states.
pub(crate) fn check_stated_error(name: &str, done: &Summary, fine: &Summary) {
    let errors = done.errors.expect("errors are estimated");
    let off = (done.last.receptacle.max_depth_mm / fine.last.receptacle.max_depth_mm - 1.0).abs();
    println!(
        "{name}: depth {:.3} % off, stated {:?}",
        100.0 * off,
        errors.worn_depth
    );
    assert!(
        off < 0.02 && off <= errors.worn_depth.relative,
        "{off} {errors:?}"
    );
}
