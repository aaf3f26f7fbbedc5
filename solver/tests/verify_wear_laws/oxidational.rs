//! Oxidational laws: the worn area is C P' t with the time t of sliding, or that of Archard's law at a constant speed.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::{
    ARCHARD, LONG, SHORT, TOLERANCE, check_refinement, check_swap, difference, reports, scene,
};
use crate::verification::recorder::{largest_distance, solve};
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::law::temperature::Temperature;
use solver::scene::{
    Accuracy, Mechanism, MildOxidation, Motion, Quinn, Scene, Series, SevereOxidation, SpeedLaw,
    SurfaceState, Term, Timing, WearLaw,
};
use solver::scene::{Effect, Switches};
use solver::sides::{Side, Sides};

/// Mean speed of a stroke of 0.1 mm in a second, mm/s.
const SPEED: f64 = 0.4;

/// Wears by 2e-7 1/MPa at that speed; the constants are none of a material.
fn quinn() -> WearLaw {
    let law = Quinn {
        asperity_um: 20.0,
        arrhenius_kg2_m4s: 1.5e6,
        activation_j_mol: 208e3,
        film_um: 1.0,
        oxide_density_kg_m3: 5_240.0,
        oxygen_fraction: 0.3006,
        surface: SurfaceState {
            hardness_mpa: 1_700.0,
            temperature: Temperature::OfContact(673.15),
        },
    };
    let factor = 2e-7 * law.surface.hardness_mpa / law.coefficient_at(SPEED);
    WearLaw::OfSpeed(SpeedLaw::Quinn(Quinn {
        arrhenius_kg2_m4s: factor * law.arrhenius_kg2_m4s,
        ..law
    }))
}

/// The same rate at that speed.
fn mild_oxidation() -> WearLaw {
    let law = MildOxidation {
        constant: 3.4e-4,
        arrhenius_m2_s: 1e6,
        activation_j_mol: 138e3,
        film_um: 10.0,
        surface: SurfaceState {
            hardness_mpa: 1_700.0,
            temperature: Temperature::OfContact(700.0),
        },
    };
    let factor = 2e-7 * law.surface.hardness_mpa / law.coefficient_at(SPEED);
    WearLaw::OfSpeed(SpeedLaw::MildOxidation(MildOxidation {
        arrhenius_m2_s: factor * law.arrhenius_m2_s,
        ..law
    }))
}

/// Wears from half that speed on.
fn severe_oxidation() -> WearLaw {
    let law = SevereOxidation {
        molten_fraction: 4e-3,
        latent_heat_j_m3: 2e9,
        heat_share: 0.5,
        friction: 0.3,
        conductivity_w_mk: 3.2,
        melting_k: 1_760.15,
        diffusion_um: 10.0,
        surface: SurfaceState {
            hardness_mpa: 1_700.0,
            temperature: Temperature::OfContact(293.15),
        },
    };
    let factor = 0.5 * SPEED / law.slowest_mm_s();
    WearLaw::OfSpeed(SpeedLaw::SevereOxidation(SevereOxidation {
        conductivity_w_mk: factor * law.conductivity_w_mk,
        ..law
    }))
}

/// A scene whose stroke has the mean speed above.
fn at_speed(stroke: (f64, u64), law: WearLaw, sides: &[Side], timing: Timing) -> Scene {
    let mut scene = scene(stroke, law, sides);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: stroke.0,
        period_s: 4.0 * stroke.0 / SPEED,
    };
    scene.timing = timing;
    scene
}

/// A series that turns inside, at the same mean speed: the worn area is in proportion to the time, and a place where the series is
/// slow wears more than at a constant speed.
#[test]
fn laws_of_time_wear_by_the_time_of_a_series() {
    let term = |order, sine_mm| Term {
        order,
        sine_mm,
        cosine_mm: 0.0,
    };
    let series = Series::new(vec![term(1, 0.06), term(3, 0.06)]);
    let turns = series.turning_points().expect("few turning points");
    let mut scene = at_speed((0.1, 40), quinn(), &Side::BOTH[1..], Timing::Triangle);
    scene.motion = Motion::Periodic {
        turns,
        period_s: turns.path_mm() / SPEED,
    };
    scene.effects = Switches::default().with(Effect::Friction, false);
    let run = |timing| {
        let scene = Scene {
            timing,
            ..scene.clone()
        };
        let (summary, recorder) = solve(&scene).expect("the scene can be solved");
        let report = summary.last.receptacle;
        let expected = 2e-7 * scene.load_n_per_mm * summary.last.sliding_distance_mm;
        (
            report.worn_area_mm2 / expected - 1.0,
            recorder.last_profile().clone(),
        )
    };
    let (constant, even) = run(Timing::Triangle);
    let (varying, uneven) = run(Timing::Series(Arc::new(series)));
    let apart = largest_distance(&uneven, &even);
    println!(
        "Quinn, series: worn area off by {varying:+.1e}, at a constant speed by {constant:+.1e}; profiles {:.0} % apart",
        100.0 * apart
    );
    assert!(constant.abs().max(varying.abs()) < 0.1 * TOLERANCE);
    assert!(apart > 0.1, "{apart}");
}

#[test]
fn laws_of_time_wear_by_the_time_of_sliding() {
    let (short, long) = ((0.004, 300), (0.1, 60));
    for (name, law, cycles, timing) in [
        ("Quinn", quinn(), short, Timing::Sine),
        ("Quinn", quinn(), long, Timing::Triangle),
        ("mild oxidation", mild_oxidation(), short, Timing::Triangle),
        ("mild oxidation", mild_oxidation(), long, Timing::Sine),
    ] {
        let mut scene = at_speed(cycles, law, &Side::BOTH, timing.clone());
        // The slip that the bodies' shear takes at the turning points would take most of the time there.
        scene.effects = Switches::default().with(Effect::Friction, false);
        let summary = solve(&scene).expect("the scene can be solved").0;
        let expected = 2e-7 * scene.load_n_per_mm * summary.last.sliding_distance_mm;
        for side in Side::BOTH {
            let report = *reports(&summary).of(side);
            let off = report.worn_area_mm2 / expected - 1.0;
            println!(
                "{name}, {} mm, {timing:?}: worn area of the {} off by {off:+.1e}",
                cycles.0,
                side.name()
            );
            let ideal = report.ideal_area_mm2.expect("the law has one");
            // On the slopes of the scar the slip is longer than its displacement.
            assert!(off.abs() < 0.1 * TOLERANCE);
            assert!((ideal / expected - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn oxidational_laws_at_a_constant_speed_are_archards() {
    for (name, law, rate) in [
        ("Quinn", quinn(), 2e-7),
        // 4e-3 / 2e9 (0.15 - 0.075) in 1/Pa.
        ("severe oxidation", severe_oxidation(), 1.5e-7),
    ] {
        for cycles in [(0.004, 300), (0.1, 60)] {
            let oxidational = at_speed(cycles, law, &Side::BOTH[1..], Timing::Triangle);
            let archard = WearLaw::Archard {
                k_over_h_per_mpa: rate,
            };
            let archard = at_speed(cycles, archard, &Side::BOTH[1..], Timing::Triangle);
            let run = |scene: &Scene| solve(scene).expect("the scene can be solved").0;
            let (found, expected) = (run(&oxidational), run(&archard));
            let off = difference(&found, &expected);
            println!("{name} at a constant speed: {off:.1e} from Archard");
            assert!(off < 1e-9, "{off}");
        }
    }
}

#[test]
fn slow_sliding_does_not_melt_an_oxide() {
    let mut scene = at_speed((0.1, 20), severe_oxidation(), &Side::BOTH, Timing::Triangle);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.1,
        period_s: 2.5,
    };
    let summary = solve(&scene).expect("the scene can be solved").0;
    assert!(
        summary
            .last
            .receptacle
            .max_depth_mm
            .max(summary.last.slider.max_depth_mm)
            <= 0.0
    );
}

/// A law in a stroke of an amplitude and so many cycles.
fn does_not_depend_on_increments_and_jumps(name: &str, law: WearLaw, stroke: (f64, u64)) {
    check_refinement(
        &format!("{name}, {} mm", stroke.0),
        &at_speed(stroke, law, &Side::BOTH[1..], Timing::Sine),
    );
}

#[test]
fn oxidational_laws_do_not_depend_on_increments_and_jumps() {
    does_not_depend_on_increments_and_jumps("Quinn", quinn(), SHORT);
    does_not_depend_on_increments_and_jumps("severe oxidation", severe_oxidation(), LONG);
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes 6 s"]
    fn oxidational_laws_do_not_depend_on_increments_and_jumps() {
        does_not_depend_on_increments_and_jumps("Quinn", quinn(), LONG);
        does_not_depend_on_increments_and_jumps("severe oxidation", severe_oxidation(), SHORT);
    }
}

/// A pass by time is slowest at the turning points: jumps extrapolate it as single cycles wear it.
#[test]
fn jumps_in_a_groove_by_time_are_within_the_tolerance_of_single_cycles() {
    let worn = |cycle_jump: Option<u64>| {
        let mut scene = at_speed((0.1, 400), quinn(), &Side::BOTH[1..], Timing::Sine);
        scene.accuracy.cycle_jump = cycle_jump;
        let (summary, run) = solve(&scene).expect("the scene can be solved");
        (summary, run.last_profile().clone())
    };
    let ((jumps, profile), (single, exact)) = (worn(None), worn(Some(1)));
    let apart = largest_distance(&profile, &exact);
    println!(
        "groove by time: depth and area off by {:.1e}, profile by {apart:.1e}, {} computed cycles",
        difference(&jumps, &single),
        jumps.resolution.computed_cycles
    );
    assert!(difference(&jumps, &single) < 0.1 * TOLERANCE && apart < TOLERANCE);
}

#[test]
fn bodies_can_be_swapped_beside_an_oxidational_law() {
    let laws = Sides {
        slider: ARCHARD,
        receptacle: quinn(),
    };
    check_swap("Quinn, beside Archard", &laws);
}

#[test]
fn runs_by_an_oxidational_law_resume_to_the_same_bits() {
    for stroke in [(0.004, 1_000), (0.1, 100)] {
        let mut scene = at_speed(stroke, quinn(), &Side::BOTH[1..], Timing::Sine);
        scene.output.snapshots_at_cycles = vec![stroke.1 / 2, stroke.1];
        resumes_to_the_same_bits(&format!("Quinn, {} mm", stroke.0), &scene, 2);
    }
}

/// A mechanism that changes within a stroke: hardly any oxide grows above the transition, so that the part of a sine that is slower than it
/// wears by Archard's law, 1 - sqrt(1 - (V1/V)^2) of the distance.
#[test]
fn a_mechanism_that_changes_within_a_stroke_wears_by_its_parts() {
    const RATE: f64 = 2e-7;
    let (
        WearLaw::OfSpeed(SpeedLaw::MildOxidation(mild)),
        WearLaw::OfSpeed(SpeedLaw::SevereOxidation(severe)),
    ) = (mild_oxidation(), severe_oxidation())
    else {
        panic!("laws of speed");
    };
    let fastest = FRAC_PI_2 * SPEED;
    for share in [0.4, 0.8] {
        let law = Mechanism {
            k: RATE * mild.surface.hardness_mpa,
            transition_mm_s: share * fastest,
            mild: MildOxidation {
                arrhenius_m2_s: 1e-9 * mild.arrhenius_m2_s,
                ..mild
            },
            severe: SevereOxidation {
                conductivity_w_mk: 1e3 * severe.conductivity_w_mk,
                ..severe
            },
        };
        for tolerance in [0.02, 0.1] {
            let law = WearLaw::OfSpeed(SpeedLaw::Mechanism(law));
            let mut scene = at_speed((0.1, 100), law, &[Side::Receptacle], Timing::Sine);
            scene.accuracy = Accuracy::from_tolerance(tolerance);
            scene.effects = Switches::default().with(Effect::Friction, false);
            let summary = solve(&scene).expect("the scene can be solved").0;
            let all = RATE * scene.load_n_per_mm * summary.last.sliding_distance_mm;
            let expected = 1.0 - (1.0 - share * share).sqrt();
            let off = summary.last.receptacle.worn_area_mm2 / (expected * all) - 1.0;
            println!(
                "mechanism, transition at {share} of the fastest, {tolerance}: worn area off by {off:+.1e}"
            );
            assert!(off.abs() < 0.5 * tolerance, "{off}");
        }
    }
}

/// An oxide that melts only in the fastest part of a sine, whose mean speed is too slow for it.
#[test]
fn an_oxide_melts_in_the_fastest_part_of_a_stroke() {
    let WearLaw::OfSpeed(SpeedLaw::SevereOxidation(severe)) = severe_oxidation() else {
        panic!("a law of speed");
    };
    let slowest = 1.2 * SPEED;
    let law = SevereOxidation {
        conductivity_w_mk: severe.conductivity_w_mk * slowest / severe.slowest_mm_s(),
        ..severe
    };
    let law = WearLaw::OfSpeed(SpeedLaw::SevereOxidation(law));
    let mut scene = at_speed((0.1, 100), law, &[Side::Receptacle], Timing::Sine);
    scene.effects = Switches::default().with(Effect::Friction, false);
    let summary = solve(&scene).expect("the scene can be solved").0;
    // With c = V0/V: int over the faster part of (1 - V0/v) by distance = sqrt(1 - c^2) - c acos(c).
    let c = slowest / (FRAC_PI_2 * SPEED);
    let expected = (1.0 - c * c).sqrt() - c * c.acos();
    let rate = 1e6 * severe.molten_fraction / severe.latent_heat_j_m3
        * severe.heat_share
        * severe.friction;
    let all = rate * scene.load_n_per_mm * summary.last.sliding_distance_mm;
    let off = summary.last.receptacle.worn_area_mm2 / (expected * all) - 1.0;
    println!("severe oxidation in a part of a stroke: worn area off by {off:+.1e}");
    assert!(off.abs() < 0.5 * TOLERANCE, "{off}");
}
