//! Which parts keep the platings of their preset.

use api::spec::{Material, Provenance, SystemKind};
use solver::scene::{Scene, WearLaw};
use solver::sides::Side;

use crate::spec::tests::{accepted, faults};

fn scene(kind: &str, rest: &str) -> Scene {
    accepted(&format!(r#"{{"system":{{"kind":"{kind}"}}{rest}}}"#)).scene
}

/// Numbers of layers of slider and receptacle.
fn layers(rest: &str) -> [usize; 2] {
    let scene = scene("sd_card", rest);
    Side::BOTH.map(|side| scene.plating(side).len())
}

/// Specific wear rates of the bases, 1/MPa.
fn bases(kind: &str, rest: &str) -> [Option<f64>; 2] {
    let scene = scene(kind, rest);
    [scene.slider.wear, scene.receptacle.wear].map(|law| law.and_then(WearLaw::uniform))
}

#[test]
fn only_a_given_plating_or_no_wear_at_all_replaces_the_plating_of_a_preset() {
    let layer = r#"{"material":"silver","thickness_um":1}"#;
    let law = r#"{"law":"archard","k_over_h_per_mpa":1e-8}"#;
    for (rest, expected) in [
        (String::new(), [2, 2]),
        (r#","plating":{"slider":[]}"#.to_owned(), [0, 2]),
        (r#","plating":{"receptacle":[]}"#.to_owned(), [2, 0]),
        (format!(r#","plating":{{"receptacle":[{layer}]}}"#), [2, 1]),
        (
            format!(r#","interface":{{"wear":{{"slider":{law}}}}}"#),
            [2, 2],
        ),
        (
            r#","interface":{"wear":{"receptacle":null}}"#.to_owned(),
            [2, 0],
        ),
        (
            r#","interface":{"friction":{"law":"frictionless"}}"#.to_owned(),
            [2, 2],
        ),
        (r#","materials":{"slider":"becu"}"#.to_owned(), [2, 2]),
        (r#","materials":{"receptacle":"brass"}"#.to_owned(), [2, 2]),
        (
            r#","motion":{"kind":"continuous","distance_mm":1}"#.to_owned(),
            [0, 2],
        ),
        (r#","plating":{"slider":null}"#.to_owned(), [2, 2]),
    ] {
        assert_eq!(layers(&rest), expected, "{rest}");
    }
    let plated = format!(
        r#","plating":{{"receptacle":[{layer}]}},"materials":{{"receptacle":"silver"}},"interface":{{"wear":{{"receptacle":{law}}}}}"#
    );
    assert_eq!(layers(&plated), [2, 1]);
}

#[test]
fn a_bare_part_wears_by_the_metal_that_it_consists_of() {
    let copper = Some(0.011 / 427.0);
    let becu = Some(0.004 / 3700.0);
    let removed = r#","plating":{"slider":[],"receptacle":[]}"#;
    assert_eq!(bases("sd_card", ""), [becu, copper]);
    assert_eq!(bases("sd_card", removed), [becu, copper]);
    let named = r#","materials":{"slider":"becu","receptacle":"copper"}"#;
    assert_eq!(bases("sd_card", named), [becu, copper]);
    let bronze = r#","materials":{"slider":"phosphor_bronze"}"#;
    assert_eq!(bases("sd_card", bronze), [Some(0.004 / 1900.0), copper]);
    let own = r#","materials":{"receptacle":{"youngs_modulus_mpa":100000,"poisson_ratio":0.3}}"#;
    assert_eq!(bases("sd_card", own), [becu, Some(0.004 / 1700.0)]);
    // The bench geometry is bare anyway.
    assert_eq!(
        bases("cylinder_on_flat", removed),
        bases("cylinder_on_flat", "")
    );
    assert_eq!(bases("cylinder_on_flat", ""), [None, Some(1e-4 / 6865.0)]);
    let continuous = r#","motion":{"kind":"continuous","distance_mm":1}"#;
    assert_eq!(bases("sd_card", continuous), [None, copper]);
}

#[test]
fn every_value_of_a_preset_plating_has_its_provenance() {
    let spec = accepted(r#"{"system":{"kind":"zif"}}"#).spec;
    let provenance = |pointer: &str| spec.provenance[pointer];
    for (pointer, expected) in [
        ("/plating/slider/0/material/name", Provenance::Assumed),
        (
            "/plating/slider/0/material/hardness_mpa",
            Provenance::Typical,
        ),
        ("/plating/slider/0/thickness_um", Provenance::Typical),
        ("/plating/slider/0/wear/law", Provenance::Assumed),
        ("/plating/slider/0/wear/k", Provenance::Assumed),
        ("/plating/slider/0/wear/hardness_mpa", Provenance::Typical),
        ("/plating/receptacle/1/thickness_um", Provenance::Assumed),
        ("/interface/wear/slider/k", Provenance::Assumed),
        ("/interface/wear/slider/hardness_mpa", Provenance::Typical),
        ("/interface/wear/receptacle/k", Provenance::Source),
    ] {
        assert_eq!(provenance(pointer), expected, "{pointer}");
    }
    let layers = spec.plating.slider.expect("it is plated");
    let names = layers.iter().map(|layer| match &layer.material {
        Some(Material::Given(properties)) => properties.name.clone().unwrap_or_default(),
        _ => String::new(),
    });
    assert_eq!(names.collect::<Vec<_>>(), ["hard_gold", "nickel"]);
}

#[test]
fn a_resolved_specification_is_one_of_the_same_parts() {
    let removed = r#","plating":{"slider":[]},"interface":{"wear":{"slider":null}}"#;
    let continuous = r#","motion":{"kind":"continuous","distance_mm":1}"#;
    for kind in SystemKind::ALL {
        for rest in ["", removed, continuous] {
            let text = format!(r#"{{"system":{{"kind":"{}"}}{rest}}}"#, kind.as_str());
            let first = accepted(&text);
            let written = serde_json::to_string(&first.spec).expect("JSON");
            let second = accepted(&written);
            assert_eq!(second.scene, first.scene, "{kind:?} {rest}");
            assert_eq!(second.spec.plating, first.spec.plating, "{kind:?} {rest}");
            let given = |pointer: &str| second.spec.provenance.get(pointer).copied();
            let layers = first.spec.plating.receptacle.iter().flatten().count();
            for layer in 0..layers {
                let pointer = format!("/plating/receptacle/{layer}/thickness_um");
                assert_eq!(given(&pointer), Some(Provenance::Given));
            }
        }
    }
}

#[test]
fn platings_of_a_slider_that_runs_past_are_refused_where_they_are_given() {
    let found = faults(
        r#"{"system":{"kind":"sd_card"},"motion":{"kind":"continuous","distance_mm":1},
        "plating":{"slider":[{"material":"silver","thickness_um":1}]},"interface":{"wear":{"slider":null}}}"#,
    );
    let [fault] = &found[..] else {
        panic!("one fault: {found:?}");
    };
    assert_eq!(fault.pointer, "/plating/slider");
}

/// The most frequent edits: another spring alloy, another coefficient of the base, another thickness of the gold.
#[test]
fn edits_of_a_plated_part_leave_what_is_above_and_below_it() {
    let preset = scene("sd_card", "");
    let brass = scene("sd_card", r#","materials":{"receptacle":"brass"}"#);
    assert_eq!(brass.receptacle.plating, preset.receptacle.plating);
    assert_ne!(brass.receptacle.elastic, preset.receptacle.elastic);
    let base = scene(
        "sd_card",
        r#","interface":{"wear":{"slider":{"law":"archard","k":0.008}}}"#,
    );
    assert_eq!(base.slider.plating, preset.slider.plating);
    let rate = base.slider.wear.and_then(WearLaw::uniform);
    assert_eq!(rate, Some(0.008 / 3700.0));
    let gold = r#","plating":{"slider":[{"material":"hard_gold","thickness_um":1.5,"wear":{"law":"archard","k":1e-5}}]}"#;
    let thicker = accepted(&format!(r#"{{"system":{{"kind":"sd_card"}}{gold}}}"#));
    assert_eq!(thicker.scene.slider.wear, preset.slider.wear);
    assert_eq!(
        thicker.spec.provenance["/interface/wear/slider/k"],
        Provenance::Assumed
    );
    assert_eq!(thicker.scene.receptacle, preset.receptacle);
}

#[test]
fn a_plan_says_which_plating_is_kept_or_left_out() {
    let warned = |rest: &str| -> Vec<String> {
        let resolved = accepted(&format!(r#"{{"system":{{"kind":"sd_card"}}{rest}}}"#));
        let warnings = resolved.warnings.into_iter();
        warnings
            .filter(|fault| fault.detail.contains("plating of the preset"))
            .map(|fault| fault.pointer)
            .collect()
    };
    assert!(warned("").is_empty());
    let alloy = r#","materials":{"slider":"phosphor_bronze"}"#;
    assert_eq!(warned(alloy), ["/materials/slider"]);
    let law = r#","interface":{"wear":{"receptacle":{"law":"archard","k":1e-3}}}"#;
    assert_eq!(warned(law), ["/interface/wear/receptacle"]);
    let unworn = r#","interface":{"wear":{"slider":null}}"#;
    assert_eq!(warned(unworn), ["/interface/wear/slider"]);
    let bare = r#","plating":{"slider":[]},"interface":{"wear":{"slider":null}}"#;
    assert!(warned(bare).is_empty());
}

/// Fields of an object of the kind that the preset has keep the preset's other values.
#[test]
fn parts_of_an_object_of_the_same_kind_keep_the_others() {
    for (kind, part) in [
        ("sd_card", r#","load":{"kind":"force","n":0.5}"#),
        ("sd_card", r#","load":{"kind":"force","width_mm":0.8}"#),
        ("cylinder_on_flat", r#","load":{"kind":"line_force"}"#),
        ("fuzz_button", r#","load":{"kind":"pressure"}"#),
        (
            "fuzz_button",
            r#","interface":{"friction":{"law":"coulomb"}}"#,
        ),
        (
            "dimm",
            r#","interface":{"wear":{"slider":{"law":"archard"}}}"#,
        ),
        (
            "cylinder_on_flat",
            r#","interface":{"wear":{"receptacle":{"law":"archard","k":1e-4}}}"#,
        ),
        ("zif", r#","motion":{"kind":"reciprocating"}"#),
    ] {
        assert_eq!(scene(kind, part), scene(kind, ""), "{kind}{part}");
    }
    let found = faults(r#"{"system":{"kind":"sd_card"},"load":{"kind":"line_force"}}"#);
    assert_eq!(found[0].pointer, "/load/n_per_mm");
}
