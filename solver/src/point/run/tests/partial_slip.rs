//! Balls of which a part sticks.

use super::*;

/// Mindlin's sphere at +-9.7e-4 mm, mu = 0.6: sticks within 0.7937 of the half-length and dissipates 4.4313e-3 mJ a cycle.
fn partly_slipping(k: Sides<f64>, cycles: u64) -> PointScene {
    PointScene {
        friction: 0.6,
        slip: SlipRegime::Partial,
        ..sphere_on_flat(k, 9.700_4e-4, cycles)
    }
}

#[test]
fn gross_slip_begins_at_mindlins_displacement() {
    // c/a = 0.5^(1/3) at 9.7004e-4 mm: 1 - 0.5^(2/3) of the whole.
    let onset = partly_slipping(sides(0.0, 0.0), 1).onset_of_gross_slip_mm();
    let exact = 9.700_4e-4 / (1.0 - 0.5_f64.powf(2.0 / 3.0));
    assert!((onset / exact - 1.0).abs() < 1e-4, "{onset} {exact}");
}

#[test]
fn the_first_cycle_in_partial_slip_dissipates_mindlins_loop() {
    let k = 1e-12;
    let mut scene = partly_slipping(sides(k, 0.0), 1);
    scene.accuracy.cells_per_half_length = 20.0;
    let summary = solved(&scene);
    let last = summary.last;
    assert!(
        (last.dissipated_energy_mj / 4.431_3e-3 - 1.0).abs() < 0.02,
        "{last:?}"
    );
    // Where it slips, the shear is mu p: the volume is k/mu times the energy.
    let volume = k / 0.6 * last.dissipated_energy_mj;
    assert!(
        (last.worn_volume_mm3.slider / volume - 1.0).abs() < 1e-9,
        "{last:?}"
    );
    let map = &summary.depth.slider;
    let width = map.z_mm.len();
    let places = map.depth_mm.iter().enumerate();
    let stuck = places.filter(|(index, _)| {
        let (x, z) = (map.x_mm[index / width], map.z_mm[index % width]);
        x.hypot(z) < 0.75 * HERTZ.0
    });
    let most = stuck.fold(0.0, |most: f64, (_, depth)| most.max(*depth));
    assert!(most < 1e-4 * last.max_depth_mm.slider, "{most} {last:?}");
}

/// Wear in the slip annulus unloads it, so that the edge of the stick zone carries ever more.
#[test]
fn a_stick_zone_survives_the_wear_of_its_annulus() {
    let summary = solved(&partly_slipping(sides(1e-8, 1e-8), 20_000));
    let (first, last) = (summary.initial, summary.last);
    assert!(last.peak_pressure_mpa > first.peak_pressure_mpa, "{last:?}");
    let map = &summary.depth.slider;
    let middle = map.depth_mm.len() / 2 + map.z_mm.len() / 2;
    assert!(
        map.depth_mm[middle] < 1e-3 * last.max_depth_mm.slider,
        "{last:?}"
    );
    for side in Side::BOTH {
        let ideal = last.ideal_volume_mm3.of(side).expect("it wears");
        assert!((last.worn_volume_mm3.of(side) / ideal - 1.0).abs() < 1e-10);
    }
}

#[test]
fn a_long_amplitude_in_partial_slip_is_refused() {
    let mut scene = partly_slipping(sides(1e-8, 0.0), 1);
    scene.amplitude_mm = 0.1;
    let found = run(&scene, |_| ControlFlow::Continue(()));
    assert!(
        matches!(found, Err(PointError::Amplitude { .. })),
        "{found:?}"
    );
}

/// Slipping places wear until they carry nothing; then nothing wears, however many cycles follow. A spring that holds the ball, and wear in a
/// jump of up to thousands of times the elastic compliance beside a stick zone without any.
#[test]
fn a_ball_in_partial_slip_wears_to_its_limiting_shape() {
    let after = |cycles| {
        let mut scene = sphere_on_flat(sides(0.0, 1e-5), 0.7e-3, cycles);
        scene.friction = 0.6;
        scene.slip = SlipRegime::Partial;
        scene.spring_n_per_mm = 1e5;
        // A coarse grid.
        scene.accuracy.cells_per_half_length = 6.0;
        solved(&scene)
    };
    let (early, late) = (after(20_000), after(3_000_000));
    let volume = |summary: &PointSummary| summary.last.worn_volume_mm3.receptacle;
    let grown = volume(&late) / volume(&early) - 1.0;
    // The tolerance of the contact pressure.
    assert!(grown.abs() < 1e-6, "{grown}");
    assert!(late.last.peak_pressure_mpa > HERTZ.1, "{:?}", late.last);
    // A hundredth of the cycles are followed by few: jumps grow with the cycles done.
    assert!(late.computed_cycles < early.computed_cycles + 12);
    assert!(late.computed_cycles < 80, "{}", late.computed_cycles);
}
