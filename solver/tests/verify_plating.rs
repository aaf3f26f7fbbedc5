//! Wear through the layers of a plating.
//!
//! * Where all of the contact slides over a flat floor, each pass wears k P off it: a layer of thickness t lasts t/(2 k P)
//!   cycles, and the layers' cycles add up.
//! * The dose that the worn depth of every node stands for adds up to that of the load sliding its path, whichever body is plated
//!   and carries the constraints: integral of G^-1(h) dx = energy/mu.
//! * Layers of one rate wear as the bare body.

use crate::verification::recorder::{Recorder, largest_distance, solve};
use crate::verification::scenes::sprung_contact;
use solver::record::{DepthProfile, Outcome, Summary};
use solver::scene::{Accuracy, Criterion, Layer, Motion, Scene, WearLaw};
use solver::sides::{Side, Sides};

/// Gold, nickel and the base, 1/MPa.
pub(crate) const RATES: [f64; 3] = [1e-7, 4e-7, 2e-6];
/// Thickness of gold and nickel, mm.
pub(crate) const THICKNESS: [f64; 2] = [0.1e-3, 0.15e-3];

pub(crate) fn layer(thickness_mm: f64, rate_per_mpa: f64) -> Layer {
    Layer {
        thickness_mm,
        rate_per_mpa,
    }
}

/// Plates both bodies, or one of them; the other does not wear.
pub(crate) fn plated(amplitude_mm: f64, sides: &[Side], cycles: u64, tolerance: f64) -> Scene {
    let mut scene = sprung_contact();
    let layers = vec![layer(THICKNESS[0], RATES[0]), layer(THICKNESS[1], RATES[1])];
    let of = |side| {
        if sides.contains(&side) {
            let base = WearLaw::Archard {
                k_over_h_per_mpa: RATES[2],
            };
            (Some(base), layers.clone())
        } else {
            (None, Vec::new())
        }
    };
    (scene.slider.wear, scene.slider.plating) = of(Side::Slider);
    (scene.receptacle.wear, scene.receptacle.plating) = of(Side::Receptacle);
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    };
    scene.cycles = cycles;
    scene.accuracy = Accuracy::from_tolerance(tolerance);
    scene
}

/// Dose of a depth, MPa mm.
fn dose(depth: f64) -> f64 {
    let mut left = depth;
    let mut dose = 0.0;
    for (thickness, rate) in THICKNESS.into_iter().chain([f64::INFINITY]).zip(RATES) {
        let worn = left.min(thickness);
        dose += worn / rate;
        left -= worn;
    }
    dose
}

/// Integral of the dose over a profile, N.
fn dose_of(profile: &DepthProfile) -> f64 {
    let x = &profile.x_mm;
    let last = x.len() - 1;
    let nodes = profile.depth_mm.iter().enumerate();
    nodes
        .map(|(i, depth)| 0.5 * (x[(i + 1).min(last)] - x[i.saturating_sub(1)]) * dose(*depth))
        .sum()
}

fn last_profiles(run: &Recorder) -> Sides<DepthProfile> {
    let last = &run.snapshots[run.snapshots.len() - 1];
    Sides {
        slider: last.slider.clone(),
        receptacle: last.receptacle.clone(),
    }
}

/// Wears a floor from the unworn surface to a depth; returns the cycles by the last two reports, interpolated to the depth.
fn cycles_to(depth_mm: f64, tolerance: f64) -> f64 {
    let mut scene = plated(0.1, &[Side::Receptacle], 1_000_000, tolerance);
    scene.stop = vec![Criterion::deepest(Side::Receptacle, depth_mm)];
    let (summary, run) = solve(&scene).expect("the scene can be solved");
    assert_eq!(summary.outcome, Outcome::StopCondition);
    let reports = &run.reports[run.reports.len() - 2..];
    let [before, last] = [&reports[0], &reports[1]].map(|report| {
        let cycles = u32::try_from(report.cycle).expect("few cycles");
        (f64::from(cycles), dose(report.receptacle.max_depth_mm))
    });
    before.0 + (last.0 - before.0) * (dose(depth_mm) - before.1) / (last.1 - before.1)
}

#[test]
fn layers_of_a_long_groove_last_as_long_as_their_passes_take() {
    let load = sprung_contact().load_n_per_mm;
    let outer = THICKNESS[0] / (2.0 * RATES[0] * load);
    let both = outer + THICKNESS[1] / (2.0 * RATES[1] * load);
    for (name, depth, expected, tolerances) in [
        ("gold", THICKNESS[0], outer, &[0.02, 0.005][..]),
        (
            "gold and nickel",
            THICKNESS[0] + THICKNESS[1],
            both,
            &[0.02],
        ),
        (
            "both and as much copper",
            2.0 * (THICKNESS[0] + THICKNESS[1]),
            both + (THICKNESS[0] + THICKNESS[1]) / (2.0 * RATES[2] * load),
            &[0.02],
        ),
    ] {
        for &tolerance in tolerances {
            let found = cycles_to(depth, tolerance) / expected - 1.0;
            println!(
                "plating at {tolerance}: {name} lasts {expected:.1} cycles, off by {found:+.1e}"
            );
            assert!(found.abs() < 0.05 * tolerance, "{found}");
        }
    }
}

fn check_dose(name: &str, scene: &Scene) -> (Summary, Sides<DepthProfile>) {
    let (summary, run) = solve(scene).expect("the scene can be solved");
    let profiles = last_profiles(&run);
    let solver::scene::Friction::Coulomb { coefficient } = scene.friction else {
        panic!("the scene has friction");
    };
    let expected = summary.last.dissipated_energy_mj_per_mm / coefficient;
    for side in Side::BOTH {
        let body = match side {
            Side::Slider => &scene.slider.plating,
            Side::Receptacle => &scene.receptacle.plating,
        };
        if body.is_empty() {
            continue;
        }
        let found = dose_of(profiles.of(side)) / expected - 1.0;
        println!(
            "plating, {name}: dose of the {} off by {found:+.1e}, {:.2e} mm deep, {} computed cycles",
            side.name(),
            profiles
                .of(side)
                .depth_mm
                .iter()
                .fold(0.0, |m: f64, d| m.max(*d)),
            summary.resolution.computed_cycles,
        );
        assert!(found.abs() < 1e-6, "{found}");
    }
    (summary, profiles)
}

#[test]
fn doses_of_worn_layers_add_up_to_the_load_times_its_path() {
    let cases = [
        ("short stroke", 0.004, &Side::BOTH[..]),
        ("short stroke, slider plated", 0.004, &Side::BOTH[..1]),
        ("short stroke, receptacle plated", 0.004, &Side::BOTH[1..]),
        ("long stroke", 0.1, &Side::BOTH[..]),
        ("long stroke, slider plated", 0.1, &Side::BOTH[..1]),
        ("long stroke, receptacle plated", 0.1, &Side::BOTH[1..]),
    ];
    for (name, amplitude, sides) in cases {
        let cycles = if amplitude < 0.05 { 2_000 } else { 600 };
        check_dose(name, &plated(amplitude, sides, cycles, 0.1));
    }
}

/// Beside what else a scene may have: a spring, a crown, fields, a continuous motion.
#[test]
fn doses_add_up_beside_other_features() {
    for (name, amplitude, cycles) in [("short stroke", 0.004, 1_500), ("long stroke", 0.1, 300)] {
        let scene = plated(amplitude, &Side::BOTH, cycles, 0.1);
        let mut sprung = scene.clone();
        sprung.spring_n_per_mm2 = 200.0 * sprung.load_n_per_mm;
        check_dose(&format!("{name}, spring"), &sprung);
        let mut crowned = scene.clone();
        crowned.receptacle.shape.crown_radius_mm = Some(20.0);
        check_dose(&format!("{name}, crown"), &crowned);
        let mut with_fields = scene.clone();
        with_fields.output.fields = true;
        check_dose(&format!("{name}, fields"), &with_fields);
    }
    let mut continuous = plated(0.0, &[Side::Receptacle], 1_000, 0.1);
    continuous.motion = Motion::Continuous { step_mm: 0.02 };
    let (summary, _) = check_dose("continuous", &continuous);
    assert!(summary.last.receptacle.max_depth_mm > THICKNESS[0]);
}

/// The jump control knows layers by their rates only: a crossing within a jump is part of its implicit step.
fn layers_of_a_short_stroke_converge_with_the_tolerance() {
    let sides = &Side::BOTH[..];
    let run = |tolerance| check_dose("convergence", &plated(0.004, sides, 4_000, tolerance)).1;
    let (coarse, fine) = (run(0.02), run(0.005));
    for side in Side::BOTH {
        let deepest = |profiles: &Sides<DepthProfile>| {
            let depths = profiles.of(side).depth_mm.iter();
            depths.fold(0.0, |m: f64, d| m.max(*d))
        };
        let off = deepest(&coarse) / deepest(&fine) - 1.0;
        println!(
            "plating, short stroke: {} at 2 % and 0.5 % differ by {off:+.1e} of the depth",
            side.name()
        );
        assert!(deepest(&fine) > THICKNESS[0] && off.abs() < 0.02, "{off}");
    }
}

#[test]
fn layers_of_one_rate_wear_as_the_bare_body() {
    for amplitude in [0.004, 0.1] {
        let mut bare = plated(amplitude, &Side::BOTH, 100, 0.1);
        bare.slider.plating.clear();
        bare.receptacle.plating.clear();
        let mut layered = bare.clone();
        layered.slider.plating = vec![layer(0.7e-4, RATES[2]), layer(0.9e-4, RATES[2])];
        layered.receptacle.plating = vec![layer(1e-4, RATES[2])];
        let [bare, layered] = [bare, layered].map(|scene| {
            let (_, run) = solve(&scene).expect("the scene can be solved");
            last_profiles(&run)
        });
        for side in Side::BOTH {
            let apart = largest_distance(bare.of(side), layered.of(side));
            println!(
                "layers of one rate, {amplitude} mm: {} differs by {apart:.1e}",
                side.name()
            );
            assert!(apart < 1e-6, "{apart}");
        }
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 13 s"]
    fn layers_of_a_short_stroke_converge_with_the_tolerance() {
        super::layers_of_a_short_stroke_converge_with_the_tolerance();
    }
}
