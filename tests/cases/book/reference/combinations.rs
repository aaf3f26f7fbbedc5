//! The page of what each dimension simulates, from the answers of the program: each feature is submitted in each dimension.

use std::fmt::Write;

use serde_json::{Value, json};
use server::spec::{self, Refused};
use solver::effects;
use solver::scene::Effect;

use super::cell;

const HEAD: &str = "# What each dimension simulates

Each feature of a row is submitted in each dimension of a column: an `sd_card`, for the ring a `fuzz_button`. *Yes* is simulated, *no* is refused
with the reason below, and *left out* is accepted while the plan says what that means for the result. Tests are those of the engine
(`cargo test --release -p solver NAME`).
";

/// A feature, what a specification adds for it, and tests of the engine.
struct Feature {
    name: &'static str,
    added: Value,
    /// The effect that a plan must simulate.
    effect: Option<Effect>,
    tests: &'static [&'static str],
}

/// A column: a name and a specification.
struct Column {
    name: &'static str,
    base: Value,
}

fn columns() -> Vec<Column> {
    let of = |name, kind: &str, model: Value| Column {
        name,
        base: json!({
            "system": {"kind": kind}, "model": model, "cycles": 100, "accuracy": {"preset": "draft"},
        }),
    };
    let line = json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10.0});
    let ring = json!({"dimension": "ring", "outer_diameter_mm": 1.016, "top": "rigid"});
    let extruded = json!({"dimension": "extruded", "width_mm": 0.8, "layers": 2, "ends": "free"});
    let point = json!({"dimension": "point", "radius_z_mm": 0.4});
    vec![
        of(
            "plane_strain",
            "sd_card",
            json!({"dimension": "plane_strain"}),
        ),
        of("point", "sd_card", point),
        of("line", "sd_card", line),
        of("ring", "fuzz_button", ring),
        of("extruded", "sd_card", extruded),
    ]
}

fn feature(
    name: &'static str,
    added: Value,
    effect: Option<Effect>,
    tests: &'static [&'static str],
) -> Feature {
    Feature {
        name,
        added,
        effect,
        tests,
    }
}

/// Motions and missions.
fn motions() -> Vec<Feature> {
    let of = |name, added, tests| feature(name, added, None, tests);
    let vibration = json!({"kind": "vibration", "acceleration_g": 28.0, "frequency_hz": 100.0,
                           "mass_g": 5.0, "contacts": 9});
    let thermal = json!({"kind": "thermal_cycle", "delta_t_k": 60.0, "length_mm": 20.0,
                         "expansion_mismatch_per_k": 1e-5});
    let fourier = json!({"kind": "fourier", "terms": [
        {"order": 1, "sine_mm": 0.03}, {"order": 2, "cosine_mm": 0.01}]});
    let block = |amplitude_mm: f64| {
        json!({"name": format!("by {amplitude_mm} mm"), "cycles": 10,
               "motion": {"kind": "reciprocating", "amplitude_mm": amplitude_mm}})
    };
    vec![
        of(
            "to and fro",
            json!({}),
            &[
                "verify_gross_slip",
                "verify_point_runs",
                "verify_line_runs",
                "verify_extruded",
            ],
        ),
        of(
            "Fourier series",
            json!({"motion": fourier}),
            &["verify_periodic_motion", "verify_point_motions"],
        ),
        of(
            "vibration",
            json!({"motion": vibration, "load": {"kind": "force", "n": 0.5}}),
            &["verify_gross_slip"],
        ),
        of(
            "temperature cycles",
            json!({"motion": thermal}),
            &["verify_gross_slip"],
        ),
        of(
            "matings",
            json!({"motion": {"kind": "insertion", "wipe_mm": 0.2}}),
            &["verify_long_wipe", "verify_point_motions"],
        ),
        of(
            "continuous",
            json!({"motion": {"kind": "continuous", "distance_mm": 10.0, "speed_mm_s": 1.0}, "cycles": null}),
            &["verify_moving_line_contact", "verify_point_motions"],
        ),
        of(
            "mission in order",
            json!({"mission": [block(0.02), block(0.04)], "motion": null, "cycles": null}),
            &["verify_mission", "missions"],
        ),
    ]
}

/// Friction, wear and effects of the contact.
fn contacts() -> Vec<Feature> {
    let by_cycle = json!([{"cycle": 0, "coefficient": 0.2}, {"cycle": 5000, "coefficient": 0.5}]);
    let by_dose =
        json!([{"dose_mpa_mm": 0, "coefficient": 0.2}, {"dose_mpa_mm": 2e4, "coefficient": 0.5}]);
    let friction = |table: &str, points: Value| json!({"interface": {"friction": {"law": "coulomb", table: points}}});
    let gold = json!({"material": "hard_gold", "thickness_um": 0.76, "friction_coefficient": 0.2, "wear": {"law": "archard", "k": 1e-5}});
    let bare = json!({"slider": [], "receptacle": []});
    let law = |law: Value| json!({"plating": bare, "interface": {"wear": {"slider": null, "receptacle": law}}});
    let films = json!([{"specific_resistance_ohm_mm2": 1e-5}]);
    vec![
        feature(
            "plating on both sides",
            json!({}),
            None,
            &["verify_plated_life", "verify_plating"],
        ),
        feature(
            "friction by cycle",
            friction("by_cycle", by_cycle),
            None,
            &["verify_changing_friction"],
        ),
        feature(
            "friction by dose",
            friction("by_dose", by_dose),
            None,
            &["verify_changing_friction"],
        ),
        feature(
            "friction by layer",
            json!({"plating": {"receptacle": [gold]}}),
            None,
            &["verify_changing_friction"],
        ),
        feature(
            "wear by dose (`sarkar`)",
            law(json!({"law": "sarkar", "k": 1e-4})),
            None,
            &["verify_wear_laws"],
        ),
        feature(
            "resistance with films",
            json!({"interface": {"films": films}}),
            Some(Effect::Resistance),
            &["verify_contact_resistance", "verify_life_by_resistance"],
        ),
        feature(
            "heat of friction",
            json!({"effects": {"frictional_heating": "on"}}),
            Some(Effect::FrictionalHeating),
            &["verify_heating"],
        ),
        feature(
            "spring",
            json!({"load": {"kind": "force", "n": 0.5, "spring_n_per_mm": 1.0},
                   "effects": {"spring_fading": "on"}}),
            Some(Effect::SpringFading),
            &["verify_spring_load"],
        ),
        feature(
            "fields inside the bodies",
            json!({"output": {"fields": true}}),
            None,
            &["verify_pressure_fields", "verify_line_fields"],
        ),
    ]
}

/// A specification with a part of it replaced (RFC 7396).
fn merged(mut base: Value, added: &Value) -> Value {
    match (base.as_object_mut(), added.as_object()) {
        (Some(fields), Some(added)) => {
            for (name, value) in added {
                if value.is_null() && (name == "cycles" || name == "motion") {
                    fields.remove(name);
                } else {
                    let before = fields.remove(name).unwrap_or(Value::Null);
                    fields.insert(name.clone(), merged(before, value));
                }
            }
            base
        }
        _ => added.clone(),
    }
}

/// Answer of the program in a cell, with the reason where it refuses.
fn answer(column: &Column, feature: &Feature) -> (&'static str, Option<String>) {
    let specification = merged(column.base.clone(), &feature.added);
    match spec::read(specification.to_string().as_bytes()) {
        Ok(resolved) => {
            let plan = effects::plan(&resolved.scene);
            let is_simulated = feature.effect.is_none_or(|effect| plan.simulates(effect));
            (if is_simulated { "yes" } else { "left out" }, None)
        }
        Err(Refused::Parse(error)) => panic!("{}: {error}", feature.name),
        Err(Refused::Faults(faults)) => {
            let fault = faults.first().expect("a fault");
            let reason = format!("`{}`: {}", fault.pointer, fault.detail);
            ("no", Some(reason))
        }
    }
}

pub(super) fn page() -> String {
    let columns = columns();
    let names: Vec<String> = columns
        .iter()
        .map(|column| format!(" {} |", column.name))
        .collect();
    let mut page = format!("{HEAD}\n| feature |{} tests |\n", names.concat());
    page.push_str(&"| --- ".repeat(columns.len() + 2));
    page.push_str("|\n");
    let mut reasons = String::new();
    for feature in motions().iter().chain(&contacts()) {
        write!(page, "| {} |", feature.name).expect("a text grows");
        for column in &columns {
            let (found, reason) = answer(column, feature);
            write!(page, " {found} |").expect("a text grows");
            if let Some(reason) = reason {
                writeln!(
                    reasons,
                    "| {} | {} | {} |",
                    feature.name,
                    column.name,
                    cell(&reason)
                )
                .expect("a text grows");
            }
        }
        let tests: Vec<String> = feature
            .tests
            .iter()
            .map(|name| format!("`{name}`"))
            .collect();
        writeln!(page, " {} |", tests.join(", ")).expect("a text grows");
    }
    writeln!(
        page,
        "\n## Why something is refused\n\n| feature | dimension | answer |\n| --- | --- | --- |\n{}",
        reasons.trim_end()
    )
    .expect("a text grows");
    page
}

#[test]
fn named_tests_exist() {
    let house = crate::book::house();
    for feature in motions().iter().chain(&contacts()) {
        for name in feature.tests {
            let files = [
                format!("solver/tests/{name}.rs"),
                format!("solver/src/run/tests/{name}.rs"),
            ];
            let exists = files.iter().any(|file| house.join(file).is_file());
            assert!(exists, "{name}");
        }
    }
}
