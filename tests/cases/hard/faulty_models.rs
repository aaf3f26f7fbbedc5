//! Requirement: a value of a model that no contact has is refused with its pointer, itself and the limit; lengths in another unit are pointed out.
//! Source: contract.md; the ranges of `/v1/schemas`.
//! Naive: a negative radius is squared, zero layers divide, and a width in um is meshed.

use serde_json::{Value, json};
use server::spec::{self, Refused};

use super::invariants::across;
use super::run::solve;
use super::specs::{ring, spring};

/// Faults and warnings of a specification.
fn said(spec: &Value) -> (bool, Vec<String>) {
    let (accepted, said) = match spec::read(spec.to_string().as_bytes()) {
        Ok(resolved) => (true, resolved.warnings),
        Err(Refused::Faults(faults)) => (false, faults),
        Err(error) => panic!("{error}: {spec}"),
    };
    let said = said.into_iter();
    (
        accepted,
        said.map(|fault| format!("{}: {}", fault.pointer, fault.detail))
            .collect(),
    )
}

/// Asserts that some fault or warning has a pointer and all of these parts.
fn has(said: &[String], pointer: &str, parts: &[&str]) {
    let found = said.iter().any(|said| {
        said.starts_with(&format!("{pointer}: ")) && parts.iter().all(|part| said.contains(part))
    });
    assert!(found, "{pointer} {parts:?}: {said:?}");
}

#[test]
fn values_outside_of_their_ranges_are_refused_with_the_limit() {
    let line = |name: &str, value: Value| {
        let mut model = json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10});
        model[name] = value;
        spring(model, json!({}))
    };
    let extruded = |name: &str, value: Value| {
        let mut model = json!({"dimension": "extruded", "width_mm": 0.1});
        model[name] = value;
        spring(model, json!({}))
    };
    let of_ring = |name: &str, value: Value| ring(json!({"model": {name: value}}));
    for (value, shown) in [
        (0.0, "0 "),
        (-0.4, "-0.4"),
        (1e-9, "1e-9"),
        (1e7, "10000000"),
        (1e300, "1e300"),
    ] {
        for (spec, pointer) in [
            (line("width_mm", json!(value)), "/model/width_mm"),
            (
                line("crown_radius_mm", json!(value)),
                "/model/crown_radius_mm",
            ),
            (extruded("width_mm", json!(value)), "/model/width_mm"),
            (
                of_ring("outer_diameter_mm", json!(value)),
                "/model/outer_diameter_mm",
            ),
            (
                spring(
                    json!({"dimension": "point", "radius_z_mm": value}),
                    json!({}),
                ),
                "/model/radius_z_mm",
            ),
        ] {
            let (accepted, said) = said(&spec);
            assert!(!accepted, "{value}: {spec}");
            has(&said, pointer, &[shown]);
            has(
                &said,
                pointer,
                &[if value < 1.0 { "0.000001" } else { "10000" }],
            );
        }
    }
    for (spec, pointer, parts) in [
        (
            line("tilt_mrad", json!(101)),
            "/model/tilt_mrad",
            ["101", "100"],
        ),
        (
            line("tilt_mrad", json!(-5000)),
            "/model/tilt_mrad",
            ["-5000", "-100"],
        ),
        (extruded("layers", json!(0)), "/model/layers", ["0", "2"]),
        (extruded("layers", json!(3)), "/model/layers", ["3", "odd"]),
        (
            extruded("layers", json!(100_000)),
            "/model/layers",
            ["100000", "2"],
        ),
        (
            extruded("layer_growth", json!(0)),
            "/model/layer_growth",
            ["0", "1"],
        ),
        (
            extruded("layer_growth", json!(6)),
            "/model/layer_growth",
            ["6", "5"],
        ),
        (
            of_ring("outer_diameter_mm", json!(0.1016)),
            "/model/outer_diameter_mm",
            ["0.1016", "0.0254"],
        ),
    ] {
        let (accepted, said) = said(&spec);
        assert!(!accepted, "{spec}");
        has(&said, pointer, &parts);
    }
    for stations in [0, 2, 258, 1_000_000] {
        let few = json!({"accuracy": {"overrides": {"stations": stations}}});
        let (accepted, said) = said(&ring(few));
        assert!(!accepted, "{stations}");
        let pointer = "/accuracy/overrides/stations";
        has(
            &said,
            pointer,
            &[
                &stations.to_string(),
                if stations < 3 { "3" } else { "257" },
            ],
        );
    }
}

/// A wire, a ball and extruded bodies have no tilt: nothing of the answer would depend on it.
#[test]
fn a_tilt_is_one_of_a_straight_line() {
    for model in [
        json!({"dimension": "point", "tilt_mrad": 1}),
        json!({"dimension": "extruded", "width_mm": 0.1, "tilt_mrad": 1}),
        json!({"dimension": "plane_strain", "tilt_mrad": 1}),
    ] {
        let (accepted, said) = said(&spring(model, json!({})));
        assert!(!accepted);
        has(&said, "/model/tilt_mrad", &[]);
    }
    let (accepted, said) = said(&ring(json!({"model": {"tilt_mrad": 1}})));
    assert!(!accepted);
    has(&said, "/model/tilt_mrad", &["ring"]);
}

#[test]
fn lengths_in_micrometres_are_pointed_out() {
    let model = |field: &str, um: f64| {
        let mut model = json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10});
        model[field] = json!(um);
        model
    };
    for (spec, pointer) in [
        (
            spring(model("width_mm", 800.0), json!({})),
            "/model/width_mm",
        ),
        (
            spring(model("crown_radius_mm", 9_999.0), json!({})),
            "/model/crown_radius_mm",
        ),
        (
            ring(json!({"model": {"outer_diameter_mm": 1016}})),
            "/model/outer_diameter_mm",
        ),
        (
            spring(json!({"dimension": "point", "radius_z_mm": 400}), json!({})),
            "/model/radius_z_mm",
        ),
        (
            spring(json!({"dimension": "extruded", "width_mm": 800}), json!({})),
            "/model/width_mm",
        ),
    ] {
        let (_, said) = said(&spec);
        has(&said, pointer, &["meant in um"]);
    }
}

/// Without a motion a ball is loaded and wears nothing, as a section does; sections along a line only slide.
#[test]
fn no_motion_is_that_of_a_ball_and_refused_along_a_line() {
    let still = json!({
        "motion": {"amplitude_mm": 0},
        "cycles": 3,
        "accuracy": {"overrides": {"increments_per_cycle": 20}},
    });
    let ball = solve(&spring(json!({"dimension": "point"}), still.clone()));
    across::hold(&ball);
    assert!(ball.summary().last.receptacle.max_depth_mm <= 0.0);
    for model in [
        json!({"dimension": "line", "width_mm": 0.8}),
        json!({"dimension": "extruded", "width_mm": 0.1}),
    ] {
        let (accepted, said) = said(&spring(model, still.clone()));
        assert!(!accepted);
        has(&said, "/motion/amplitude_mm", &["0, must be positive"]);
    }
}
