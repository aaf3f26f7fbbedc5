//! A coefficient of friction that changes, over the cycles of a run.
//!
//! * A step by cycle is two runs, the second of which continues from the state of the first.
//! * The energy of gross slip is the integral of mu dD: of a coefficient by cycle the mean coefficient times that of a constant one.
//! * Runs with jumps agree with runs of single cycles, and resume to the same bits.

use std::ops::ControlFlow;

use solver::checkpoint::Checkpoint;
use solver::observer::{Event, Observer};
use solver::record::Summary;
use solver::run;
use solver::scene::{Barwell, Course, Motion, Scene, WearLaw};
use solver::sides::Side;

use crate::verification::recorder::{Recorder, solve};
use crate::verification::scenes::{groove, partial_slip, scar, sprung_contact};
use crate::verification::verify_changing_friction::{
    HIGH, LOW, by_cycle, by_dose, by_layer, constant, energy, shortened, with,
};
use crate::verification::verify_mission::{block, one_by_one, vibrated_and_wiped, with_mission};
use crate::verification::verify_plating::{RATES, plated};
use crate::verification::verify_resume::resumes_to_the_same_bits;

/// The checkpoint at a cycle.
struct CheckpointAt(u64, Option<Checkpoint>);

impl Observer for CheckpointAt {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if let Event::Checkpoint(checkpoint) = event
            && checkpoint.cycle() == self.0
        {
            self.1 = Some(checkpoint.checkpoint());
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Depth and area of the receptacle and energy of a run whose coefficient steps from one cycle to the next, over those of a run of one coefficient
/// that another one continues, less 1.
pub(crate) fn beside_two_runs(mut scene: Scene, step: u64, [low, high]: [f64; 2]) -> [f64; 3] {
    let at = f64::from(u16::try_from(step).expect("few cycles"));
    // Both runs resolve the cycle of the step.
    scene.output.snapshots_at_cycles = vec![step];
    let first = with(&scene, constant(low));
    let mut observer = CheckpointAt(step, None);
    run::solve(&first, &mut observer).expect("the scene can be solved");
    let from = observer.1.expect("a checkpoint");
    let second = with(&scene, constant(high));
    let expected = run::resume(&second, from, &mut Recorder::default()).expect("it resumes");
    let stepped = with(&scene, by_cycle(&[(0.0, low), (at, low), (at + 1.0, high)]));
    let mut recorder = Recorder::default();
    let found = run::solve(&stepped, &mut recorder).expect("the scene can be solved");
    assert!(recorder.reports.iter().any(|report| report.cycle == step));
    let of = |summary: &Summary| {
        let last = &summary.last;
        let side = &last.receptacle;
        [
            side.max_depth_mm,
            side.worn_area_mm2,
            last.dissipated_energy_mj_per_mm,
        ]
    };
    let (found, expected) = (of(&found), of(&expected));
    std::array::from_fn(|i| found[i] / expected[i] - 1.0)
}

/// Tolerance 2 %: depths, areas and energies within it, the single cycle between the points included.
#[test]
fn a_step_by_cycle_is_two_runs() {
    for (name, scene, step) in [
        ("scar", scar(), 700),
        ("groove", groove(), 12),
        ("partial slip", partial_slip(), 1_200),
    ] {
        let off = beside_two_runs(scene, step, [0.4, 0.8]);
        println!("step of friction by cycle, {name}: depth, area, energy off by {off:?}");
        assert!(off.iter().all(|off| off.abs() < 0.02), "{name}: {off:?}");
    }
}

/// In gross slip, where mu itself hardly changes the slip, mu rising linearly over the run; a tenth of the tolerance, since jumps take
/// the means of their cycles.
fn the_energy_of_gross_slip_is_the_mean_coefficient_times_the_dose() {
    for (name, scene) in [
        ("sprung contact", sprung_contact()),
        ("both worn", plated(0.1, &Side::BOTH, 400, 0.02)),
        ("long groove", plated(0.1, &[Side::Receptacle], 2_000, 0.02)),
    ] {
        let mut scene = scene;
        scene.spring_n_per_mm2 = 0.0;
        let cycles = scene.cycles;
        let end = f64::from(u32::try_from(cycles).expect("few cycles"));
        let even = energy(&with(&scene, constant(0.2)));
        let ramp = energy(&with(&scene, by_cycle(&[(0.0, 0.1), (end, 0.3)])));
        println!(
            "friction rising from 0.1 to 0.3, {name}: energy over that at 0.2 {:.5}",
            ramp / even
        );
        assert!((ramp / even - 1.0).abs() < 2e-3, "{name}: {ramp} {even}");
    }
}

/// The energy, to which the coefficient is a factor, against runs of single cycles.
#[test]
fn jumps_follow_a_coefficient_that_changes() {
    // Worn through after a third of the cycles, over a base that wears as fast.
    let thickness = 0.02e-3;
    let base = Some(WearLaw::Archard {
        k_over_h_per_mpa: RATES[0],
    });
    let mut scene = plated(0.02, &[Side::Receptacle], 600, 0.02);
    scene.receptacle.wear = base;
    let mut short = plated(0.004, &Side::BOTH, 600, 0.02);
    (short.slider.wear, short.receptacle.wear) = (base, base);
    short.slider.plating.clear();
    for scene in [&mut scene, &mut short] {
        scene.receptacle.plating.truncate(1);
        scene.receptacle.plating[0].thickness_mm = thickness;
    }
    let dose = thickness / RATES[0];
    // A base that wears 20 times as fast: the contact stands on the edges of the layer.
    let mut soft = scene.clone();
    soft.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: RATES[2],
    });
    for (name, scene, friction) in [
        (
            "groove by layer, soft base",
            &soft,
            by_layer(&[], &[LOW, HIGH]),
        ),
        ("groove by layer", &scene, by_layer(&[], &[LOW, HIGH])),
        (
            "groove by dose",
            &scene,
            by_dose(&[(0.0, LOW), (dose, HIGH)]),
        ),
        (
            "groove by cycle",
            &scene,
            by_cycle(&[(100.0, LOW), (200.0, HIGH)]),
        ),
        ("scar by layer", &short, by_layer(&[], &[LOW, HIGH])),
        ("scar by dose", &short, by_dose(&[(0.0, LOW), (dose, HIGH)])),
        (
            "scar by cycle",
            &short,
            by_cycle(&[(100.0, LOW), (200.0, HIGH)]),
        ),
    ] {
        let scene = with(scene, friction);
        let mut single = scene.clone();
        single.accuracy.cycle_jump = Some(1);
        let [found, exact] = [&scene, &single].map(|scene| solve(scene).expect("solved").0);
        let of = |summary: &Summary| summary.last.dissipated_energy_mj_per_mm;
        let off = of(&found) / of(&exact) - 1.0;
        let computed = found.resolution.computed_cycles;
        let unchanged = energy(&with(&scene, constant(LOW)));
        println!(
            "jumps, {name}: energy off by {off:.1e} in {computed} of 600 computed cycles, {:.3} times that without the change",
            of(&exact) / unchanged
        );
        assert!(of(&exact) > 1.1 * unchanged, "the coefficient changes");
        assert!(off.abs() < 0.02, "{name}: {off}");
        assert!(computed < 300, "{name}: {computed}");
    }
}

#[test]
fn runs_with_changing_friction_resume_to_the_same_bits() {
    let scene = shortened(plated(0.02, &Side::BOTH, 0, 0.1), 1_500);
    let short = shortened(plated(0.004, &Side::BOTH, 0, 0.1), 1_500);
    let layers = [LOW, 0.4, HIGH];
    for (name, scene, friction) in [
        ("by cycle", &scene, by_cycle(&[(50.0, LOW), (400.0, HIGH)])),
        ("by dose", &short, by_dose(&[(0.0, LOW), (2_000.0, HIGH)])),
        ("by layer", &scene, by_layer(&layers, &layers)),
    ] {
        resumes_to_the_same_bits(name, &with(scene, friction), 2);
    }
}

/// With companions; and what a spring, a crown and a continuous motion add.
#[test]
fn changing_friction_goes_with_errors_springs_crowns_and_continuous_motion() {
    let layers = [LOW, 0.4, HIGH];
    let base = shortened(plated(0.02, &[Side::Receptacle], 0, 0.1), 500);
    let mut errors = base.clone();
    errors.accuracy.estimate_errors = true;
    let mut spring = base.clone();
    spring.spring_n_per_mm2 = 20.0;
    let mut crown = base.clone();
    crown.receptacle.shape.crown_radius_mm = Some(5.0);
    let mut continuous = base.clone();
    continuous.motion = Motion::Continuous { step_mm: 0.01 };
    for (name, scene) in [
        ("errors", errors),
        ("spring", spring),
        ("crown", crown),
        ("continuous", continuous),
    ] {
        for friction in [
            by_layer(&[], &layers),
            by_dose(&[(0.0, LOW), (1_000.0, HIGH)]),
            by_cycle(&[(10.0, LOW), (300.0, HIGH)]),
        ] {
            let (summary, _) = solve(&with(&scene, friction)).expect("the scene can be solved");
            assert_eq!(summary.last.cycle, 500, "{name}");
            let checks = summary.checks;
            assert!(
                checks.worn_area < 1e-11 && checks.friction_cone < 1e-8,
                "{name}"
            );
            assert!(checks.friction_use < 1.0 + 1e-12, "{name}");
            assert_eq!(summary.errors.is_some(), name == "errors");
        }
    }
}

/// No friction at first, and none in the end.
#[test]
fn a_coefficient_may_begin_or_end_at_nothing() {
    for scene in [
        shortened(scar(), 300),
        shortened(groove(), 20),
        shortened(partial_slip(), 200),
    ] {
        let end = f64::from(u32::try_from(scene.cycles).expect("few cycles"));
        for friction in [
            by_cycle(&[(0.0, 0.0), (end, 0.6)]),
            by_cycle(&[(0.0, 0.6), (0.5 * end, 0.0)]),
        ] {
            let (summary, _) = solve(&with(&scene, friction)).expect("the scene can be solved");
            assert!(summary.checks.friction_cone < 1e-8);
            assert!(summary.last.dissipated_energy_mj_per_mm > 0.0);
        }
    }
}

/// Blocks of one motion are one run, whichever way the coefficient changes; blocks of different motions resume to the same bits.
fn changing_friction_goes_through_the_blocks_of_a_mission() {
    let mut scene = plated(0.02, &[Side::Receptacle], 500, 0.02);
    scene.receptacle.plating.truncate(1);
    scene.receptacle.plating[0].thickness_mm = 0.02e-3;
    let mission = with_mission(scene.clone(), &[block(0.02, 30), block(0.02, 70)], 5);
    for (name, friction) in [
        ("by layer", by_layer(&[], &[LOW, HIGH])),
        ("by dose", by_dose(&[(0.0, LOW), (200.0, HIGH)])),
        ("by cycle", by_cycle(&[(50.0, LOW), (450.0, HIGH)])),
    ] {
        let one = energy(&with(&scene, friction.clone()));
        let blocks = energy(&with(&mission, friction.clone()));
        println!(
            "mission, friction {name}: energy of blocks over one run {:.5}",
            blocks / one
        );
        assert!((blocks / one - 1.0).abs() < 0.02, "{name}: {blocks} {one}");
        let wiped = with(&vibrated_and_wiped(12, None), friction);
        resumes_to_the_same_bits(&format!("mission, friction {name}"), &wiped, 2);
    }
}

/// Each block of repetitions that are done together meets the coefficients of its own cycles: of the first block the earlier ones, of
/// the last the later ones. So the coefficient hardly changes within them.
#[test]
fn repetitions_done_together_meet_the_coefficients_of_their_cycles() {
    let mission = vibrated_and_wiped(16, None);
    let end = f64::from(u32::try_from(mission.cycles).expect("few cycles"));
    for (name, friction) in [
        ("rising", by_cycle(&[(0.3 * end, 0.1), (end, 0.9)])),
        ("slowly rising", by_cycle(&[(0.0, 0.4), (end, 0.8)])),
    ] {
        let scene = with(&mission, friction);
        let (together, single) = (energy(&scene), energy(&one_by_one(scene.clone())));
        println!(
            "mission, friction {name} by cycle: energy of repetitions together over single ones {:.5}",
            together / single
        );
        assert!(
            (together / single - 1.0).abs() < 5e-3,
            "{name}: {together} {single}"
        );
    }
}

/// A law whose depth is a curve over the dose, with a table by dose: the dose of a depth is that of the curve.
#[test]
fn doses_of_a_curved_law_determine_the_coefficient() {
    for course in [Course::Decelerating, Course::Accelerating] {
        let law = WearLaw::Barwell(Barwell {
            rate_per_mpa: 2e-7,
            dose_mpa_mm: 200.0,
            course,
        });
        for (name, amplitude, sides) in [
            ("scar", 0.004, &Side::BOTH[..]),
            ("groove", 0.02, &Side::BOTH[1..]),
        ] {
            let mut scene = plated(amplitude, sides, 300, 0.02);
            for side in sides {
                match side {
                    Side::Slider => (scene.slider.wear, scene.slider.plating) = (Some(law), vec![]),
                    Side::Receptacle => {
                        (scene.receptacle.wear, scene.receptacle.plating) = (Some(law), vec![]);
                    }
                }
            }
            let scene = with(&scene, by_dose(&[(0.0, LOW), (150.0, HIGH)]));
            let mut single = scene.clone();
            single.accuracy.cycle_jump = Some(1);
            let [found, exact] = [&scene, &single].map(|scene| solve(scene).expect("solved").0);
            let of = |summary: &Summary| summary.last.dissipated_energy_mj_per_mm;
            let off = of(&found) / of(&exact) - 1.0;
            let unchanged = energy(&with(&scene, constant(LOW)));
            println!(
                "friction by dose of {course:?} wear, {name}: energy off by {off:.1e} in {} computed cycles, {:.3} times that without the change",
                found.resolution.computed_cycles,
                of(&exact) / unchanged
            );
            assert!(of(&exact) > 1.1 * unchanged, "the coefficient changes");
            assert!(off.abs() < 0.02, "{course:?} {name}: {off}");
            assert!(found.checks.friction_cone < 1e-8);
        }
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 22 s"]
    fn the_energy_of_gross_slip_is_the_mean_coefficient_times_the_dose() {
        super::the_energy_of_gross_slip_is_the_mean_coefficient_times_the_dose();
    }

    #[test]
    #[ignore = "long: takes 17 s"]
    fn changing_friction_goes_through_the_blocks_of_a_mission() {
        super::changing_friction_goes_through_the_blocks_of_a_mission();
    }
}
