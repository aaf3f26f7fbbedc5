//! Faults of specifications, and warnings of values in another unit.

use api::spec::WearLawName;

use super::*;

#[test]
fn unknown_field_negative_radius_and_unknown_material_are_three_faults() {
    let text = r#"{"frobnicate": true, "system": {"kind": "cylinder_on_flat", "radius_mm": -6},
                   "materials": {"slider": "unobtainium"}}"#;
    let mut found = pointers(text);
    found.sort();
    assert_eq!(
        found,
        ["/frobnicate", "/materials/slider", "/system/radius_mm"]
    );
}

#[test]
fn faults_name_value_and_limit() {
    let found = faults(
        r#"{"system":{"kind":"fuzz_button"},"cycles":0,"interface":{"friction":{"law":"coulomb","coefficient":7}}}"#,
    );
    assert_eq!(found.len(), 2);
    assert!(
        found
            .iter()
            .any(|fault| fault.detail == "7 is outside 0 to 2"),
        "{found:?}"
    );
    assert!(
        found
            .iter()
            .any(|fault| fault.detail == "0 is outside 1 to 1000000000"),
        "{found:?}"
    );
}

#[test]
fn effects_that_are_not_available_yet_are_refused_by_name() {
    let cases = [(r#""effects":{"plasticity":"on"}"#, "/effects/plasticity")];
    for (part, pointer) in cases {
        let found = faults(&format!(r#"{{"system":{{"kind":"fuzz_button"}},{part}}}"#));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].pointer, pointer);
        assert!(found[0].detail.contains("is never simulated"), "{found:?}");
    }
}

#[test]
fn fields_of_other_variants_are_faults() {
    let text = r#"{"system":{"kind":"fuzz_button","radius_mm":1},
        "load":{"kind":"line_force","n_per_mm":1,"mpa":2},
        "motion":{"kind":"reciprocating","speed_mm_s":1,"period_s":1,"frequency_hz":1},
        "interface":{"friction":{"law":"frictionless","coefficient":1},
                     "wear":{"slider":{"law":"archard","k":0.1,"k_over_h_per_mpa":1e-6},"receptacle":{"law":"archard"}}},
        "accuracy":{"preset":"fine","tolerance":0.1},
        "output":{"stations_mm":[9],"snapshots_at_cycles":[5000]},
        "stop":[{}]}"#;
    let expected = [
        "/accuracy/tolerance",
        "/interface/friction/coefficient",
        "/interface/wear/slider/k_over_h_per_mpa",
        "/load/mpa",
        "/motion/period_s",
        "/motion/speed_mm_s",
        "/output/snapshots_at_cycles/0",
        "/output/stations_mm/0",
        "/stop/0",
        "/system/radius_mm",
    ];
    let mut found = pointers(text);
    found.sort();
    assert_eq!(found, expected);
}

#[test]
fn unknown_names_are_reported_with_all_other_faults() {
    let found = pointers(
        r#"{"system":{"kind":"dimm"},"motion":{"kind":"wobbling","drive":"belt"},"load":{"kind":"weight"},
            "interface":{"friction":{"law":"stiction"}},"accuracy":{"preset":"perfect"},"effects":{"magic":"on"}}"#,
    );
    for pointer in [
        "/motion/kind",
        "/motion/drive",
        "/load/kind",
        "/interface/friction/law",
        "/accuracy/preset",
        "/effects/magic",
    ] {
        assert!(
            found.iter().any(|found| found == pointer),
            "{pointer} in {found:?}"
        );
    }
    assert_eq!(
        pointers(r#"{"system":{"kind":"toaster"},"x":1}"#),
        ["/x", "/system/kind"]
    );
}

#[test]
fn long_lists_and_fine_meshes_are_refused_before_meshing() {
    let stations = vec!["0"; 5000].join(",");
    let text = format!(
        r#"{{"system":{{"kind":"fuzz_button"}},"output":{{"stations_mm":[{stations}]}},
            "accuracy":{{"overrides":{{"contact_element_mm":1e-9,"increments_per_cycle":1,"cycle_jump":"often"}}}}}}"#
    );
    assert_eq!(
        pointers(&text),
        [
            "/accuracy/overrides/contact_element_mm",
            "/accuracy/overrides/increments_per_cycle",
            "/accuracy/overrides/cycle_jump",
            "/output/stations_mm"
        ]
    );
}

#[test]
fn a_continuous_motion_refuses_the_fields_of_a_reciprocating_one() {
    let spec = r#"{"system":{"kind":"cylinder_on_flat"}, "cycles": 5,
        "interface":{"wear":{"slider":{"law":"archard","k_over_h_per_mpa":1e-8}}},
        "motion":{"kind":"continuous","period_s":1},
        "output":{"snapshots_at_cycles":[1]}}"#;
    let Err(super::Refused::Faults(faults)) = read(spec.as_bytes()) else {
        panic!("it has faults")
    };
    let mut pointers: Vec<&str> = faults.iter().map(|fault| fault.pointer.as_str()).collect();
    pointers.sort_unstable();
    let expected = [
        "/cycles",
        "/interface/wear/slider",
        "/motion/distance_mm",
        "/motion/period_s",
        "/output/snapshots_at_cycles",
    ];
    assert_eq!(pointers, expected);
}

#[test]
fn one_wrong_type_does_not_hide_the_other_faults() {
    let text = r#"{"system":{"kind":"fuzz_button","wire_diameter_mm":"big","pcb_length_mm":-1},
        "materials":{"slider":"coper"},"motion":{"kind":"reciprocating","amplitude_mm":[],"amplitude_um":3},
        "cycels":5,"output":{"stations_mm":[0,"a"]},"labels":{"a/b":7}}"#;
    let Err(Refused::Parse(error)) = read(text.as_bytes()) else {
        panic!("it has values of wrong types");
    };
    assert_eq!(error.pointer, "/system/wire_diameter_mm");
    let found: Vec<_> = error.others.iter().map(|f| f.pointer.as_str()).collect();
    let expected = [
        "/motion/amplitude_mm",
        "/output/stations_mm/1",
        "/labels/a~1b",
        "/motion/amplitude_um",
        "/cycels",
        "/system/pcb_length_mm",
        "/materials/slider",
    ];
    for pointer in expected {
        assert!(found.contains(&pointer), "{pointer}: {found:?}");
    }
    assert_eq!(found.len(), expected.len(), "{found:?}");
}

#[test]
fn mistyped_names_are_answered_with_a_suggestion() {
    for (text, words) in [
        (
            r#"{"system":{"kind":"fuzzbutton"}}"#,
            "did you mean `fuzz_button`?",
        ),
        (
            r#"{"system":{"kind":"dimm"},"cycels":5}"#,
            "unknown field `cycels`; did you mean `cycles`?",
        ),
        (
            r#"{"system":{"kind":"dimm"},"motion":{"kind":"reciprocating","amplitude_um":5}}"#,
            "did you mean `amplitude_mm`?",
        ),
        (
            r#"{"system":{"kind":"dimm"},"materials":{"slider":"coper"}}"#,
            "did you mean `copper`?",
        ),
        (
            r#"{"system":{"kind":"dimm"},"effects":{"frictoin":"on"}}"#,
            "did you mean `friction`?",
        ),
    ] {
        let found = faults(text);
        assert!(
            found.iter().any(|fault| fault.detail.contains(words)),
            "{found:?}"
        );
    }
}

#[test]
fn a_value_in_another_unit_is_accepted_with_a_warning() {
    // Warnings of a law's range are not about units.
    let of_units = |resolved: &Resolved| {
        let mut warnings = resolved.warnings.clone();
        warnings.retain(|warning| warning.detail.contains("was it meant"));
        warnings
    };
    let resolved = accepted(r#"{"system":{"kind":"fuzz_button","wire_diameter_mm":50.8}}"#);
    let warnings = &of_units(&resolved);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert_eq!(warnings[0].pointer, "/system/wire_diameter_mm");
    assert!(warnings[0].detail.contains("in um?"), "{warnings:?}");
    let plan = Estimate::of(&resolved).plan(&resolved, None);
    let planned = &plan.warnings[0];
    assert_eq!(
        (&planned.field, &planned.detail),
        (&warnings[0].pointer, &warnings[0].detail)
    );
    for kind in SystemKind::ALL {
        let resolved = accepted(&format!(r#"{{"system":{{"kind":"{}"}}}}"#, kind.as_str()));
        assert_eq!(of_units(&resolved), []);
        let again = serde_json::to_string(&resolved.spec).expect("writable");
        assert_eq!(of_units(&accepted(&again)), []);
    }
    assert_eq!(of_units(&accepted(FUZZ_BUTTON)), []);
}

#[test]
fn a_refusal_names_values_in_another_unit_too() {
    let text = r#"{"system":{"kind":"fuzz_button"},
        "materials":{"slider":{"youngs_modulus_mpa":117,"poisson_ratio":0.34}}}"#;
    let found = pointers(text);
    assert!(
        found.iter().any(|pointer| pointer == "/materials"),
        "{found:?}"
    );
    let unit = found
        .iter()
        .any(|pointer| pointer == "/materials/slider/youngs_modulus_mpa");
    assert!(unit, "{found:?}");
}

#[test]
fn a_fault_of_the_whole_scene_names_the_field_that_causes_it() {
    for (fields, pointer) in [
        (
            r#""system":{"kind":"cylinder_on_flat"},"load":{"kind":"line_force","n_per_mm":1e-7}"#,
            "/load",
        ),
        (
            r#""system":{"kind":"cylinder_on_flat","radius_mm":0.001}"#,
            "/system/radius_mm",
        ),
        (
            r#""system":{"kind":"fuzz_button"},"materials":{"slider":{"youngs_modulus_mpa":900,"poisson_ratio":0.3}}"#,
            "/materials",
        ),
        (
            r#""system":{"kind":"fuzz_button"},"load":{"kind":"pressure","mpa":50}"#,
            "/load",
        ),
        (
            r#""system":{"kind":"sd_card"},"model":{"dimension":"point","radius_z_mm":0.005}"#,
            "/model/radius_z_mm",
        ),
        (
            r#""system":{"kind":"sd_card"},"model":{"dimension":"extruded","width_mm":0.002}"#,
            "/model/width_mm",
        ),
        (
            r#""system":{"kind":"sd_card"},"model":{"dimension":"line","width_mm":0.8,"crown_radius_mm":0.01}"#,
            "/model/crown_radius_mm",
        ),
        // Without its radius the wire is too thick for the ring, without its diameter the ring is not known.
        (
            r#""system":{"kind":"sd_card","contact_radius_mm":0.02},"motion":{"kind":"reciprocating","amplitude_mm":0.01},
            "model":{"dimension":"ring","outer_diameter_mm":0.085}"#,
            "/model/outer_diameter_mm",
        ),
        (
            r#""system":{"kind":"sd_card"},"load":{"kind":"force","n":60},"motion":{"kind":"reciprocating","amplitude_mm":0.1},
            "model":{"dimension":"extruded","width_mm":0.2}"#,
            "/load",
        ),
    ] {
        let Err(Refused::Faults(found)) = read(format!("{{{fields}}}").as_bytes()) else {
            panic!("{pointer}");
        };
        assert_eq!(found[0].pointer, pointer, "{found:?}");
    }
}

/// Faults of a receptacle whose law has these fields alone.
fn faults_of_law(law: WearLawName, fields: &str) -> Vec<Fault> {
    let name = law.as_str();
    let text = format!(
        r#"{{"system":{{"kind":"cylinder_on_flat"}},"materials":{{"receptacle":{{"youngs_modulus_mpa":1e5,"poisson_ratio":0.3}}}},
        "interface":{{"wear":{{"slider":null,"receptacle":{{"law":"{name}"{fields}}}}}}}}}"#
    );
    match read(text.as_bytes()) {
        Err(Refused::Faults(faults)) => faults,
        Err(Refused::Parse(error)) => panic!("{error}"),
        Ok(_) => Vec::new(),
    }
}

#[test]
fn faults_of_a_law_ask_for_fields_that_it_takes() {
    let mut asked = 0;
    for law in WearLawName::ALL {
        let lacking = faults_of_law(law, "");
        let details: String = lacking.iter().map(|fault| fault.detail.as_str()).collect();
        for (field, range) in law::numbers() {
            if !details.contains(&format!("`{field}`")) {
                continue;
            }
            asked += 1;
            let given = format!(r#","{field}":{}"#, range.end());
            let refused = faults_of_law(law, &given);
            let foreign = |fault: &Fault| fault.detail.contains("does not belong to");
            assert!(!refused.iter().any(foreign), "{law:?}: {refused:?}");
        }
    }
    assert!(asked >= 10, "{asked} fields");
}
