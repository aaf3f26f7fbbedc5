//! Whichever body's nodes carry the contact constraints, the contact and its wear are the same, with either drive, with a
//! spring and on a crowned receptacle. No reference but itself: the two discretisations share the bodies and nothing of the
//! coupling.

use crate::verification::scenes::mccoll;
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::scene::{Drive, Scene};
use solver::sides::Side;

fn scenes() -> [(&'static str, Scene); 4] {
    let handle = mccoll();
    let mut whole_body = mccoll();
    whole_body.drive = Drive::WholeBody;
    let mut sprung = whole_body.clone();
    // The load fades with the height within the depth of the test.
    sprung.spring_n_per_mm2 = 1e5;
    let mut crowned = mccoll();
    crowned.receptacle.shape.crown_radius_mm = Some(30.0);
    [
        ("handle", handle),
        ("whole body", whole_body),
        ("spring", sprung),
        ("crown", crowned),
    ]
}

/// The state after a run with the constraints on one side.
fn worn(scene: &Scene, slave: Side) -> CycleState {
    let mut model = solver::model::build(scene, &solver::effects::plan(scene))
        .expect("the scene can be meshed");
    model.interface.slave = slave;
    let operators = condense(&model, 1).expect("it can be condensed").operators;
    let mut state = CycleState::start(&operators, slave);
    let mut integrator = Integrator::new(scene, &model, &operators);
    integrator
        .apply_load(&mut state)
        .expect("it is in equilibrium");
    integrator.initial_quarter(&mut state).expect("it slides");
    while state.cycle < scene.cycles {
        integrator
            .compute_cycle(&mut state, scene.cycles, true)
            .expect("the cycle can be computed");
    }
    state
}

#[test]
fn constraints_on_either_side_give_the_same_wear() {
    for (name, mut scene) in scenes() {
        scene.cycles = 40;
        // Jumps of their own would differ, and pressures between jumps with them (by up to 16 % with the spring).
        scene.accuracy.cycle_jump = Some(1);
        let [slider, receptacle] = Side::BOTH.map(|slave| worn(&scene, slave));
        let apart = |a: f64, b: f64| (a / b - 1.0).abs();
        let deepest = |depth: &[f64]| depth.iter().fold(0.0, |m: f64, d| m.max(*d));
        let depths = Side::BOTH.map(|side| {
            apart(
                deepest(slider.depth.of(side)),
                deepest(receptacle.depth.of(side)),
            )
        });
        let load = apart(slider.neutral.load, receptacle.neutral.load);
        let peak = apart(
            slider.neutral.peak_pressure,
            receptacle.neutral.peak_pressure,
        );
        let width = apart(slider.neutral.half_width, receptacle.neutral.half_width);
        let energy = apart(slider.energy, receptacle.energy);
        println!(
            "constraints on the slider, {name}: depths {:.1e} and {:.1e}, peak {peak:.1e}, half-width {width:.1e}, load \
             {load:.1e}, energy {energy:.1e}",
            depths[0], depths[1]
        );
        // Half of the tolerance of 2 % for depths and pressures; the edge of the contact lies within an element of the scar.
        assert!(
            depths.iter().all(|d| *d < 0.01) && energy < 0.01 && load < 0.002,
            "{name}"
        );
        assert!(peak < 0.01 && width < 0.03, "{name}: {peak} {width}");
        for state in [&slider, &receptacle] {
            assert!(state.checks.force_balance < 1e-9 && state.checks.complementarity < 1e-9);
        }
    }
}
