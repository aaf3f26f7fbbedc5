//! Jumps along a line beside single cycles.

use super::*;

/// The energy, to which the coefficient is a factor, beside runs of single cycles.
#[test]
#[ignore = "long: takes a minute"]
fn jumps_along_a_line_follow_a_coefficient_that_changes() {
    let mut card = card(400);
    card.accuracy = Accuracy::from_tolerance(0.05);
    for (name, scene) in [
        ("line", as_line(&card, Some(CROWN), Top::Even)),
        ("extruded", as_extruded(&card, Ends::Free)),
    ] {
        let layers = [LOW, HIGH];
        for law in [
            by_layer(&layers, &layers),
            by_dose(&[(0.0, LOW), (2_000.0, HIGH)]),
            by_cycle(&[(100.0, LOW), (200.0, HIGH)]),
        ] {
            let scene = with(&scene, law);
            let mut single = scene.clone();
            single.accuracy.cycle_jump = Some(1);
            let [found, exact] = [&scene, &single].map(|scene| solved(scene).0);
            let off = energy(&found) / energy(&exact) - 1.0;
            let computed = found.resolution.computed_cycles;
            let unchanged = energy(&solved(&with(&scene, constant(LOW))).0);
            assert!(energy(&exact) > 1.1 * unchanged, "the coefficient changes");
            println!("jumps of {name}: energy {off:.1e} off in {computed} of 400 computed cycles");
            assert!(off.abs() < 0.05, "{name}: {off}");
            assert!(computed < 200, "{name}: {computed}");
        }
    }
}
