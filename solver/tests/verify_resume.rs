//! A run resumed from a checkpoint reaches the bits of the uninterrupted run.

use std::ops::ControlFlow;

use crate::verification::recorder::Recorder;
use crate::verification::scenes::{fuzz_button, mccoll};
use crate::verification::verify_long_wipe::{RATE, in_narrow_zones, shorten, wipe};
use crate::verification::verify_mission::vibrated_and_wiped;
use solver::SolveError;
use solver::checkpoint::{Checkpoint, CheckpointMismatch};
use solver::observer::{Event, Observer};
use solver::record::{CycleReport, Outcome, Snapshot, Summary};
use solver::run;
use solver::scene::{Accuracy, Motion, Scene};
use solver::sides::Sides;

/// An observer that records everything, checkpoints included.
#[derive(Default)]
pub(crate) struct CheckpointRecorder {
    recorder: Recorder,
    checkpoints: Vec<Checkpoint>,
}

impl Observer for CheckpointRecorder {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if let Event::Checkpoint(checkpoint) = event {
            self.checkpoints.push(checkpoint.checkpoint());
        }
        self.recorder.on(event)
    }
}

/// Every bit that a run reports after a cycle. The shortest text of a number identifies its bits, except those of NaN,
/// which a run never reports.
fn bits_after(cycle: u64, recorder: &Recorder, summary: &Summary) -> String {
    let reports: Vec<&CycleReport> = recorder
        .reports
        .iter()
        .filter(|r| r.cycle > cycle)
        .collect();
    let snapshots: Vec<&Snapshot> = recorder
        .snapshots
        .iter()
        .filter(|s| s.cycle > cycle)
        .collect();
    let text = format!("{reports:?} {snapshots:?} {summary:?}");
    assert!(!text.contains("NaN"), "no number is missing");
    text
}

/// Resumes a scene from about `times` of its checkpoints, spread evenly, the last one included.
pub(crate) fn resumes_to_the_same_bits(
    name: &str,
    scene: &Scene,
    times: usize,
) -> (Summary, CheckpointRecorder) {
    let mut whole = CheckpointRecorder::default();
    let summary = run::solve(scene, &mut whole).expect("the scene can be solved");
    let count = whole.checkpoints.len();
    assert!(count > times, "{name}: {count} checkpoints");
    let step = count.div_ceil(times);
    let mut continued = 0;
    for checkpoint in whole.checkpoints.iter().rev().step_by(step).rev() {
        let cycle = checkpoint.cycle();
        let mut rest = Recorder::default();
        let resumed = run::resume(scene, checkpoint.clone(), &mut rest).expect("the run resumes");
        assert!(
            bits_after(cycle, &rest, &resumed) == bits_after(cycle, &whole.recorder, &summary),
            "{name}: other bits after cycle {cycle}"
        );
        assert!(
            rest.reports.iter().all(|report| report.cycle > cycle),
            "{name}: no cycle is reported twice"
        );
        continued += rest.reports.len();
    }
    // From the last checkpoint alone there may be nothing left to compute.
    assert!(continued > 0, "{name}: no resumed run computes a cycle");
    println!(
        "resume, {name}: {count} checkpoints, {} relocations, every {step}th gives the same bits",
        summary.resolution.relocations
    );
    (summary, whole)
}

#[test]
fn a_fretting_run_resumes_to_the_same_bits() {
    let mut scene = Scene {
        cycles: 3_000,
        ..mccoll()
    };
    scene.output.snapshots_at_cycles = vec![10, 1_000, 3_000];
    resumes_to_the_same_bits("mccoll", &scene, 6);
}

#[test]
fn a_run_that_has_relocated_resumes_to_the_same_bits() {
    let mut scene = Scene {
        cycles: 2_000,
        accuracy: Accuracy::from_tolerance(0.1),
        ..fuzz_button()
    };
    scene.output.snapshots_at_cycles = vec![1, 400, 2_000];
    scene.output.fields = true;
    let (summary, _) = resumes_to_the_same_bits("fuzz_button", &scene, 3);
    assert!(summary.resolution.relocations >= 1, "{summary:?}");
}

#[test]
fn a_sprung_run_resumes_to_the_same_bits() {
    let mut scene = Scene {
        cycles: 60,
        accuracy: Accuracy::from_tolerance(0.1),
        spring_n_per_mm2: 50.0,
        ..fuzz_button()
    };
    scene.output.snapshots_at_cycles = vec![60];
    resumes_to_the_same_bits("spring", &scene, 4);
}

/// The zones were widened in cycle 5 and later, which the checkpoint records.
fn a_run_in_zones_resumes(mut scene: Scene, cycles: u64, times: usize) {
    in_narrow_zones(&mut scene);
    scene.cycles = cycles;
    scene.output.snapshots_at_cycles = vec![4, cycles];
    scene.output.fields = true;
    let (summary, _) = resumes_to_the_same_bits("wipe", &scene, times);
    assert!(summary.resolution.relocations >= 2, "{summary:?}");
}

fn worn_tip() -> Scene {
    wipe(Sides {
        slider: RATE,
        receptacle: 0.0,
    })
}

#[test]
fn a_run_in_zones_resumes_to_the_same_bits() {
    let mut scene = worn_tip();
    shorten(&mut scene);
    a_run_in_zones_resumes(scene, 10, 2);
}

#[test]
fn a_continuous_run_resumes_to_the_same_bits() {
    let mut scene = Scene {
        cycles: 1_000,
        motion: Motion::Continuous { step_mm: 0.03 },
        ..mccoll()
    };
    scene.slider.wear = None;
    scene.output.snapshots_at_cycles = vec![500, 1_000];
    resumes_to_the_same_bits("continuous", &scene, 3);
}

fn a_mission_resumes_to_the_same_bits() {
    let scene = vibrated_and_wiped(12, Some(1e-7));
    let (summary, _) = resumes_to_the_same_bits("mission", &scene, 12);
    assert_eq!(summary.blocks.len(), 2);
}

#[test]
fn a_checkpoint_of_another_scene_is_refused_with_its_numbers() {
    let scene = Scene {
        cycles: 20,
        ..mccoll()
    };
    let mut whole = CheckpointRecorder::default();
    run::solve(&scene, &mut whole).expect("the scene can be solved");
    let last = whole.checkpoints.pop().expect("a checkpoint");
    let other = Scene {
        cycles: 20,
        ..fuzz_button()
    };
    let refused = run::resume(&other, last.clone(), &mut Recorder::default());
    assert!(
        matches!(
            refused,
            Err(SolveError::Checkpoint(CheckpointMismatch::Nodes {
                body: "receptacle",
                ..
            }))
        ),
        "{refused:?}"
    );
    let shorter = Scene { cycles: 2, ..scene };
    let refused = run::resume(&shorter, last, &mut Recorder::default());
    assert!(
        matches!(
            refused,
            Err(SolveError::Checkpoint(CheckpointMismatch::Beyond {
                cycles: 2,
                ..
            }))
        ),
        "{refused:?}"
    );
}

/// An observer that cannot store a snapshot and asks for a stop, as on a full disk.
#[derive(Default)]
struct FullDisk {
    recorder: Recorder,
    refused_cycle: u64,
    checkpoints: Vec<Checkpoint>,
}

impl Observer for FullDisk {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Snapshot(snapshot) if snapshot.cycle == self.refused_cycle => {
                return ControlFlow::Break(());
            }
            Event::Checkpoint(checkpoint) => self.checkpoints.push(checkpoint.checkpoint()),
            _ => {}
        }
        self.recorder.on(event)
    }
}

/// A stop at a snapshot ends the run before the checkpoint of that cycle, so that the resumed run takes the snapshot
/// again; at the last cycle too.
#[test]
fn a_snapshot_that_could_not_be_stored_is_taken_again_by_the_resumed_run() {
    let mut scene = Scene {
        cycles: 20,
        ..mccoll()
    };
    scene.output.snapshots_at_cycles = vec![5, 20];
    for refused_cycle in [5, 20] {
        let mut stopped = FullDisk {
            refused_cycle,
            ..FullDisk::default()
        };
        let summary = run::solve(&scene, &mut stopped).expect("the scene can be solved");
        assert_eq!(summary.outcome, Outcome::Stopped);
        let last = stopped.checkpoints.pop().expect("a checkpoint");
        assert!(last.cycle() < refused_cycle, "{}", last.cycle());
        let mut resumed = Recorder::default();
        run::resume(&scene, last, &mut resumed).expect("it can be resumed");
        let snapshots = stopped.recorder.snapshots.iter().chain(&resumed.snapshots);
        let cycles: Vec<u64> = snapshots.map(|snapshot| snapshot.cycle).collect();
        assert_eq!(cycles, [0, 5, 20]);
    }
}

/// An observer that stops the run at the n-th event.
struct StopAt {
    remaining: usize,
    recorder: Recorder,
    last: Option<Checkpoint>,
}

impl Observer for StopAt {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        assert!(self.remaining > 0, "no event follows a stop");
        self.remaining -= 1;
        if self.remaining == 0 {
            return ControlFlow::Break(());
        }
        if let Event::Checkpoint(checkpoint) = event {
            self.last = Some(checkpoint.checkpoint());
        }
        self.recorder.on(event)
    }
}

/// Whichever event of a run is refused, the run stops there, and what follows its last checkpoint has the bits of the
/// uninterrupted run.
#[test]
fn a_stop_at_any_event_loses_nothing() {
    let mut scene = Scene {
        cycles: 4,
        ..mccoll()
    };
    scene.output.snapshots_at_cycles = vec![2, 4];
    scene.accuracy.cycle_jump = Some(1);
    let mut whole = CheckpointRecorder::default();
    let summary = run::solve(&scene, &mut whole).expect("the scene can be solved");
    let recorded = &whole.recorder;
    let events = recorded.reports.len() + recorded.snapshots.len() + whole.checkpoints.len();
    assert!(events >= 10, "{events}");
    for remaining in 1..=events {
        let mut stopped = StopAt {
            remaining,
            recorder: Recorder::default(),
            last: None,
        };
        let end = run::solve(&scene, &mut stopped).expect("the scene can be solved");
        assert_eq!(end.outcome, Outcome::Stopped, "event {remaining}");
        let mut rest = Recorder::default();
        let (cycle, resumed) = match stopped.last {
            Some(last) => (last.cycle(), run::resume(&scene, last, &mut rest)),
            None => (0, run::solve(&scene, &mut rest)),
        };
        let resumed = resumed.expect("it can be resumed");
        assert!(
            bits_after(cycle, &rest, &resumed) == bits_after(cycle, &whole.recorder, &summary),
            "other bits after a stop at event {remaining}"
        );
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 18 s"]
    fn a_mission_resumes_to_the_same_bits() {
        super::a_mission_resumes_to_the_same_bits();
    }

    #[test]
    #[ignore = "long: takes 60 s"]
    fn a_run_in_zones_resumes_to_the_same_bits() {
        super::a_run_in_zones_resumes(super::worn_tip(), 20, 7);
    }
}
