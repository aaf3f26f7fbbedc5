//! Runs in several threads: the same bits, stopped and resumed as in one.

use std::ops::ControlFlow;

use solver::checkpoint::Checkpoint;
use solver::error_control;
use solver::observer::{Event, Observer};
use solver::record::{Outcome, Summary};
use solver::scene::{Accuracy, Scene};

use crate::verification::scenes::{fuzz_button, mccoll};
use crate::verification::verify_error_control::{Delivered, outside_at_first};

/// Summary of a run, and everything that it has delivered besides checkpoints.
fn solved(scene: &Scene, threads: usize) -> String {
    let mut delivered = Delivered::default();
    let summary = error_control::solve(&in_threads(scene, threads), &mut delivered);
    let summary = summary.expect("it has a solution");
    assert!(summary.errors.is_some(), "{:?}", summary.warnings);
    let Delivered {
        recorder, restarts, ..
    } = delivered;
    format!(
        "{summary:?} {:?} {:?} {restarts:?}",
        recorder.reports, recorder.snapshots
    )
}

fn in_threads(scene: &Scene, threads: usize) -> Scene {
    Scene {
        threads,
        ..scene.clone()
    }
}

/// Bodies that are condensed again, whose errors are estimated.
fn relocated() -> Scene {
    let mut scene = fuzz_button();
    scene.cycles = 400;
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.accuracy.estimate_errors = true;
    scene.slider.wear.clone_from(&scene.receptacle.wear);
    scene
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for scene in [outside_at_first(), relocated()] {
        let alone = solved(&scene, 1);
        for threads in [2, 8] {
            assert!(solved(&scene, threads) == alone, "{threads} threads");
        }
    }
}

/// A short run with more companions than end before it.
fn with_many_companions() -> Scene {
    let mut scene = mccoll();
    scene.cycles = 40;
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.accuracy.estimate_errors = true;
    let mut scattered = scene.clone();
    scattered.cycles = 20_000;
    scattered.accuracy.cycle_jump = Some(20);
    scene.scattered = vec![scattered; 4];
    scene
}

/// Stops a run at the checkpoint of a number of those at its last cycle, which its companions have.
struct Stops {
    at: usize,
    cycles: u64,
    last: Option<Checkpoint>,
    is_stopped: bool,
}

impl Stops {
    fn new(at: usize, scene: &Scene) -> Self {
        Self {
            at,
            cycles: scene.cycles,
            last: None,
            is_stopped: false,
        }
    }
}

impl Observer for Stops {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        assert!(!self.is_stopped, "{event:?} after the run was stopped");
        let Event::Checkpoint(run) = event else {
            return ControlFlow::Continue(());
        };
        if run.cycle() < self.cycles {
            return ControlFlow::Continue(());
        }
        if self.at > 0 {
            self.at -= 1;
            return ControlFlow::Continue(());
        }
        (self.last, self.is_stopped) = (Some(run.checkpoint()), true);
        ControlFlow::Break(())
    }
}

fn resumed(scene: &Scene, threads: usize, from: &Checkpoint) -> Summary {
    let mut delivered = Delivered::default();
    let scene = in_threads(scene, threads);
    let summary = error_control::resume(&scene, from.clone(), &mut delivered);
    let reports = &delivered.recorder.reports;
    assert!(reports.is_empty(), "they were delivered: {reports:?}");
    summary.expect("it resumes")
}

#[test]
fn companions_that_outlast_the_run_are_stopped_and_resumed() {
    let scene = with_many_companions();
    let whole = error_control::solve(&scene, &mut Delivered::default()).expect("it has a solution");
    assert!(whole.errors.is_some(), "{:?}", whole.warnings);
    for (at, threads, then) in [(0, 2, 1), (5, 2, 2), (30, 3, 2), (30, 1, 3), (200, 2, 3)] {
        let mut stops = Stops::new(at, &scene);
        let stopped = error_control::solve(&in_threads(&scene, threads), &mut stops);
        let stopped = stopped.expect("it has a solution");
        assert_eq!(stopped.outcome, Outcome::Stopped, "{at} {threads}");
        let from = stops.last.expect("it was stopped at a checkpoint");
        assert_eq!(from.cycle(), scene.cycles);
        let summary = resumed(&scene, then, &from);
        assert_eq!(format!("{summary:?}"), format!("{whole:?}"), "{at}");
    }
}

/// Where no other companion is left, which gives the run no time to stop it later.
#[test]
fn a_run_is_stopped_at_the_last_checkpoint_of_its_last_companion() {
    let scene = with_many_companions();
    let mut whole = Delivered::default();
    error_control::solve(&scene, &mut whole).expect("it has a solution");
    let [.., before, last] = &whole.checkpoints[..] else {
        panic!("companions have checkpoints");
    };
    for threads in [1, 3] {
        let mut stops = Stops::new(0, &scene);
        let scene = in_threads(&scene, threads);
        let stopped = error_control::resume(&scene, before.clone(), &mut stops);
        assert_eq!(stopped.expect("it resumes").outcome, Outcome::Stopped);
        assert_eq!(stops.last.as_ref(), Some(last), "{threads} threads");
    }
}

/// Stops a run at its first computed cycle.
#[derive(Default)]
struct StopsAtOnce(bool);

impl Observer for StopsAtOnce {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        assert!(!self.0, "{event:?} after the run was stopped");
        match event {
            Event::Cycle(report) if report.cycle > 0 => {
                self.0 = true;
                ControlFlow::Break(())
            }
            _ => ControlFlow::Continue(()),
        }
    }
}

#[test]
fn a_run_that_is_stopped_stops_its_companions() {
    let scene = in_threads(&with_many_companions(), 3);
    let stopped = error_control::solve(&scene, &mut StopsAtOnce::default());
    let stopped = stopped.expect("it has a solution");
    assert_eq!(stopped.outcome, Outcome::Stopped);
    assert!(stopped.errors.is_none() && stopped.last.cycle < scene.cycles);
}

/// The checkpoint of one scene is no checkpoint of another; no companion outlives the refusal.
#[test]
fn a_checkpoint_that_does_not_fit_is_refused_in_threads_too() {
    let scene = with_many_companions();
    let mut stops = Stops::new(3, &scene);
    error_control::solve(&in_threads(&scene, 2), &mut stops).expect("it has a solution");
    let from = stops.last.expect("it was stopped at a checkpoint");
    let mut other = in_threads(&scene, 2);
    for scattered in &mut other.scattered {
        scattered.accuracy.tolerance = 0.02;
    }
    let refused = error_control::resume(&other, from, &mut Delivered::default());
    assert!(
        matches!(refused, Err(solver::SolveError::Checkpoint(_))),
        "{refused:?}"
    );
}
