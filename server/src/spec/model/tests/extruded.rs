//! Bodies of a width, and the source's models.

use api::spec::Provenance;
use solver::scene::{Dimension, Ends, LineShape};

use super::{accepted, pointers};

/// The source's extruded half of a wire: its width and layers are the source's, its ends are assumed.
#[test]
fn presets_of_the_source_have_their_provenance() {
    let text = r#"{"system":{"kind":"fuzz_button"},"model":{"preset":"source_extruded"}}"#;
    let found = accepted(text);
    let provenance = |pointer| found.spec.provenance.get(pointer).copied();
    for (pointer, expected) in [
        ("/model/dimension", Provenance::Source),
        ("/model/width_mm", Provenance::Source),
        ("/model/layers", Provenance::Source),
        ("/model/ends", Provenance::Assumed),
        ("/model/layer_growth", Provenance::Assumed),
    ] {
        assert_eq!(provenance(pointer), Some(expected), "{pointer}");
    }
    let Dimension::Extruded(own) = found.scene.dimension else {
        panic!("{:?}", found.scene.dimension);
    };
    assert_eq!(
        (own.width_mm, own.layers, own.ends),
        (0.010_58, 2, Ends::Free)
    );
    assert!((found.scene.load_n_per_mm - 0.508).abs() < 1e-12);
    let again = accepted(&serde_json::to_string(&found.spec).expect("JSON"));
    assert_eq!(again.scene, found.scene);
    let ring = accepted(r#"{"system":{"kind":"fuzz_button"},"model":{"preset":"source_ring"}}"#);
    let Dimension::Line(line) = ring.scene.dimension else {
        panic!("{:?}", ring.scene.dimension);
    };
    assert!(matches!(line.shape, LineShape::Ring { .. }));
    let again = accepted(&serde_json::to_string(&ring.spec).expect("JSON"));
    assert_eq!(again.scene, ring.scene);
}

/// A force and its spring are those of the whole width.
#[test]
fn a_width_shares_its_force_and_its_spring() {
    let text = r#"{"system":{"kind":"sd_card"},"model":{"dimension":"extruded","width_mm":0.8,"layers":4,"ends":"held"},
        "load":{"kind":"force","n":0.5,"spring_n_per_mm":2.0}}"#;
    let scene = accepted(text).scene;
    assert!((scene.load_n_per_mm - 0.625).abs() < 1e-15);
    assert!((scene.spring_n_per_mm2 - 2.5).abs() < 1e-15);
    let own = scene.dimension.extruded().expect("it is extruded");
    assert_eq!((own.layers, own.ends), (4, Ends::Held));
}

#[test]
fn fields_that_mean_nothing_of_extruded_bodies_are_refused() {
    let extruded = |own: &str, rest: &str| {
        format!(
            r#"{{"system":{{"kind":"fuzz_button"}},"model":{{"dimension":"extruded"{own}}}{rest}}}"#
        )
    };
    for (text, expected) in [
        (extruded(r#","layers":3"#, ""), "/model/layers"),
        (extruded(r#","layers":0"#, ""), "/model/layers"),
        // Beyond what the engine condenses.
        (extruded(r#","layers":200"#, ""), "/model/layers"),
        (
            extruded(r#","layer_growth":0.5"#, ""),
            "/model/layer_growth",
        ),
        (extruded(r#","width_mm":0"#, ""), "/model/width_mm"),
        (extruded(r#","ends":"glued""#, ""), "/model/ends"),
        (extruded(r#","top":"rigid""#, ""), "/model/top"),
        (
            extruded(r#","crown_radius_mm":1"#, ""),
            "/model/crown_radius_mm",
        ),
        (
            extruded(r#","preset":"source_ring""#, ""),
            "/model/dimension",
        ),
        (extruded(r#","preset":"source""#, ""), "/model/preset"),
        (
            extruded(
                "",
                r#","motion":{"kind":"reciprocating","amplitude_mm":1e-6}"#,
            ),
            "/motion",
        ),
        (
            extruded(
                "",
                r#","motion":{"kind":"reciprocating","amplitude_mm":0.06}"#,
            ),
            "/motion",
        ),
        (
            extruded("", r#","load":{"kind":"force","n":1,"width_mm":3}"#),
            "/load/width_mm",
        ),
        (
            extruded("", r#","accuracy":{"overrides":{"stations":5}}"#),
            "/accuracy/overrides/stations",
        ),
        (
            r#"{"system":{"kind":"sd_card"},"model":{"dimension":"extruded"}}"#.to_owned(),
            "/model/width_mm",
        ),
        (
            r#"{"system":{"kind":"sd_card"},"model":{"preset":"source_extruded","width_mm":1}}"#
                .to_owned(),
            "/model/preset",
        ),
        (
            r#"{"system":{"kind":"fuzz_button"},"model":{"layers":2}}"#.to_owned(),
            "/model/layers",
        ),
    ] {
        let found = pointers(&text);
        assert!(
            found.iter().any(|pointer| pointer == expected),
            "{text}: {found:?}"
        );
    }
}
