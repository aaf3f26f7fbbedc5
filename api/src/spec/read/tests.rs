//! Pointers of faults in parsing.

use serde_json::{Value, json};

use super::*;
use crate::spec::{CycleJump, Material, SystemKind};

fn unknown(text: &str) -> Vec<String> {
    let (_, faults) = Spec::read(text.as_bytes()).expect("readable");
    faults.into_iter().map(|fault| fault.pointer).collect()
}

fn refused(text: &str) -> ParseError {
    Spec::read(text.as_bytes()).expect_err("not readable")
}

#[test]
fn only_the_kind_is_required() {
    let (spec, faults) = Spec::read(br#"{"system":{"kind":"sd_card"}}"#).expect("readable");
    assert!(faults.is_empty());
    assert_eq!(spec.system.kind.known(), Some(SystemKind::SdCard));
    assert_eq!(refused("{}").detail, "missing field `system`");
    assert_eq!(refused(r#"{"system":{}}"#).pointer, "/system");
}

#[test]
fn unknown_fields_are_all_listed_wherever_they_are() {
    let text = r#"{
        "frobnicate": 1,
        "system": {"kind": "dimm", "colour": "red"},
        "materials": {"slider": {"youngs_modulus_mpa": 1, "poisson_ratio": 0.3, "smell": {}}, "lid": "copper"},
        "interface": {"friction": {"law": "coulomb", "coefficient": 1, "x": 0},
                      "wear": {"slider": {"law": "archard", "kk": 1}, "lid": null}},
        "load": {"kind": "pressure", "mpa": 1, "psi": 3},
        "motion": {"kind": "reciprocating", "jitter": 1},
        "accuracy": {"overrides": {"mesh": 1}},
        "output": {"plots/x~y": true},
        "stop": [{"worn_depth_mm": 1}, {"hours": 3}]
    }"#;
    let expected = [
        "/frobnicate",
        "/system/colour",
        "/materials/slider/smell",
        "/materials/lid",
        "/interface/friction/x",
        "/interface/wear/slider/kk",
        "/interface/wear/lid",
        "/load/psi",
        "/motion/jitter",
        "/accuracy/overrides/mesh",
        "/output/plots~1x~0y",
        "/stop/1/hours",
    ];
    assert_eq!(unknown(text), expected);
}

#[test]
fn wrong_types_name_their_pointer() {
    let cases = [
        (
            r#"{"system":{"kind":"dimm","contact_radius_mm":"big"}}"#,
            "/system/contact_radius_mm",
        ),
        (r#"{"system":{"kind":7}}"#, "/system/kind"),
        (
            r#"{"system":{"kind":"dimm"},"materials":{"slider":3}}"#,
            "/materials/slider",
        ),
        (
            r#"{"system":{"kind":"dimm"},"materials":{"slider":{"poisson_ratio":[]}}}"#,
            "/materials/slider/poisson_ratio",
        ),
        (
            r#"{"system":{"kind":"dimm"},"interface":{"wear":{"slider":{"law":"archard","k":{}}}}}"#,
            "/interface/wear/slider/k",
        ),
        (
            r#"{"system":{"kind":"dimm"},"output":{"stations_mm":[0, "a"]}}"#,
            "/output/stations_mm/1",
        ),
        (r#"{"system":{"kind":"dimm"},"cycles":-3}"#, "/cycles"),
        (
            r#"{"system":{"kind":"dimm"},"accuracy":{"overrides":{"cycle_jump":1.5}}}"#,
            "/accuracy/overrides/cycle_jump",
        ),
    ];
    for (text, pointer) in cases {
        assert_eq!(refused(text).pointer, pointer, "{text}");
    }
}

#[test]
fn counts_may_be_written_as_numbers_without_a_fraction() {
    let text = r#"{"system":{"kind":"dimm"},"cycles":1e9,
        "accuracy":{"overrides":{"cycle_jump":2.0,"increments_per_cycle":4e1}},
        "output":{"snapshots_at_cycles":[1, 1e3]}}"#;
    let (spec, _) = Spec::read(text.as_bytes()).expect("readable");
    assert_eq!(spec.cycles, Some(1_000_000_000));
    let overrides = spec.accuracy.overrides.expect("given");
    assert_eq!(overrides.increments_per_cycle, Some(40));
    assert_eq!(overrides.cycle_jump, Some(CycleJump::Fixed(2)));
    assert_eq!(spec.output.snapshots_at_cycles, Some(vec![1, 1000]));
    for cycles in ["1.5", "-1.0", "1e300", "\"7\"", "true"] {
        let text = format!(r#"{{"system":{{"kind":"dimm"}},"cycles":{cycles}}}"#);
        assert_eq!(refused(&text).pointer, "/cycles", "{cycles}");
    }
    let text = r#"{"system":{"kind":"dimm"},"output":{"snapshots_at_cycles":[1, 1.5]}}"#;
    assert_eq!(refused(text).pointer, "/output/snapshots_at_cycles/1");
    let text =
        r#"{"system":{"kind":"dimm"},"accuracy":{"overrides":{"increments_per_cycle":1e10}}}"#;
    assert!(refused(text).detail.contains("a smaller count"));
}

#[test]
fn malformed_json_names_line_and_column() {
    let error = refused("{\"system\": {\"kind\": \"dimm\"},\n \"cycles\": NaN}");
    assert_eq!((error.line, error.pointer.as_str()), (2, ""));
    assert!(error.column > 1, "{error}");
    assert_eq!(refused("{\"system\"").line, 1);
    assert!(
        refused(r#"{"system":{"kind":"dimm"}} x"#)
            .detail
            .contains("trailing")
    );
    assert!(
        refused(r#"{"system":{"kind":"dimm","contact_radius_mm":1e400}}"#)
            .detail
            .contains("out of range")
    );
    assert!(
        refused(r#"{"system":{"kind":"dimm"},"cycles":1,"cycles":2}"#)
            .detail
            .contains("duplicate field")
    );
    assert!(refused(&"[".repeat(100_000)).line == 1);
    let nested = format!(r#"{{"labels":{}"#, r#"{"a":"#.repeat(10_000));
    assert_eq!(refused(&nested).line, 1);
}

#[test]
fn unknown_names_are_no_parse_errors() {
    let (spec, faults) =
        Spec::read(br#"{"system":{"kind":"toaster"},"materials":{"slider":"cheese"}}"#)
            .expect("readable");
    assert!(faults.is_empty());
    assert_eq!(spec.system.kind.known(), None);
    assert_eq!(
        spec.materials.slider,
        Some(Material::Named("cheese".into()))
    );
}

#[test]
fn null_wear_differs_from_absent_wear() {
    let (spec, _) =
        Spec::read(br#"{"system":{"kind":"dimm"},"interface":{"wear":{"slider":null}}}"#)
            .expect("readable");
    assert_eq!(spec.interface.wear.slider, Some(None));
    assert_eq!(spec.interface.wear.receptacle, None);
    let written = serde_json::to_string(&spec).expect("writable");
    assert!(written.contains(r#""wear":{"slider":null}"#), "{written}");
    let (again, _) = Spec::read(written.as_bytes()).expect("readable");
    assert_eq!(again, spec);
}

#[test]
fn a_duplicate_key_in_a_map_is_refused() {
    for (text, pointer, key) in [
        (
            r#"{"system":{"kind":"dimm"},"labels":{"a":"1","b":"2","a":"3"}}"#,
            "/labels",
            "a",
        ),
        (
            r#"{"system":{"kind":"dimm"},"effects":{"friction":"on","friction":"off"}}"#,
            "/effects",
            "friction",
        ),
    ] {
        let error = Spec::read(text.as_bytes()).expect_err("refused");
        assert!(error.pointer.starts_with(pointer), "{error}");
        assert_eq!(error.detail, format!("duplicate key `{key}`"));
    }
}

#[test]
fn a_document_that_is_no_object_is_named() {
    for (text, found, position) in [
        ("", "nothing", (1, 1)),
        (" \n\t\n", "nothing", (3, 1)),
        ("[]", "a list", (1, 1)),
        ("\n  [{\"system\": {}}]", "a list", (2, 3)),
        ("null", "null", (1, 1)),
        ("0.5", "a number", (1, 1)),
        ("\"sd_card\"", "a text", (1, 1)),
        (
            "system:\n  kind: dimm\n",
            "`system:`; a document in another language",
            (1, 1),
        ),
        (
            "[system]\nkind = \"dimm\"\n",
            "`[system]`; a document in another language",
            (1, 1),
        ),
        ("---\nsystem: {}", "`---`; a document", (1, 1)),
    ] {
        let error = refused(text);
        let expected = format!(
            "expected an object such as {{\"system\": {{\"kind\": \"sd_card\"}}}}, found {found}"
        );
        assert!(error.detail.starts_with(&expected), "{text}: {error}");
        assert_eq!((error.line, error.column), position, "{text}");
        assert_eq!(error.pointer, "", "{text}");
    }
    let long = refused(&"ä".repeat(10_000));
    assert!(long.detail.len() < 400, "{long}");
}

#[test]
fn a_wrong_type_says_what_is_expected_and_how_a_number_is_written() {
    let alone = "; write the number alone, in the unit of the field's name";
    let bare = "; write the number without quotation marks";
    for (fields, expected) in [
        (
            r#""load":{"kind":"force","n":"0.5 N"}"#,
            format!(r#"(/load/n): expected a number, found the text "0.5 N"{alone}"#),
        ),
        (
            r#""load":{"kind":"force","n":"-5e-1"}"#,
            format!(r#"(/load/n): expected a number, found the text "-5e-1"{bare}"#),
        ),
        (
            r#""load":{"kind":"force","n":"some"}"#,
            r#"(/load/n): expected a number, found the text "some""#.to_owned(),
        ),
        (
            r#""load":{"kind":"force","n":", expected f64"}"#,
            r#"(/load/n): expected a number, found the text ", expected f64""#.to_owned(),
        ),
        (
            r#""cycles":"2000 cycles""#,
            format!(r#"(/cycles): expected a count, found the text "2000 cycles"{alone}"#),
        ),
        (
            r#""cycles":1.5"#,
            "(/cycles): expected a count, found the number 1.5".to_owned(),
        ),
        (
            r#""cycles":true"#,
            "(/cycles): expected a count, found true".to_owned(),
        ),
        (
            r#""name":7"#,
            "(/name): expected a text, found the number 7".to_owned(),
        ),
        (
            r#""stop":{}"#,
            "(/stop): expected a list, found an object".to_owned(),
        ),
        (
            r#""load":"0.5 N""#,
            r#"(/load): expected an object, found the text "0.5 N""#.to_owned(),
        ),
        (
            r#""labels":null"#,
            "(/labels): expected an object, found null".to_owned(),
        ),
    ] {
        let error =
            refused(&format!("{{\"system\":{{\"kind\":\"dimm\"}},\n{fields}}}")).to_string();
        assert!(
            error.starts_with("line 2, column ") && error.contains(&expected),
            "{error}"
        );
    }
}

/// Every object of a document that is read as a structure, by its pointer: all but maps, whose keys are free.
fn structures(value: &Value, pointer: &str, found: &mut Vec<String>) {
    const MAPS: [&str; 3] = ["/labels", "/effects", "/provenance"];
    match value {
        Value::Object(fields) => {
            if !MAPS.contains(&pointer) {
                found.push(pointer.to_owned());
            }
            for (name, field) in fields {
                structures(field, &format!("{pointer}/{name}"), found);
            }
        }
        Value::Array(entries) => {
            for (index, entry) in entries.iter().enumerate() {
                structures(entry, &format!("{pointer}/{index}"), found);
            }
        }
        _ => {}
    }
}

#[test]
fn an_array_of_fields_is_no_object_wherever_it_is() {
    let document = json!({
        "system": {"kind": "fuzz_button"},
        "model": {"dimension": "ring"},
        "materials": {"slider": {"youngs_modulus_mpa": 1.0, "poisson_ratio": 0.3}},
        "interface": {
            "friction": {"law": "coulomb", "coefficient": 0.9},
            "wear": {"slider": {"law": "archard", "k": 1e-4}, "receptacle": {"law": "archard", "k": 1e-4}},
        },
        "plating": {"slider": [{"material": "hard_gold", "thickness_um": 0.76, "wear": {"law": "archard", "k": 1e-4}}]},
        "load": {"kind": "force", "n": 0.5},
        "environment": {"temperature_c": 20.0},
        "motion": {"kind": "vibration", "psd": [{"frequency_hz": 10.0, "g2_per_hz": 0.01}]},
        "mission": [{"name": "a", "motion": {"kind": "fourier", "terms": [{"order": 1, "sine_mm": 0.1}]}}],
        "accuracy": {"overrides": {"cycle_jump": 3}},
        "output": {"fields": true},
        "stop": [{"worn_depth_mm": 0.1}],
        "life": {"criteria": [{"kind": "base_metal"}]},
        "labels": {"lot": "7"},
    });
    let mut pointers = Vec::new();
    structures(&document, "", &mut pointers);
    assert!(pointers.len() > 25, "{pointers:?}");
    let (_, unknown) = Spec::read(document.to_string().as_bytes()).expect("readable");
    assert_eq!(unknown, []);
    for pointer in pointers {
        for is_empty in [false, true] {
            let mut positional = document.clone();
            let place = positional.pointer_mut(&pointer).expect("it is there");
            let fields = place.as_object().expect("an object").values().cloned();
            *place = fields.filter(|_| !is_empty).collect();
            let error = refused(&positional.to_string());
            assert_eq!(error.pointer, pointer, "{positional}");
            assert!(error.detail.contains("found a list"), "{error}");
        }
    }
    // Maps and lists are what they are.
    assert_eq!(
        refused(r#"{"system":{"kind":"dimm"},"labels":[]}"#).pointer,
        "/labels"
    );
    assert_eq!(
        refused(r#"{"system":{"kind":"dimm"},"stop":{}}"#).pointer,
        "/stop"
    );
}
