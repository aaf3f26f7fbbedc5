//! Layers, their laws and their faults.

use crate::spec::tests::{accepted as resolved, faults};

const GOLD: &str =
    r#"{"material":"hard_gold","thickness_um":0.76,"wear":{"law":"archard","k":1e-4}}"#;

fn plated(layers: &str, base: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[{layers}]}},"interface":{{"wear":{{{base}}}}}}}"#
    )
}

#[test]
fn layers_take_their_hardness_from_their_material_and_their_law_from_the_library() {
    let silver = r#"{"material":"silver","thickness_mm":0.002}"#;
    let resolved = resolved(&plated(&format!("{GOLD},{silver}"), ""));
    let [gold, silver] = &resolved.scene.receptacle.plating[..] else {
        panic!("two layers");
    };
    assert!((gold.thickness_mm - 0.76e-3).abs() < 1e-18);
    assert!((gold.rate_per_mpa - 1e-4 / 1_700.0).abs() < 1e-20);
    assert!((silver.rate_per_mpa - 0.004 / 250.0).abs() < 1e-18);
    // The base below is copper, of which the library lists a coefficient, and not the preset's gold.
    let base = resolved
        .scene
        .receptacle
        .wear
        .and_then(solver::scene::WearLaw::uniform);
    assert!(
        base.is_some_and(|rate| (rate - 0.011 / 427.0).abs() < 1e-18),
        "{base:?}"
    );
    // Submitted again, the resolved specification is the same.
    let again = serde_json::to_string(&resolved.spec).expect("JSON");
    assert_eq!(crate::spec::tests::accepted(&again).scene, resolved.scene);
}

#[test]
fn what_nobody_has_published_is_asked_for_by_name() {
    let pointers = |text: &str| -> Vec<String> {
        let found = faults(text).into_iter();
        found.map(|fault| fault.pointer).collect()
    };
    let bare = r#"{"material":"hard_gold"}"#;
    assert_eq!(
        pointers(&plated(bare, "")),
        [
            "/plating/receptacle/0/thickness_um",
            "/plating/receptacle/0/wear"
        ]
    );
    let both = r#"{"thickness_um":1.0,"thickness_mm":0.001}"#;
    assert_eq!(
        pointers(&plated(both, "")),
        [
            "/plating/receptacle/0/thickness_mm",
            "/plating/receptacle/0/material",
            "/plating/receptacle/0/wear"
        ]
    );
    let hard = r#"{"material":"silver","thickness_um":1.0,"wear":{"law":"archard","k":0}}"#;
    assert_eq!(pointers(&plated(hard, "")), ["/plating/receptacle/0/wear"]);
    let unworn = format!(
        r#"{{"system":{{"kind":"sd_card"}},"plating":{{"slider":[{GOLD}]}},"interface":{{"wear":{{"slider":null}}}}}}"#
    );
    assert_eq!(resolved(&unworn).scene.slider.wear, None);
    let many = [GOLD; 9].join(",");
    assert_eq!(pointers(&plated(&many, "")), ["/plating/receptacle"]);
}

#[test]
fn a_layer_in_another_unit_is_questioned() {
    let in_mm = GOLD.replace(r#""thickness_um":0.76"#, r#""thickness_mm":1.27"#);
    let [fault] = &faults(&plated(&in_mm, ""))[..] else {
        panic!("one fault");
    };
    assert_eq!(fault.pointer, "/plating/receptacle/0/thickness_mm");
    assert!(fault.detail.contains("in um?"), "{}", fault.detail);
    let thick = GOLD.replace("0.76", "760");
    let resolved = resolved(&plated(&thick, ""));
    let warning = &resolved.warnings[0];
    assert_eq!(warning.pointer, "/plating/receptacle/0/thickness_um");
    assert!(warning.detail.contains("in nm?"), "{}", warning.detail);
}

#[test]
fn laws_of_friction_take_the_coefficient_of_the_contact() {
    let rate = |law: &str| {
        let base = format!(r#""receptacle":{law}"#);
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},
            "interface":{{"friction":{{"law":"coulomb","coefficient":0.6}},"wear":{{{base}}}}}}}"#
        );
        resolved(&text)
            .scene
            .receptacle
            .outer_rate()
            .expect("a uniform rate")
    };
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    let k = r#""k":1e-4,"hardness_mpa":1700"#;
    let archard = 1e-4 / 1_700.0;
    assert!(near(rate(&format!(r#"{{"law":"archard",{k}}}"#)), archard));
    let sarkar = rate(&format!(r#"{{"law":"sarkar",{k}}}"#));
    assert!(near(sarkar, archard * 2.08_f64.sqrt()), "{sarkar}");
    let saracibar = rate(&format!(
        r#"{{"law":"saracibar",{k},"reference_friction":0.3}}"#
    ));
    assert!(near(saracibar, 2.0 * archard), "{saracibar}");
    let energy = rate(r#"{"law":"dissipated_energy","energy_coefficient_mm3_per_j":4.23e-5}"#);
    assert!(near(energy, 4.23e-8 * 0.6), "{energy}");
}

#[test]
fn laws_name_the_field_that_they_lack_or_do_not_have() {
    let fault = |law: &str| {
        let text = plated("", &format!(r#""receptacle":{law}"#));
        faults(&text)
            .into_iter()
            .map(|fault| fault.pointer)
            .collect::<Vec<_>>()
    };
    let at = |field: &str| vec![format!("/interface/wear/receptacle/{field}")];
    assert_eq!(
        fault(r#"{"law":"saracibar","k":1e-4}"#),
        at("reference_friction")
    );
    assert_eq!(
        fault(r#"{"law":"dissipated_energy"}"#),
        at("energy_coefficient_mm3_per_j")
    );
    let foreign = r#"{"law":"archard","k":1e-4,"reference_friction":0.3}"#;
    assert_eq!(fault(foreign), at("reference_friction"));
    let foreign = r#"{"law":"dissipated_energy","energy_coefficient_mm3_per_j":1e-5,"k":1e-4}"#;
    assert_eq!(fault(foreign), at("k"));
}
