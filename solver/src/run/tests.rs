//! A run that requires an effect which its plan has skipped.

mod missions;

use super::*;
use crate::model::tests::fuzz_button;
use crate::observer::{Event, Restart};
use crate::scene::{BlockShape, Friction, Motion, SliderShape, WearLaw};
use crate::scene::{Effect, Switches};

/// Records the cycles of reports, the checkpoints and what needed wider zones.
#[derive(Default)]
struct Recorder {
    cycles: Vec<u64>,
    checkpoints: Vec<Checkpoint>,
    restarts: Vec<String>,
}

impl Observer for Recorder {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Cycle(report) => self.cycles.push(report.cycle),
            Event::Checkpoint(checkpoint) => self.checkpoints.push(checkpoint.checkpoint()),
            Event::Restart(Restart::WiderZones(error)) => self.restarts.push(error.to_string()),
            Event::Restart(restart) => panic!("{restart:?}"),
            Event::Snapshot(_) => {}
        }
        ControlFlow::Continue(())
    }
}

fn scene(cycles: u64) -> Scene {
    let mut scene = fuzz_button();
    scene.friction = Friction::Coulomb { coefficient: 0.3 };
    scene.cycles = cycles;
    scene.accuracy.tolerance = 0.02;
    scene.stop.clear();
    scene
}

/// The plan of few cycles skips friction, because the scar is shallow.
fn plan_of_few_cycles() -> EffectsPlan {
    let plan = effects::plan(&scene(5));
    assert!(!plan.simulates(Effect::Friction), "{plan:?}");
    plan
}

#[test]
fn a_run_goes_back_and_switches_on_what_it_calls_for() {
    let scene = scene(400);
    let mut recorder = Recorder::default();
    let done = by_plan(
        &scene,
        &plan_of_few_cycles(),
        None,
        &EarlierRuns::default(),
        &mut recorder,
    );
    let done = done.expect("it can be solved");
    let [crossing, stick] = done.crossings[..] else {
        panic!("{:?}", done.crossings);
    };
    assert_eq!(stick.effect, Effect::StickMemory);
    assert_eq!(crossing.effect, Effect::Friction);
    assert!(crossing.value > Some(0.004) && (1..400).contains(&crossing.cycle));
    // The cycle without friction is not reported.
    assert!(
        recorder.cycles.is_sorted_by(|a, b| a < b),
        "{:?}",
        recorder.cycles
    );
    assert!(recorder.cycles.contains(&crossing.cycle));

    let all_on = Scene {
        effects: Switches::default()
            .with(Effect::Friction, true)
            .with(Effect::StickMemory, true),
        ..scene
    };
    let all_on = solve(&all_on, &mut Recorder::default()).expect("it can be solved");
    let (a, b) = (done.last.receptacle, all_on.last.receptacle);
    assert!((a.max_depth_mm / b.max_depth_mm - 1.0).abs() < 0.01);
    assert!((a.worn_area_mm2 / b.worn_area_mm2 - 1.0).abs() < 0.01);
}

#[test]
fn a_resumed_run_continues_with_what_it_has_required() {
    let scene = scene(400);
    let mut whole = Recorder::default();
    let done = by_plan(
        &scene,
        &plan_of_few_cycles(),
        None,
        &EarlierRuns::default(),
        &mut whole,
    );
    let done = done.expect("it can be solved");
    let required = whole.checkpoints.iter();
    let from = required.filter(
        |checkpoint| matches!(checkpoint, Checkpoint::Section(run) if !run.crossings.is_empty()),
    );
    let from = from
        .clone()
        .nth(from.count() / 2)
        .expect("checkpoints after the crossing");
    let mut rest = Recorder::default();
    let resumed = by_plan(
        &scene,
        &plan_of_few_cycles(),
        Some(from.clone()),
        &EarlierRuns::default(),
        &mut rest,
    );
    let resumed = resumed.expect("it resumes");
    assert_eq!(format!("{resumed:?}"), format!("{done:?}"));
}

/// McColl's cylinder under 120 N/mm (Hertz: 0.0913 mm, 836.4 MPa) with elements of a 160th of its half-width and a stroke of 7.6 of
/// them: the load needs 875 nodes of the receptacle, whose zones have 684.
#[test]
fn a_first_load_that_is_too_wide_for_its_zones_gets_wider_ones() {
    let (half_width, steel) = (0.091_336, (200e3, 0.3));
    let mut scene = scene(1);
    scene.slider.shape = SliderShape {
        radius_mm: 6.0,
        half_width_mm: 4.5,
        height_mm: 6.0,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 12.0,
        height_mm: 6.0,
        crown_radius_mm: None,
    };
    for body in [&mut scene.slider.elastic, &mut scene.receptacle.elastic] {
        (body.youngs_modulus_mpa, body.poisson_ratio) = steel;
    }
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 3e-6,
    });
    scene.load_n_per_mm = 120.0;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 3.8 * half_width,
        period_s: 1.0,
    };
    scene.accuracy.contact_element_mm = Some(half_width / 160.0);
    scene.accuracy.increments_per_cycle = Some(16);
    scene.accuracy.cycle_jump = Some(1);
    let mut recorder = Recorder::default();
    let done = solve(&scene, &mut recorder).expect("it can be solved");
    let [cause] = &recorder.restarts[..] else {
        panic!("{:?}", recorder.restarts);
    };
    assert!(cause.contains("finely meshed zones of"), "{cause}");
    assert_eq!(recorder.cycles, [0, 1]);
    let peak = done.initial.peak_pressure_mpa;
    assert!((peak / 836.41 - 1.0).abs() < 0.01, "{peak} MPa");
}
