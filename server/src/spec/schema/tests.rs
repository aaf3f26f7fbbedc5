//! Every range of the schema is enforced.

use api::spec::WearLawName;

use super::*;
use crate::spec;
use crate::spec::Refused;

/// Details of the faults of a specification at a pointer.
fn faults_at(pointer: &str, text: &str) -> Vec<String> {
    let Err(Refused::Faults(faults)) = spec::read(text.as_bytes()) else {
        return Vec::new();
    };
    let at = faults.into_iter().filter(|fault| fault.pointer == pointer);
    at.map(|fault| fault.detail).collect()
}

/// A receptacle with a layer.
const PLATED: &str = r#""plating":{"receptacle":[{"material":"silver","thickness_um":1.0}]}"#;

/// A criterion with a value at a field.
fn criterion(field: &str, value: f64) -> String {
    let kind = match field {
        "fraction" => "exposed_fraction",
        "mm" => "worn_depth",
        _ => "resistance",
    };
    format!(r#"{{"kind":"{kind}","{field}":{value}}}"#)
}

/// A wear law with a value at a field.
fn law_with(field: &str, value: f64) -> Value {
    let takes = |law: &WearLawName| {
        let mut numbers = law::definition(*law).numbers();
        numbers.any(|number| number.field == field)
    };
    // Every law takes a frequency of its measurement.
    let taking = WearLawName::ALL.into_iter().find(takes);
    let name = taking.unwrap_or(WearLawName::Archard);
    let example = format!("{{{}}}", law::definition(name).example);
    let mut law: Value = serde_json::from_str(&example).expect("JSON");
    if field == "k_over_h_per_mpa" {
        law = json!({});
    }
    law["law"] = json!(name);
    law[field] = json!(value);
    law
}

/// A specification with a value at a field of an object, and the pointer to it.
fn with(object: &str, field: &str, value: f64) -> (String, String) {
    let (pointer, rest) = match object {
        "Load" => {
            let kind = match field {
                "mpa" => "pressure",
                "n" | "width_mm" => "force",
                _ => "line_force",
            };
            (
                "/load",
                format!(r#""load":{{"kind":"{kind}","{field}":{value}}}"#),
            )
        }
        "Motion" => {
            let kind = match field {
                "distance_mm" | "speed_mm_s" => "continuous",
                "wipe_mm" => "insertion",
                "delta_t_k" | "length_mm" | "expansion_mismatch_per_k" => "thermal_cycle",
                "period_s" | "frequency_hz" => "reciprocating",
                _ => "vibration",
            };
            (
                "/motion",
                format!(r#""motion":{{"kind":"{kind}","{field}":{value}}}"#),
            )
        }
        "PsdPoint" => {
            let other = match field {
                "frequency_hz" => "g2_per_hz",
                _ => "frequency_hz",
            };
            (
                "/motion/psd/0",
                format!(
                    r#""motion":{{"kind":"vibration","psd":[{{"{field}":{value},"{other}":1}}]}}"#
                ),
            )
        }
        "Environment" => (
            "/environment",
            format!(r#""environment":{{"{field}":{value}}}"#),
        ),
        "Friction" => (
            "/interface/friction",
            format!(r#""interface":{{"friction":{{"law":"coulomb","{field}":{value}}}}}"#),
        ),
        "FrictionAtCycle" | "FrictionAtDose" => friction_table(object, field, value),
        "WearLaw" => {
            let law = law_with(field, value);
            (
                "/interface/wear/receptacle",
                format!(r#""interface":{{"wear":{{"receptacle":{law}}}}}"#),
            )
        }
        "PlatingLayer" => (
            "/plating/slider/0",
            format!(r#""plating":{{"slider":[{{"material":"silver","{field}":{value}}}]}}"#),
        ),
        "Spots" => (
            "/interface/spots",
            format!(r#""interface":{{"spots":{{"{field}":{value}}}}}"#),
        ),
        "Film" => (
            "/interface/films/0",
            format!(r#""interface":{{"films":[{{"{field}":{value}}}]}}"#),
        ),
        "LifeSettings" => ("/life", format!(r#""life":{{"{field}":{value}}}"#)),
        "Criterion" => (
            "/life/criteria/0",
            format!(
                r#"{PLATED},"life":{{"criteria":[{}]}}"#,
                criterion(field, value)
            ),
        ),
        "Model" => (
            "/model",
            format!(r#""model":{{"dimension":"point","{field}":{value}}}"#),
        ),
        "Accuracy" => ("/accuracy", format!(r#""accuracy":{{"{field}":{value}}}"#)),
        "Overrides" => (
            "/accuracy/overrides",
            format!(r#""accuracy":{{"overrides":{{"{field}":{value}}}}}"#),
        ),
        "Stop" if field == "worn_depth_mm" => {
            ("/stop/0", format!(r#""stop":[{{"{field}":{value}}}]"#))
        }
        "Stop" => (
            "/stop/0",
            format!(r#"{PLATED},"stop":[{}]"#, criterion(field, value)),
        ),
        "MaterialProperties" => (
            "/materials/slider",
            format!(r#""materials":{{"slider":{{"{field}":{value}}}}}"#),
        ),
        _ => panic!("{object} has no sample"),
    };
    let text = format!(r#"{{"system":{{"kind":"dimm"}},{rest}}}"#);
    (text, format!("{pointer}/{field}"))
}

/// A table of friction with a value at a field of its first point, and the pointer to that point.
fn friction_table(object: &str, field: &str, value: f64) -> (&'static str, String) {
    let (pointer, table, other) = match (object, field) {
        ("FrictionAtCycle", _) => ("/interface/friction/by_cycle/0", "by_cycle", r#""cycle":0"#),
        (_, "coefficient") => (
            "/interface/friction/by_dose/0",
            "by_dose",
            r#""dose_mpa_mm":0"#,
        ),
        _ => (
            "/interface/friction/by_dose/0",
            "by_dose",
            r#""coefficient":0"#,
        ),
    };
    let points = format!(r#"[{{"{field}":{value},{other}}}]"#);
    let text = format!(r#""interface":{{"friction":{{"law":"coulomb","{table}":{points}}}}}"#);
    (pointer, text)
}

#[test]
fn every_range_is_the_one_that_is_enforced() {
    for (object, field, range) in numbers() {
        let outside = |value: f64| {
            let (text, pointer) = with(object, field, value);
            let faults = faults_at(&pointer, &text);
            faults.iter().any(|detail| detail.contains(" is outside "))
        };
        let (from, to) = range.into_inner();
        for (inside, beyond) in [
            (from, from - 1e-3 * from.abs().max(1e-30)),
            (to, 1.001 * to),
        ] {
            assert!(!outside(inside), "{object}.{field} = {inside}");
            assert!(outside(beyond), "{object}.{field} = {beyond}");
        }
    }
}
