//! Friction that changes is the same for swapped bodies and for a mirrored motion.

use super::{HIGH, LOW, by_dose, by_layer, shortened, with};
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::scene::{Motion, WearLaw};
use solver::sides::Side;

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use crate::verification::verify_plating::plated;

/// Both bodies have the same outline upside down, as in `verify_symmetry`; a film on one of them, or different ones on both.
#[test]
fn swapped_bodies_have_the_same_friction() {
    let base = |k_over_h_per_mpa| Some(WearLaw::Archard { k_over_h_per_mpa });
    let mut here = shortened(mccoll(), 2_000);
    here.slider.shape.half_width_mm = 3.0;
    here.slider.shape.height_mm = 4.0;
    here.receptacle.shape.length_mm = 6.0;
    here.receptacle.shape.height_mm = 4.0;
    here.receptacle.shape.crown_radius_mm = Some(9.0);
    (here.slider.wear, here.receptacle.wear) = (base(2e-8), base(4e-8));
    here.slider.plating = vec![crate::verification::verify_plating::layer(0.1e-3, 2e-8)];
    here.receptacle.plating = vec![crate::verification::verify_plating::layer(0.15e-3, 4e-8)];
    let mut there = here.clone();
    there.slider.shape.radius_mm = 9.0;
    there.receptacle.shape.crown_radius_mm = Some(6.0);
    (there.slider.wear, there.receptacle.wear) = (here.receptacle.wear, here.slider.wear);
    there.slider.plating.clone_from(&here.receptacle.plating);
    there.receptacle.plating.clone_from(&here.slider.plating);
    let (one, other) = ([LOW, HIGH], [0.3, 0.8]);
    let doses = by_dose(&[(0.0, LOW), (5_000.0, HIGH)]);
    for (name, upright, turned) in [
        ("both", by_layer(&one, &other), by_layer(&other, &one)),
        ("one", by_layer(&one, &[]), by_layer(&[], &one)),
        ("doses", doses.clone(), doses),
    ] {
        let [a, b] = [with(&here, upright), with(&there, turned)]
            .map(|scene| solve(&scene).expect("the scene can be solved").0);
        let ratio = |a: f64, b: f64| (a / b - 1.0).abs();
        let off = [
            ratio(a.last.slider.max_depth_mm, b.last.receptacle.max_depth_mm),
            ratio(a.last.receptacle.max_depth_mm, b.last.slider.max_depth_mm),
            ratio(
                a.last.dissipated_energy_mj_per_mm,
                b.last.dissipated_energy_mj_per_mm,
            ),
        ];
        println!("swapped bodies, friction of {name}: depths and energy off by {off:?}");
        // The tolerance of both runs.
        assert!(off.iter().all(|off| *off < 0.1), "{name}: {off:?}");
    }
}

/// The motion to the other side first, as in `metamorphic/mirrored_motion`: what its increments leave, 1e-6 of the deepest wear.
#[test]
fn mirrored_motion_wears_the_mirror_image() {
    const CYCLES: u64 = 12;
    let mut scene = plated(0.004, &Side::BOTH, CYCLES, 0.1);
    scene.accuracy.cycle_jump = Some(2);
    scene.accuracy.increments_per_cycle = Some(40);
    // Worn through in the middle after some cycles.
    for plating in [&mut scene.slider.plating, &mut scene.receptacle.plating] {
        plating.truncate(1);
        plating[0].thickness_mm = 1e-6;
    }
    for friction in [
        by_layer(&[LOW, HIGH], &[0.3, 0.7]),
        by_dose(&[(0.0, LOW), (20.0, HIGH)]),
    ] {
        let scene = with(&scene, friction);
        let model = solver::model::build(&scene, &solver::effects::plan(&scene)).expect("a mesh");
        let condensed = condense(&model, 1).expect("it can be condensed");
        let run = |amplitude_mm: f64| {
            let mut scene = scene.clone();
            scene.motion = Motion::Reciprocating {
                amplitude_mm,
                period_s: 1.0,
            };
            let operators = &condensed.operators;
            let mut state = CycleState::start(operators, model.interface.slave);
            let mut integrator = Integrator::new(&scene, &model, operators);
            integrator.apply_load(&mut state).expect("it settles");
            integrator.initial_quarter(&mut state).expect("it slides");
            while state.cycle < CYCLES {
                let computed = integrator.compute_cycle(&mut state, CYCLES, true);
                computed.expect("the cycle is solved");
            }
            state
        };
        let (right, left) = (run(0.004), run(-0.004));
        for side in Side::BOTH {
            let depth = right.depth.of(side);
            let deepest = depth.iter().fold(0.0, |m: f64, d| m.max(*d));
            assert!(deepest > 1e-6, "the layer is worn through: {deepest}");
            let pairs = depth.iter().zip(left.depth.of(side).iter().rev());
            let off = pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
            assert!(off < 1e-6 * deepest, "{}: {off}", side.name());
        }
        assert!((right.energy / left.energy - 1.0).abs() < 1e-6);
    }
}
