//! Periodic motions that turn between their outermost turning points.

mod runs;

use std::f64::consts::PI;

use crate::verification::recorder::{depth_at, largest_distance, solve};
use crate::verification::scenes::{mccoll, partial_slip, sprung_contact};
use crate::verification::verify_mission::{RATE, last_profiles};
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::effects;
use solver::model;
use solver::record::FrictionLoop;
use solver::scene::{Effect, Switches};
use solver::scene::{Motion, Scene, Timing, TurningPoints, WearLaw};
use solver::sides::Side;

/// A motion between these places, mm.
fn periodic(x_mm: &[f64]) -> Motion {
    Motion::Periodic {
        turns: TurningPoints::new(x_mm).expect("turning points"),
        period_s: 1.0,
    }
}

fn reciprocating(amplitude_mm: f64) -> Motion {
    Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    }
}

/// A sprung contact that slides by +-0.2 mm, with an inner loop of +-0.1 mm on its way to -x.
fn inner_loop(cycles: u64) -> Scene {
    let mut scene = Scene {
        motion: periodic(&[0.2, -0.1, 0.1, -0.2]),
        timing: Timing::Triangle,
        cycles,
        ..sprung_contact()
    };
    scene.output.snapshots_at_cycles = vec![cycles];
    scene
}

fn both_wear(mut scene: Scene) -> Scene {
    scene.slider.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 0.1 * RATE,
    });
    scene
}

/// Each pass over a place of a flat floor wears it by k P: four in a cycle within the inner loop, two beside it.
#[test]
fn each_pass_of_an_inner_loop_wears_by_k_p() {
    let scene = inner_loop(8);
    let profile = last_profiles(&scene).receptacle;
    let pass = RATE * scene.load_n_per_mm;
    for (x, passes) in [
        (0.0, 32.0),
        (0.05, 32.0),
        (-0.05, 32.0),
        (-0.15, 16.0),
        (0.15, 16.0),
    ] {
        let depth = depth_at(&profile, x);
        println!("periodic: {:.4} of {passes} passes at {x} mm", depth / pass);
        // As a single moving contact at 2 % (`verify_moving_line_contact`).
        assert!((depth / (passes * pass) - 1.0).abs() < 0.02, "{x}: {depth}");
    }
}

/// The worn area of a linear law is k P times the path, 1.2 mm a cycle, where friction takes no slip: of unworn surfaces to round-off,
/// later up to the slopes of the scar, on which the slip is longer than its displacement.
#[test]
fn the_worn_area_is_that_of_the_whole_path() {
    for (cycles, limit) in [(1, 1e-9), (40, 1e-5)] {
        for (name, scene) in [
            ("pad", inner_loop(cycles)),
            ("both", both_wear(inner_loop(cycles))),
        ] {
            let mut scene = scene;
            scene.effects = Switches::default().with(Effect::Friction, false);
            let (done, _) = solve(&scene).expect("the scene can be solved");
            let path = 1.2 * f64::from(u32::try_from(cycles).expect("few cycles"));
            assert!((done.last.sliding_distance_mm / path - 1.0).abs() < 1e-12);
            for (side, rate) in [(Side::Receptacle, RATE), (Side::Slider, 0.1 * RATE)] {
                let area = done.last.side(side).worn_area_mm2;
                let off = area / (rate * scene.load_n_per_mm * path) - 1.0;
                println!(
                    "periodic, {name}, {cycles} cycles: worn area of the {} off by {off:.1e}",
                    side.name()
                );
                assert!(area <= 0.0 || off.abs() < limit, "{off}");
            }
            assert!(done.checks.worn_area < 1e-12, "{:?}", done.checks);
        }
    }
}

/// McColl's scar with an inner loop of half the stroke.
fn inner_loop_of_a_scar(cycles: u64) -> Scene {
    let mut scene = Scene {
        motion: periodic(&[0.025, -0.0125, 0.0125, -0.025]),
        timing: Timing::Triangle,
        cycles,
        ..mccoll()
    };
    scene.output.snapshots_at_cycles = vec![cycles];
    scene
}

/// Jumps that wear several unequal passes against single cycles on the same mesh, at 2 %: in a groove, and in a short stroke, where
/// the skew of a jump stays in the pressure.
#[test]
fn jumps_wear_like_single_cycles() {
    for (name, scene, most) in [
        ("groove", inner_loop(60), 30),
        ("scar", inner_loop_of_a_scar(200), 60),
    ] {
        let mut single = scene.clone();
        single.accuracy.cycle_jump = Some(1);
        let (jumps, single) = (solve(&scene), solve(&single));
        let ((jumps, in_jumps), (single, one_by_one)) = (
            jumps.expect("the scene can be solved"),
            single.expect("the scene can be solved"),
        );
        let apart = largest_distance(in_jumps.last_profile(), one_by_one.last_profile());
        let peak = jumps.last.peak_pressure_mpa / single.last.peak_pressure_mpa - 1.0;
        println!(
            "periodic, {name}: {} computed cycles for {}, profile {:.2} % off, peak pressure {:.2} %",
            jumps.resolution.computed_cycles,
            scene.cycles,
            100.0 * apart,
            100.0 * peak
        );
        assert!(apart < 0.02 && peak.abs() < 0.02, "{apart} {peak}");
        assert!(jumps.resolution.computed_cycles < most);
    }
}

/// A motion without inner turning points is a reciprocating one, where no groove is extrapolated: up to round-off of its places.
#[test]
fn two_turning_points_are_a_reciprocating_motion() {
    let run = |motion| {
        let scene = both_wear(Scene {
            motion,
            ..inner_loop(30)
        });
        solve(&scene).expect("the scene can be solved")
    };
    let (one, profile) = run(periodic(&[0.2, -0.2]));
    let (other, other_profile) = run(reciprocating(0.2));
    let apart = largest_distance(profile.last_profile(), other_profile.last_profile());
    let energy =
        one.last.dissipated_energy_mj_per_mm / other.last.dissipated_energy_mj_per_mm - 1.0;
    let peak = one.last.peak_pressure_mpa / other.last.peak_pressure_mpa - 1.0;
    println!(
        "periodic, two turning points: profile {apart:.1e} off, energy {energy:.1e}, peak pressure {peak:.1e}"
    );
    assert_eq!(
        one.resolution.computed_cycles,
        other.resolution.computed_cycles
    );
    // An increment converges to 1e-11 of the indentation.
    assert!(apart.max(energy.abs()).max(peak.abs()) < 1e-8);
}

/// Points of a loop at these displacements, one after the other.
fn forces_at(friction_loop: &FrictionLoop, places: &[f64]) -> Vec<f64> {
    let points = friction_loop.displacement_mm.iter();
    let mut points = points.zip(&friction_loop.tangential_force_n_per_mm);
    let mut next = |place: &f64| {
        let point = points.find(|(x, _)| (**x - place).abs() < 1e-12);
        *point.expect("a point of the loop").1
    };
    places.iter().map(&mut next).collect()
}

/// Energy of a cycle of a cylinder between the tangential forces +-Q, mJ/mm (Cattaneo 1938, Mindlin 1949): with c^2/a^2 = 1 - Q/(mu P)
/// the surfaces slip by s(x) = mu/R integral from c to x of sqrt(t^2 - c^2) dt on a first loading, and twice as far in each stroke, so
/// that the cycle dissipates 8 integral from c to a of mu p s dx.
fn cattaneo_mindlin(scene: &Scene, friction: f64, force: f64) -> f64 {
    let radius = scene.slider.shape.radius_mm;
    let elastic = scene.slider.elastic;
    let modulus = elastic.youngs_modulus_mpa / (2.0 * (1.0 - elastic.poisson_ratio.powi(2)));
    let load = scene.load_n_per_mm;
    let a = (4.0 * load * radius / (PI * modulus)).sqrt();
    let c = a * (1.0 - force / (friction * load)).sqrt();
    let slip = |x: f64| {
        let root = (x * x - c * c).max(0.0).sqrt();
        0.5 * friction / radius * (x * root - c * c * (x / c).acosh())
    };
    let peak = 2.0 * load / (PI * a);
    let parts = 20_000;
    let width = (a - c) / f64::from(parts);
    let sum: f64 = (0..parts)
        .map(|i| c + (f64::from(i) + 0.5) * width)
        .map(|x| peak * (1.0 - (x / a).powi(2)).max(0.0).sqrt() * slip(x))
        .sum();
    8.0 * friction * sum * width
}

/// In partial slip the inner loop closes where it began, and dissipates as a cycle of its own.
#[test]
fn an_inner_loop_of_partial_slip_closes_and_dissipates_like_a_cycle_of_its_own() {
    const A: f64 = 0.003;
    const FRICTION: f64 = 0.8;
    let run = |motion: Motion, increments: u32| {
        let mut scene = Scene {
            motion,
            timing: Timing::Triangle,
            cycles: 3,
            ..partial_slip()
        };
        (scene.slider.wear, scene.receptacle.wear) = (None, None);
        scene.accuracy.increments_per_cycle = Some(increments);
        scene.accuracy.cycle_jump = Some(1);
        scene.output.snapshots_at_cycles = vec![2, 3];
        let (_, recorder) = solve(&scene).expect("the scene can be solved");
        let energy = |cycle| recorder.at(cycle).dissipated_energy_mj_per_mm;
        let last = recorder.snapshots.last().expect("a snapshot");
        (energy(3) - energy(2), last.friction_loop.clone(), scene)
    };
    let (both, friction_loop, scene) = run(periodic(&[A, -0.5 * A, 0.5 * A, -A]), 240);
    let (outer, ..) = run(reciprocating(A), 160);
    let (inner, ..) = run(reciprocating(0.5 * A), 80);
    let places = [A, -0.5 * A, 0.5 * A, -0.5 * A, -A];
    let forces = forces_at(&friction_loop, &places);
    let range = forces[2] - forces[1];
    let closing = (forces[3] - forces[1]) / range;
    let closed = cattaneo_mindlin(&scene, FRICTION, 0.5 * (forces[0] - forces[4]))
        + cattaneo_mindlin(&scene, FRICTION, 0.5 * range);
    println!(
        "periodic, partial slip: forces {forces:.3?} N/mm, the inner loop closes to {closing:.1e} of its range; {both:.4e} mJ/mm, \
         closed form {closed:.4e}, reciprocating {outer:.4e} + {inner:.4e}"
    );
    // Both depend on what an increment leaves: a hundredth of the range is a step of 0.03 um.
    assert!(closing.abs() < 0.01, "{closing}");
    assert!(
        (both / (outer + inner) - 1.0).abs() < 0.01,
        "{both} {outer} {inner}"
    );
    // The strip below the closed form's half-space, and the elements: the scene's tolerance.
    assert!((both / closed - 1.0).abs() < 0.02, "{both} {closed}");
}

/// The motion to the other side first gives the mirror image (see `metamorphic/mirrored_motion`).
#[test]
fn a_mirrored_motion_gives_the_mirror_image() {
    let mut scene = inner_loop(8);
    scene.motion = periodic(&[0.2, -0.1, 0.15, -0.2, 0.05, -0.05]);
    scene.accuracy.cycle_jump = Some(2);
    scene.accuracy.increments_per_cycle = Some(240);
    let model = model::build(&scene, &effects::plan(&scene)).expect("a model");
    let condensed = condense(&model, 1).expect("operators");
    let operators = &condensed.operators;
    let integrate = |scene: &Scene| {
        let mut state = CycleState::start(operators, model.interface.slave);
        let mut integrator = Integrator::new(scene, &model, operators);
        integrator.apply_load(&mut state).expect("it can be loaded");
        integrator
            .initial_quarter(&mut state)
            .expect("it can be moved");
        while state.cycle < 8 {
            integrator
                .compute_cycle(&mut state, 8, true)
                .expect("the cycle can be computed");
        }
        state
    };
    let mut mirrored = scene.clone();
    if let Motion::Periodic { turns, .. } = &mut mirrored.motion {
        *turns = turns.mirrored();
    }
    let (right, left) = (integrate(&scene), integrate(&mirrored));
    let (one, other) = (&right.depth.receptacle, &left.depth.receptacle);
    let largest = one.iter().fold(0.0, |m: f64, d| m.max(*d));
    let pairs = one.iter().zip(other.iter().rev());
    let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
    println!("periodic, mirrored: profile {apart:.1e} off");
    assert!(apart < 1e-6, "{apart}");
}
