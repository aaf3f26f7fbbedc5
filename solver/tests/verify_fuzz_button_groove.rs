//! The groove of a slider in gross reciprocating sliding: the thesis' fuzz button.
//!
//! ```text
//!            <-- 2 A = 67.7 um -->
//!             .-.                        P' = 0.508 N/mm, k/H = 2.5761e-5 per MPa
//!            (   )  R = 25.4 um          k P' = 13.09 nm a pass, two passes a cycle
//!   |~~~~~~~~~`-'~~~~~~~~~|
//!   |                     | 84.67 um
//! ```
//! A contact that passes a point completely wears it by the integral of k p ds over the pass, which is k P' if the
//! contact moves with the slider: on a flat floor, whatever the pressure's shape (the thesis' check with 10 MPa in
//! place of the pressure is not this). As the floor becomes hollow with radius rho the contact travels faster than
//! the slider, dX/ds = 1/(1 - R/rho), and wears less: the flatness is lost by diffusion from the ends with
//! D = 2 k P' R a cycle, which reaches the middle after some A^2/(4 D) = 430 cycles.

use std::f64::consts::PI;

use crate::verification::recorder::solve;
use crate::verification::scenes::{COPPER_WEAR, fuzz_button, groove};
use solver::scene::{Friction, Motion, Scene};

const LOAD: f64 = 0.508;

#[test]
fn a_flat_floor_sinks_by_two_passes_of_k_p_a_cycle() {
    let scene = Scene {
        cycles: 150,
        ..fuzz_button()
    };
    let (summary, recorder) = solve(&scene).expect("the scene can be solved");
    let ideal = 2.0 * COPPER_WEAR * LOAD;
    assert!((ideal - 26.17e-6).abs() < 0.01e-6);
    let middle = |cycle: u64| recorder.at(cycle).station_depth_mm[3];
    println!(
        "middle: {:.3} nm after 1 cycle, {:.3} nm a cycle to 150",
        1e6 * middle(1),
        1e6 * middle(150) / 150.0
    );
    assert!((middle(1) / ideal - 1.0).abs() < 0.01);
    assert!((middle(150) / 150.0 / ideal - 1.0).abs() < 0.01);
    assert!(summary.checks.worn_area < 1e-9);
}

/// Scene and motion are symmetric, so the groove is symmetric except for the last pass.
#[test]
fn the_groove_is_symmetric_within_the_tolerance() {
    let scene = Scene {
        cycles: 240,
        ..fuzz_button()
    };
    let (_, recorder) = solve(&scene).expect("the scene can be solved");
    let depth = &recorder.at(240).station_depth_mm;
    let deepest = recorder.at(240).receptacle.max_depth_mm;
    for i in 0..3 {
        let difference = (depth[i] - depth[6 - i]).abs() / deepest;
        println!("groove, stations {i} and {}: {difference:.1e}", 6 - i);
        assert!(difference < 0.02, "{depth:?}");
    }
}

/// Once the whole block wears at one rate, that rate is the worn area over the block's length; the contact is on a
/// slope by then, so the area exceeds k P' s by the factor (1 + t^2)/(1 - mu^2 t^2) averaged over the floor's slopes t.
#[test]
fn block_shorter_than_the_groove_finally_wears_at_one_rate() {
    let (summary, recorder) = solve(&fuzz_button()).expect("the scene can be solved");
    let (early, late) = (recorder.at(1_600), recorder.at(2_000));
    let area = (late.receptacle.worn_area_mm2 - early.receptacle.worn_area_mm2) / 400.0;
    let middle = (late.station_depth_mm[3] - early.station_depth_mm[3]) / 400.0;
    println!(
        "at the end: {:.2} nm a cycle in the middle, {:.2} nm on average",
        1e6 * middle,
        1e6 * area / 0.08467
    );
    assert!((middle / (area / 0.08467) - 1.0).abs() < 0.01);
    let ratio = late.receptacle.worn_area_mm2 / late.receptacle.ideal_area_mm2.expect("it wears");
    assert!(ratio > 1.0 && ratio < 1.1, "{ratio}");
    assert!(summary.checks.worn_area < 1e-9 && summary.checks.force_balance < 1e-9);
}

/// The pressure in the middle of the groove after a jump is that of a run of single cycles.
#[test]
fn pressure_in_gross_reciprocating_sliding_is_that_of_single_cycles() {
    let peak = |cycle_jump: Option<u64>| {
        let mut scene = Scene {
            cycles: 240,
            ..fuzz_button()
        };
        scene.accuracy.cycle_jump = cycle_jump;
        let (summary, recorder) = solve(&scene).expect("the scene can be solved");
        let jumps = recorder.reports.iter().map(|report| report.jump);
        (summary.last.peak_pressure_mpa, jumps.max())
    };
    let ((chosen, jump), (single, _)) = (peak(None), peak(Some(1)));
    let jump = jump.expect("cycles are reported");
    println!(
        "peak pressure at cycle 240: {chosen:.1} MPa with jumps of up to {jump}, {single:.1} MPa without"
    );
    assert!(jump > 10);
    // Reached: 0.4 %. On the leading-edge step of a jump it would be 39 % low.
    assert!((chosen / single - 1.0).abs() < 0.02);
}

/// Normals exclude the leading-edge step of the pass. With it the normal force would be larger by mu k times the mean pressure
/// (weighted by itself, 8/(3 pi) of the peak for Hertz): 1.6 % under 600 MPa. Reached: 0.9 times that in the middle of the
/// stroke; 1.8 times at the turning points, where the replay's smoothing passes wear the wall twice more under the normals of
/// the beginning of the cycle. Allowed: 0.8 to 2 times.
#[test]
fn the_balance_with_present_normals_shows_the_step_of_a_pass() {
    let scene = groove();
    let Friction::Coulomb { coefficient } = scene.friction else {
        unreachable!("it has friction");
    };
    let (summary, _) = solve(&scene).expect("the scene can be solved");
    let balance = summary.checks.force_balance_present_normals;
    let mean = 8.0 / (3.0 * PI) * summary.last.peak_pressure_mpa;
    let expected = coefficient * COPPER_WEAR * mean;
    println!("balance with present normals {balance:.4}, mu k p {expected:.4}");
    assert!(balance > 0.8 * expected && balance < 2.0 * expected);
}

/// The same for a stroke of some four half-widths, where the single-cycle replay of a position starts before the
/// previous position. The jump is fixed from the first cycle on and has shaped the floor that the replay slides over.
#[test]
fn pressure_of_a_stroke_of_four_half_widths_is_that_of_single_cycles() {
    let peak = |cycle_jump: u64| {
        let mut scene = Scene {
            cycles: 100,
            motion: Motion::Reciprocating {
                amplitude_mm: 0.008,
                period_s: 16.0,
            },
            ..fuzz_button()
        };
        scene.accuracy.tolerance = 0.05;
        scene.accuracy.cycle_jump = Some(cycle_jump);
        let (summary, _) = solve(&scene).expect("the scene can be solved");
        summary.last.peak_pressure_mpa
    };
    let (ten, single) = (peak(10), peak(1));
    println!("peak pressure at cycle 100: {ten:.1} MPa with jumps of 10, {single:.1} MPa without");
    // Reached: 0.6 %. On the leading-edge step of a jump it would be 54 % low.
    assert!((ten / single - 1.0).abs() < 0.03);
}
