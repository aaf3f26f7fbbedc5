//! Requirement: where `auto` changes from one model to another, both give the same wear within the tolerance.
//! Source: docs/guide/lines.md; the spring of a memory card. The crowns and tilts are found by bisection of what the plan chooses.
//! Naive: a switch by a ratio that no error is known of, and a life that jumps by a factor where a crown changes by a thousandth.

use serde_json::{Value, json};
use server::spec;
use solver::scene::Dimension;

use super::invariants::across;
use super::run::{Run, scene, solve};
use super::specs::spring;

/// Tolerance of `draft`, of either run.
const TOLERANCE: f64 = 0.1;
const CYCLES: u64 = 200;

/// A rate by which some nm are worn, and one by which a few um are.
const SLOW: f64 = 5.9e-9;
const FAST: f64 = 5.9e-6;

fn with(k_over_h_per_mpa: f64, model: Value) -> Value {
    let wear = json!({"law": "archard", "k_over_h_per_mpa": k_over_h_per_mpa});
    let changes = json!({"cycles": CYCLES, "interface": {"wear": {"receptacle": wear}}});
    spring(model, changes)
}

fn auto(rate: f64, (field, value): (&str, f64)) -> Value {
    with(
        rate,
        json!({"dimension": "auto", "width_mm": 0.8, field: value}),
    )
}

/// The value between two, by its logarithm, where the plan changes its mind.
fn switch(rate: f64, field: &str, (mut one, mut other): (f64, f64)) -> f64 {
    let kind = |value: f64| std::mem::discriminant(&scene(&auto(rate, (field, value))).dimension);
    let first = kind(one);
    assert_ne!(first, kind(other), "{field} from {one} to {other}");
    for _ in 0..20 {
        let middle = (one * other).sqrt();
        if kind(middle) == first {
            one = middle;
        } else {
            other = middle;
        }
    }
    other
}

fn run(rate: f64, model: Value) -> Run {
    let run = solve(&with(rate, model));
    across::hold(&run);
    run
}

fn plane() -> Run {
    let mut section = with(FAST, json!({"dimension": "plane_strain"}));
    section["load"]["width_mm"] = json!(0.8);
    solve(&section)
}

#[test]
fn plane_strain_and_a_line_agree_where_a_crown_or_a_tilt_begins_to_count() {
    let plane = plane().depth();
    let crown = switch(FAST, "crown_radius_mm", (1e4, 100.0));
    let tilt = switch(FAST, "tilt_mrad", (1e-7, 10.0));
    for (field, value) in [("crown_radius_mm", crown), ("tilt_mrad", tilt)] {
        let line = run(
            FAST,
            json!({"dimension": "line", "width_mm": 0.8, field: value}),
        )
        .depth();
        println!("{field} {value:.4e}: {line:.4e} along a line, {plane:.4e} mm in plane strain");
        assert!(
            (line / plane - 1.0).abs() < TOLERANCE,
            "{field}: {line} {plane}"
        );
    }
}

#[test]
fn a_point_and_a_line_agree_where_the_contact_grows_to_the_ends() {
    let crown = switch(SLOW, "crown_radius_mm", (10.0, 1e4));
    let chosen = scene(&auto(SLOW, ("crown_radius_mm", crown))).dimension;
    assert!(matches!(chosen, Dimension::Line(_)), "{chosen:?}");
    let point = run(SLOW, json!({"dimension": "point", "radius_z_mm": crown})).depth();
    let line = run(
        SLOW,
        json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": crown}),
    )
    .depth();
    println!("crown of {crown:.4e} mm: {line:.4e} mm along a line, {point:.4e} mm of a point");
    assert!((line / point - 1.0).abs() < TOLERANCE, "{line} {point}");
}

/// A reason names what it was chosen by.
#[test]
fn the_reason_of_a_switch_has_its_numbers() {
    for crown in [10.0, 1e3, 1e4] {
        let text = auto(SLOW, ("crown_radius_mm", crown)).to_string();
        let resolved = spec::read(text.as_bytes()).expect("it is accepted");
        let reason = resolved.chosen.expect("a reason");
        assert!(reason.contains(|c: char| c.is_ascii_digit()), "{reason}");
    }
}
