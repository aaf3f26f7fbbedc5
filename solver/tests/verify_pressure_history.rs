//! The reported peak pressure in gross sliding is that of a run without cycle jumps and with finer increments.
//!
//! The contact indents the floor by some ten nanometres, a thousandth of the groove's depth, so that waves of a nanometre in
//! the floor are waves of ten per cent in the pressure. Longer increments leave such waves, and jumps multiply them, while no
//! depth, area or residual shows any of it.

use crate::verification::recorder::solve;
use crate::verification::scenes::{fuzz_button, pin, sprung_contact};
use solver::interpolation;
use solver::record::CycleReport;
use solver::scene::{Motion, PRESSURE_TOLERANCES, Scene};

fn peaks(reports: &[CycleReport]) -> (Vec<f64>, Vec<f64>) {
    let cycles = reports.iter().map(|report| {
        let cycle = u32::try_from(report.cycle).expect("few cycles");
        f64::from(cycle)
    });
    let peaks = reports.iter().map(|report| report.peak_pressure_mpa);
    (cycles.collect(), peaks.collect())
}

/// Largest deviation of the peak pressure from the reference, and its mean over all reports.
fn deviation(scene: &Scene) -> (f64, f64) {
    let mut single = scene.clone();
    single.accuracy.cycle_jump = Some(1);
    single.accuracy.tuning.step.value *= 0.5;
    let [run, reference] = [scene, &single].map(|scene| {
        let (_, run) = solve(scene).expect("the scene can be solved");
        peaks(&run.reports)
    });
    let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
    for (cycle, peak) in run.0.iter().zip(&run.1) {
        let expected = interpolation::linear(&reference.0, &reference.1, *cycle);
        let off = peak / expected - 1.0;
        worst = worst.max(off.abs());
        sum += off;
        count += 1.0;
    }
    (worst, sum / count)
}

#[test]
fn peak_pressures_do_not_depend_on_jumps_and_increments() {
    let both = {
        let mut scene = sprung_contact();
        scene.slider.wear = scene.receptacle.wear;
        scene.cycles = 100;
        scene.motion = Motion::Reciprocating {
            amplitude_mm: 0.05,
            period_s: 1.0,
        };
        scene
    };
    let mut pin = pin();
    pin.cycles = 250;
    let mut slider = pin.clone();
    slider.slider.wear = slider.receptacle.wear.take();
    slider.cycles = 100;
    // A pass wears off the waves of its increments, which are longer than the contact of a single cycle.
    let mut fuzz = fuzz_button();
    fuzz.cycles = 100;
    // Jumps before a report are shortened.
    fuzz.output.snapshots_at_cycles = vec![40, 70, 100];
    let scenes = [
        ("pin", pin),
        ("worn slider on the pin", slider),
        ("sprung contact", sprung_contact()),
        ("both worn", both),
        ("fuzz button", fuzz),
    ];
    for (name, scene) in scenes {
        let (worst, mean) = deviation(&scene);
        println!(
            "peak pressure of {name} at {}: off by {worst:.3} at most, {mean:+.4} in the mean",
            scene.accuracy.tolerance
        );
        assert!(
            worst < PRESSURE_TOLERANCES * scene.accuracy.tolerance,
            "{name}"
        );
    }
}
