//! Laws of which a power of the depth adds. Where the exponents make y = h^(1/c) a dose, its integral over the surface is that of the load
//! sliding its path; laws without slip wear where the contact sticks.

use super::{
    ARCHARD, LONG, SHORT, TOLERANCE, check_refinement, check_swap, difference, integral,
    last_profile, reports, scene,
};
use crate::verification::recorder::{depth_at, solve};
use crate::verification::scenes::partial_slip;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::law::temperature::Temperature;
use solver::scene::{
    Accuracy, Friction, LoadRepetition, Motion, Rhee, Scene, StrainHardening, WearLaw,
};
use solver::sides::{Side, Sides};

/// Depth that all laws wear under a pressure in MPa by a path in mm at a mean speed in mm/s, mm; the constants are none of a material.
const DEPTH: f64 = 2e-4;
const PRESSURE: f64 = 100.0;
const PATH: f64 = 10.0;
const SPEED: f64 = 0.4;

fn rhee([a, b, c]: [f64; 3]) -> WearLaw {
    let law = Rhee {
        factor: DEPTH / (PRESSURE.powf(a) * SPEED.powf(b) * (PATH / SPEED).powf(c)),
        pressure_exponent: a,
        speed_exponent: b,
        time_exponent: c,
    };
    WearLaw::Power(law.power_law())
}

/// By the repetitions of a stroke of an amplitude, mm.
fn load_repetition([c2, c3]: [f64; 2], amplitude_mm: f64, length_mm: f64) -> WearLaw {
    let repetitions = PATH / (4.0 * amplitude_mm);
    let law = LoadRepetition {
        factor: DEPTH / (PRESSURE.powf(c2) * repetitions.powf(c3)) / length_mm,
        pressure_exponent: c2,
        repetition_exponent: c3,
        length_mm,
    };
    WearLaw::Power(law.power_law())
}

fn strain_hardening() -> WearLaw {
    let (length_mm, exponent): (f64, f64) = (1e-3, -0.5);
    let rest = 1.0 - exponent;
    let thermal = (-1_000.0_f64 / 300.0).exp();
    let law = StrainHardening {
        factor: (DEPTH / length_mm).powf(rest) / (rest * PRESSURE.powi(2) * thermal * PATH / SPEED),
        pressure_exponent: 2.0,
        strain_exponent: exponent,
        activation_k: 1_000.0,
        temperature: Temperature::OfContact(300.0),
        length_mm,
    };
    WearLaw::Power(law.power_law())
}

/// Laws that wear as much over a path, for a stroke of an amplitude, mm.
fn laws(amplitude_mm: f64) -> [(&'static str, WearLaw); 4] {
    [
        ("Rhee", rhee([1.2, 0.8, 0.9])),
        ("Rhee, accelerating", rhee([2.0, 1.0, 1.5])),
        (
            "load repetition",
            load_repetition([1.5, 0.8], amplitude_mm, 1e-3),
        ),
        ("strain hardening", strain_hardening()),
    ]
}

/// A scene at the mean speed.
fn at_speed(stroke: (f64, u64), law: WearLaw, sides: &[Side]) -> Scene {
    let mut scene = scene(stroke, law, sides);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: stroke.0,
        period_s: 4.0 * stroke.0 / SPEED,
    };
    scene
}

/// Archard's law of the same wear.
fn archard() -> WearLaw {
    WearLaw::Archard {
        k_over_h_per_mpa: DEPTH / (PRESSURE * PATH),
    }
}

const STROKES: [((f64, u64), &[Side]); 3] = [
    ((0.004, 100), &Side::BOTH),
    ((0.1, 30), &Side::BOTH),
    ((0.1, 30), &[Side::Slider]),
];

#[test]
fn rhees_law_without_exponents_is_archards() {
    for (stroke, sides) in STROKES {
        let run = |law| {
            let scene = at_speed(stroke, law, sides);
            solve(&scene).expect("the scene can be solved").0
        };
        let off = difference(&run(rhee([1.0; 3])), &run(archard()));
        println!("Rhee without exponents, {} mm: {off:.1e}", stroke.0);
        // The constant is a product of others.
        assert!(off < 1e-9, "{off}");
    }
}

#[test]
fn rhees_law_of_exponents_near_one_is_almost_archards() {
    for (stroke, sides) in STROKES {
        let run = |law| {
            let mut scene = at_speed(stroke, law, sides);
            scene.accuracy.cycle_jump = Some(1);
            solve(&scene).expect("the scene can be solved").0
        };
        // Below 1, the same body takes over the pressures.
        let near = 1.0 - 1e-12;
        let off = difference(&run(rhee([near; 3])), &run(archard()));
        println!("Rhee of exponents near 1, {} mm: {off:.1e}", stroke.0);
        // In a long stroke the plan leaves out the elastic slip for Archard's law alone.
        let allowed = if stroke.0 > 0.05 {
            0.1 * TOLERANCE
        } else {
            1e-9
        };
        assert!(off < allowed, "{off}");
    }
}

/// a = b = c: h^(1/c) is a dose, at any tolerance.
fn what_adds_is_the_dose(exponents: &[f64], tolerance: f64) {
    for &c in exponents {
        let a = c.max(1.0);
        // With a = 1 and c < 1 the pressure has the exponent 1/c in what adds, and no identity.
        let (exponents, has_identity) = ([a, c, c], c >= 1.0);
        for (stroke, sides) in [
            ((0.004, 1_000), &Side::BOTH[..]),
            ((0.1, 200), &Side::BOTH[..1]),
            ((0.1, 200), &Side::BOTH[1..]),
        ] {
            let mut scene = at_speed(stroke, rhee(exponents), sides);
            scene.accuracy = Accuracy::from_tolerance(tolerance);
            let (summary, run) = solve(&scene).expect("the scene can be solved");
            let Friction::Coulomb { coefficient } = scene.friction else {
                panic!("the scene has friction");
            };
            let dose = summary.last.dissipated_energy_mj_per_mm / coefficient;
            let expected = dose * DEPTH.powf(c.recip()) / (PRESSURE * PATH);
            for side in sides {
                let found = integral(last_profile(&run, *side), |h| h.powf(c.recip()));
                let deepest = reports(&summary).of(*side).max_depth_mm;
                let off = found / expected - 1.0;
                println!(
                    "power {c}, {} mm, {}: what adds is off by {off:+.1e}, {deepest:.1e} mm deep, {} computed cycles",
                    stroke.0,
                    side.name(),
                    summary.resolution.computed_cycles
                );
                assert!(!has_identity || off.abs() < 1e-6, "{off}");
            }
            assert!(summary.checks.worn_area < 1e-9);
        }
    }
}

/// The laws with the exponents furthest from those of Archard's, for a sixteenth of the cycles of the long form.
#[test]
fn power_laws_do_not_depend_on_increments_and_jumps() {
    let fewer = |(amplitude, cycles): (f64, u64)| (amplitude, cycles / 16);
    let (short, long) = (fewer(SHORT), fewer(LONG));
    let [_, _, repetition, (name, hardening)] = laws(short.0);
    let receptacle = at_speed(short, hardening, &Side::BOTH[1..]);
    check_refinement(&format!("{name}, short stroke"), &receptacle);
    let (name, law) = laws(long.0)[1];
    let receptacle = at_speed(long, law, &Side::BOTH[1..]);
    check_refinement(&format!("{name}, long stroke"), &receptacle);
    let (name, law) = repetition;
    let both = at_speed(short, law, &Side::BOTH);
    check_refinement(&format!("{name}, both wear"), &both);
}

#[test]
fn what_adds_is_the_dose_of_the_load_along_its_path() {
    what_adds_is_the_dose(&[0.9, 1.5], 0.1);
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes 20 s"]
    fn what_adds_is_the_dose_of_laws_that_slow_down() {
        what_adds_is_the_dose(&[0.5, 0.9, 1.5], TOLERANCE);
    }

    #[test]
    #[ignore = "long: takes 100 s"]
    fn all_power_laws_do_not_depend_on_increments_and_jumps() {
        for (stroke, cycles) in [("short", SHORT), ("long", LONG)] {
            for (name, law) in laws(cycles.0) {
                let receptacle = at_speed(cycles, law, &Side::BOTH[1..]);
                check_refinement(&format!("{name}, {stroke} stroke"), &receptacle);
            }
        }
        for (name, law) in laws(SHORT.0) {
            let both = at_speed(SHORT, law, &Side::BOTH);
            check_refinement(&format!("{name}, both wear"), &both);
        }
    }

    #[test]
    #[ignore = "long: takes 40 s"]
    fn runs_by_all_power_laws_resume_to_the_same_bits() {
        for stroke in [(0.004, 400), (0.1, 50)] {
            for (name, law) in laws(stroke.0) {
                resumes(name, law, stroke, 4);
            }
        }
    }
}

#[test]
fn bodies_can_be_swapped_beside_power_laws() {
    // The stroke of the arcs.
    for (name, law) in laws(0.025) {
        let laws = Sides {
            slider: ARCHARD,
            receptacle: law,
        };
        check_swap(&format!("{name}, beside Archard"), &laws);
    }
}

/// Two thirds of the contact stick: there laws of slip wear nothing, and laws of the load wear most.
#[test]
fn points_that_stick_wear_by_laws_without_slip() {
    let middle = |law| {
        let mut scene = partial_slip();
        (scene.slider.wear, scene.receptacle.wear) = (None, Some(law));
        scene.cycles = 20;
        scene.output.snapshots_at_cycles = vec![20];
        let run = solve(&scene).expect("the scene can be solved").1;
        depth_at(run.last_profile(), 0.0)
    };
    for (name, law, wears) in [
        ("Rhee", rhee([1.2, 0.8, 0.9]), false),
        (
            "load repetition",
            load_repetition([1.5, 0.8], 0.003, 1e-3),
            true,
        ),
        ("strain hardening", strain_hardening(), true),
    ] {
        let depth = middle(law);
        println!("{name}: {depth:.2e} mm in the middle of a contact that sticks there");
        assert_eq!(depth > 0.0, wears, "{depth}");
    }
}

/// The length is a factor of the depth, and no element.
#[test]
fn the_reference_length_belongs_to_the_constants() {
    let run = |law| {
        let scene = at_speed((0.004, 300), law, &Side::BOTH);
        solve(&scene).expect("the scene can be solved").0
    };
    let (one, other) = (
        run(load_repetition([1.5, 0.8], 0.004, 1e-3)),
        run(load_repetition([1.5, 0.8], 0.004, 2.0)),
    );
    assert!(difference(&one, &other) < 1e-9);
}

#[test]
fn runs_by_power_laws_resume_to_the_same_bits() {
    let [_, accelerating, repetition, hardening] = laws(0.004);
    for (name, law) in [accelerating, repetition, hardening] {
        resumes(name, law, (0.004, 400), 2);
    }
    let (name, law) = laws(0.1)[1];
    resumes(name, law, (0.1, 50), 2);
}

fn resumes(name: &str, law: WearLaw, stroke: (f64, u64), times: usize) {
    let mut scene = at_speed(stroke, law, &Side::BOTH);
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.output.snapshots_at_cycles = vec![stroke.1 / 2, stroke.1];
    resumes_to_the_same_bits(&format!("{name}, {} mm", stroke.0), &scene, times);
}
