//! Data that the fitted constants of `solver::scene::Tuning` were chosen by: each is varied alone, on the scenes that it
//! concerns, against a solution at a tolerance of 0.25 %.
//!
//! `cargo run --release -p solver --example calibration [NAME]` prints all of them, or those whose name contains NAME.
//! Columns: value of the constant; errors of worn depth, scar width and profile (at its worst place, and in area) in per
//! cent, each that of the worse wearing side (s: slider, r: receptacle); error of the peak pressure in per cent; surface
//! elements, computed cycles and increments as the work. The forecast's constants: computed cycles and increments of the
//! forecast over those of the run.

#![expect(clippy::print_stdout, reason = "it prints a table")]

#[expect(dead_code, reason = "the verification suite uses more of it")]
#[path = "../tests/recorder.rs"]
mod recorder;
#[path = "../tests/scenes.rs"]
mod scenes;

use std::collections::BTreeMap;

use recorder::{Recorder, area_between, largest_distance, solve};
use scenes::{fuzz_button, groove, mccoll, partial_slip, pin, scar, sprung_contact};
use solver::SolveError;
use solver::record::{DepthProfile, SideReport, Summary};
use solver::scene::{Elastic, Friction, Motion, Scene, Tuning};
use solver::sides::Side;

const REFERENCE: f64 = 0.0025;

/// One constant with the values it takes, at a tolerance, on some scenes.
struct Variation {
    name: &'static str,
    constant: fn(&mut Tuning) -> &mut f64,
    values: &'static [f64],
    tolerance: f64,
    scenes: &'static [&'static str],
}

macro_rules! variations {
    ($($($path:tt).+ = $values:expr, $tolerance:expr, $scenes:expr;)*) => {
        [$(Variation {
            name: stringify!($($path).+),
            constant: |tuning| &mut tuning.$($path).+,
            values: &$values,
            tolerance: $tolerance,
            scenes: &$scenes,
        }),*]
    };
}

const ERRORS: [Variation; 49] = variations! {
    elements.value = [4.0, 8.0, 16.0], 0.02, ["scar", "partial slip"];
    elements.exponent = [0.2, 0.4, 0.6], 0.005, ["scar"];
    scar_elements.value = [8.0, 16.0, 32.0], 0.02, ["light scar"];
    gross_elements.value = [2.0, 4.0, 8.0], 0.02, ["groove", "sprung contact", "pin"];
    gross_elements.exponent = [0.2, 0.4, 0.6], 0.005, ["groove", "sprung contact"];
    gross_slider_refinement = [1.0, 1.5, 2.0], 0.02, ["worn slider", "both worn"];
    zone_growth.value = [0.015, 0.03, 0.06], 0.02, ["groove", "both worn"];
    zone_growth.exponent = [0.0, -0.35, -0.7], 0.005, ["groove"];
    scar_zone_growth.value = [0.03, 0.06, 0.12], 0.02, ["scar", "sprung contact"];
    scar_zone_growth.exponent = [-0.35, -1.5, -2.2], 0.005, ["scar", "sprung contact"];
    layer_growth.value = [0.12, 0.25, 0.5], 0.02, ["scar", "groove"];
    sticking_layer_growth.value = [0.03, 0.06, 0.12], 0.02, ["partial slip"];
    layer_growth.exponent = [0.0, -0.3, -0.6], 0.005, ["scar"];
    sticking_refinement.value = [2.0, 4.0, 6.0], 0.02, ["partial slip"];
    scar_margin = [1.0, 1.3, 2.0], 0.02, ["scar", "groove", "sprung contact", "partial slip"];
    core = [1.0, 2.0, 4.0], 0.02, ["scar", "sprung contact"];
    outer_growth = [0.12, 0.25, 0.5], 0.02, ["scar", "groove"];
    outer_element = [0.05, 0.1, 0.2], 0.02, ["scar", "groove"];
    largest_element = [0.05, 0.1, 0.2], 0.02, ["wide contact"];
    step.value = [0.12, 0.25, 0.5], 0.02, ["scar", "groove", "sprung contact", "pin"];
    step.exponent = [0.2, 0.4, 0.6], 0.005, ["groove", "sprung contact"];
    loose_step.exponent = [-0.3, -0.55, -0.8], 0.1, ["groove", "sprung contact"];
    short_step = [0.15, 0.3, 1.0], 0.02, ["light scar"];
    steps_per_quarter.value = [2.0, 5.0, 10.0], 0.02, ["scar"];
    sticking_steps_per_quarter.value = [5.0, 12.0, 24.0], 0.02, ["partial slip"];
    steps_per_quarter.exponent = [0.0, 0.36, 0.7], 0.005, ["scar"];
    drift.value = [0.05, 0.1, 0.2, 0.5], 0.02, ["whole groove"];
    drift.exponent = [0.0, -0.5, -1.0], 0.005, ["whole groove"];
    jump_change.0 = [0.25, 0.5, 0.8], 0.02, ["scar", "long sprung contact"];
    jump_change.1 = [1.2, 2.0, 4.0], 0.02, ["scar", "long sprung contact"];
    jump_error.exponent = [0.0, 0.5, 1.0], 0.005, ["long scar"];
    jump_of_done = [0.25, 0.5, 1.0], 0.02, ["scar", "long sprung contact"];
    gross_jump_of_done = [2.0, 4.0, 6.0, 12.0], 0.02, ["pin", "worn slider"];
    groove_jump_of_done = [3.0, 6.0, 12.0, 24.0, 48.0], 0.02, ["long groove", "whole groove", "sprung contact", "pin"];
    widest_followed = [1.0, 3.0, 6.0], 0.02, ["long groove", "longer groove"];
    smoothed_step.value = [0.0, 0.25, 0.5, 1.0], 0.02, ["long groove", "longer groove"];
    smoothed_step.exponent = [0.0, -0.25, -0.5], 0.005, ["groove", "long groove"];
    smoothed_early = [1.0, 2.0, 4.0], 0.02, ["short groove", "long groove"];
    smoothing_pass.value = [3.0, 5.0, 8.0, 16.0], 0.02, ["long groove", "longer groove"];
    smoothing_pass.exponent = [0.0, 0.25, 0.5], 0.005, ["groove", "long groove"];
    gross_jump_of_both = [0.5, 1.0, 2.0], 0.02, ["both worn"];
    gross_from = [1.0, 2.0, 4.0], 0.02, ["long sprung contact"];
    skew.value = [0.2, 0.4, 0.8], 0.02, ["scar", "long scar"];
    skew.exponent = [-0.25, -0.5, -1.0], 0.1, ["scar", "long scar"];
    least_skew = [0.1, 0.2, 0.4, 0.8], 0.005, ["long scar"];
    scar_jump_error = [1.0, 1.5, 2.0, 3.0], 0.02, ["scar", "long scar"];
    sufficient_cycles = [1.0, 2.5, 10.0], 0.02, ["long sprung contact"];
    lead_in = [2.0, 4.0, 8.0], 0.02, ["both worn", "worn slider"];
    fine_pass = [1.0, 2.0, 4.0, 8.0], 0.02, ["long groove", "longer groove"];
};

const FORECASTS: [Variation; 2] = variations! {
    surrogate_half_width = [1.0, 1.3, 1.6], 0.02, ["scar", "groove", "sprung contact", "long scar"];
    step_share = [0.27, 0.42, 0.47], 0.02, ["groove", "sprung contact", "long groove"];
};

fn scene(name: &str) -> Scene {
    let of_cycles = |mut scene: Scene, cycles| {
        scene.cycles = cycles;
        scene.output.snapshots_at_cycles.clear();
        scene
    };
    match name {
        "scar" => scar(),
        "long scar" => of_cycles(mccoll(), 18_000),
        "groove" => groove(),
        "short groove" => of_cycles(fuzz_button(), 3),
        "long groove" => of_cycles(fuzz_button(), 240),
        "longer groove" => of_cycles(fuzz_button(), 500),
        "whole groove" => of_cycles(fuzz_button(), 2_000),
        "sprung contact" => sprung_contact(),
        "long sprung contact" => of_cycles(sprung_contact(), 2_000),
        "partial slip" => partial_slip(),
        // Hardly wider than the unworn contact.
        "light scar" => {
            let mut scene = of_cycles(mccoll(), 20);
            scene.friction = Friction::Coulomb { coefficient: 0.3 };
            scene
        }
        "pin" => pin(),
        "worn slider" => {
            let mut scene = of_cycles(pin(), 200);
            scene.slider.wear = scene.receptacle.wear.take();
            scene
        }
        "both worn" => {
            let mut scene = of_cycles(sprung_contact(), 300);
            scene.slider.wear = scene.receptacle.wear;
            scene.motion = Motion::Reciprocating {
                amplitude_mm: 0.05,
                period_s: 1.0,
            };
            scene
        }
        // Half as wide as the bodies, without friction, so that it slides.
        "wide contact" => {
            let mut scene = scar();
            scene.friction = Friction::Frictionless;
            scene.slider.elastic = Elastic {
                youngs_modulus_mpa: 10.0,
                poisson_ratio: 0.3,
            };
            scene
        }
        _ => unreachable!("scenes of the tables above"),
    }
}

fn main() -> Result<(), SolveError> {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let chosen = |variation: &&Variation| variation.name.contains(&wanted);
    let mut references = BTreeMap::new();
    for variation in ERRORS.iter().filter(chosen) {
        println!(
            "\n{} at a tolerance of {}",
            variation.name, variation.tolerance
        );
        println!(
            "{:>20} {:>7} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8} {:>8} {:>10}",
            "scene",
            "value",
            "depth",
            "width",
            "worst",
            "area",
            "peak",
            "elements",
            "cycles",
            "increments"
        );
        for name in variation.scenes {
            if !references.contains_key(name) {
                let mut fine = scene(name);
                fine.accuracy.tolerance = REFERENCE;
                references.insert(*name, solve(&fine)?);
            }
            for value in variation.values {
                print_errors(
                    name,
                    *value,
                    &solve(&varied(variation, name, *value))?,
                    &references[name],
                );
            }
        }
    }
    for variation in FORECASTS.iter().filter(chosen) {
        println!(
            "\n{} at a tolerance of {}",
            variation.name, variation.tolerance
        );
        println!(
            "{:>20} {:>7} {:>8} {:>10}",
            "scene", "value", "cycles", "increments"
        );
        for name in variation.scenes {
            print_forecasts(variation, name)?;
        }
    }
    Ok(())
}

fn varied(variation: &Variation, name: &str, value: f64) -> Scene {
    let mut scene = scene(name);
    scene.accuracy.tolerance = variation.tolerance;
    *(variation.constant)(&mut scene.accuracy.tuning) = value;
    scene
}

fn print_errors(name: &str, value: f64, found: &(Summary, Recorder), exact: &(Summary, Recorder)) {
    let wears = |side: &Side| worn(exact, *side).report.max_depth_mm > 0.0;
    let wearing = Side::BOTH.into_iter().filter(wears);
    let errors: Vec<_> = wearing
        .map(|side| (side, errors(&worn(found, side), &worn(exact, side))))
        .collect();
    let worse = |which: usize| {
        let of_sides = errors.iter().map(|(side, errors)| (side, errors[which]));
        let worse = of_sides.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        worse.map_or_else(String::new, |(side, error)| {
            format!("{error:+.2} {}", &side.name()[..1])
        })
    };
    let resolution = &found.0.resolution;
    println!(
        "{name:>20} {value:>7} {:>8} {:>8} {:>8} {:>8} {:>+7.2} {:>8} {:>8} {:>10}",
        worse(0),
        worse(1),
        worse(2),
        worse(3),
        percent(
            found.0.last.peak_pressure_mpa,
            exact.0.last.peak_pressure_mpa
        ),
        resolution.contact_elements,
        resolution.computed_cycles,
        resolution.work.increments,
    );
}

/// Wear of a side after the last cycle.
struct WornSide<'a> {
    report: &'a SideReport,
    profile: &'a DepthProfile,
}

fn worn(solved: &(Summary, Recorder), side: Side) -> WornSide<'_> {
    let (summary, run) = solved;
    let (last, snapshot) = (&summary.last, &run.snapshots[run.snapshots.len() - 1]);
    let (report, profile) = match side {
        Side::Slider => (&last.slider, &snapshot.slider),
        Side::Receptacle => (&last.receptacle, &snapshot.receptacle),
    };
    WornSide { report, profile }
}

/// Errors of depth, scar width, profile at its worst place and profile in area, per cent.
fn errors(found: &WornSide<'_>, exact: &WornSide<'_>) -> [f64; 4] {
    let (reports, profiles) = ([found.report, exact.report], [found.profile, exact.profile]);
    [
        percent(reports[0].max_depth_mm, reports[1].max_depth_mm),
        percent(reports[0].scar_half_width_mm, reports[1].scar_half_width_mm),
        100.0 * largest_distance(profiles[0], profiles[1]),
        100.0 * area_between(profiles[0], profiles[1]),
    ]
}

fn percent(found: f64, exact: f64) -> f64 {
    100.0 * (found / exact - 1.0)
}

fn print_forecasts(variation: &Variation, name: &str) -> Result<(), SolveError> {
    let mut run = scene(name);
    run.accuracy.tolerance = variation.tolerance;
    let (solved, _) = solve(&run)?;
    for value in variation.values {
        let scene = varied(variation, name, *value);
        let layout = solver::model::Layout::of(&scene)?;
        let forecast = solver::forecast::forecast(&scene, &layout);
        let (cycles, increments) = (
            solved.resolution.computed_cycles,
            solved.resolution.work.increments,
        );
        println!(
            "{name:>20} {value:>7} {:>8.2} {:>10.2}",
            forecast.computed_cycles / real(cycles),
            forecast.increments() / real(increments),
        );
    }
    Ok(())
}

fn real(count: u64) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}
