//! Criteria of specifications, accepted and refused.

use solver::scene::Criterion;
use solver::sides::Side;

use crate::spec::tests::{accepted as resolved, faults};

/// An SD card with two layers on the pad and one on the tip.
fn plated(rest: &str) -> String {
    let layer = |um: f64| format!(r#"{{"material":"silver","thickness_um":{um}}}"#);
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"interface":{{"wear":{{"slider":null}}}},"plating":{{"slider":[{}],"receptacle":[{},{}]}}{rest}}}"#,
        layer(1.0),
        layer(2.0),
        layer(3.0)
    )
}

#[test]
fn the_first_exposure_of_every_layer_ends_a_life_by_default() {
    let resolved = resolved(&plated(""));
    let expected = [
        Criterion::deepest(Side::Slider, 1e-3),
        Criterion::deepest(Side::Receptacle, 2e-3),
        Criterion::deepest(Side::Receptacle, 5e-3),
    ];
    assert_eq!(resolved.scene.life.len(), 3);
    for (found, expected) in resolved.scene.life.iter().zip(expected) {
        assert!(
            found.side == expected.side && found.part <= 0.0,
            "{found:?}"
        );
        assert!(
            (found.depth_mm - expected.depth_mm).abs() < 1e-15,
            "{found:?}"
        );
    }
}

#[test]
fn a_criterion_without_a_side_is_about_each_plated_one() {
    let rest = r#","stop":[{"kind":"base_metal"}],"life":{"criteria":[{"kind":"exposed_fraction","fraction":0.5},
        {"kind":"exposed_fraction","fraction":0.1,"layer":2,"side":"receptacle"},{"kind":"resistance","mohm":10}]}"#;
    let resolved = resolved(&plated(rest));
    assert_eq!(resolved.scene.stop.len(), 2);
    let exposed = |side, part, depth_mm| Criterion {
        part,
        ..Criterion::deepest(side, depth_mm)
    };
    assert_eq!(
        resolved.scene.life,
        [
            exposed(Side::Slider, 0.5, 1e-3),
            exposed(Side::Receptacle, 0.5, 5e-3),
            exposed(Side::Receptacle, 0.1, 2e-3)
        ]
    );
    // The resistance, which is not modelled, keeps its place.
    assert_eq!(
        resolved.spec.life.criteria.map(|criteria| criteria.len()),
        Some(4)
    );
}

#[test]
fn a_layer_that_one_side_has_needs_no_side() {
    let rest = r#","stop":[{"kind":"first_exposure","layer":2}]"#;
    let resolved = resolved(&plated(rest));
    assert_eq!(
        resolved.scene.stop,
        [Criterion::deepest(Side::Receptacle, 2e-3)]
    );
}

#[test]
fn criteria_that_cannot_be_reached_are_refused_by_their_field() {
    let pointers = |text: &str| -> Vec<String> {
        faults(text)
            .into_iter()
            .map(|fault| fault.pointer)
            .collect()
    };
    let life = |criterion: &str| plated(&format!(r#","life":{{"criteria":[{criterion}]}}"#));
    for (criterion, field) in [
        (r#"{"kind":"first_exposure"}"#, "/layer"),
        (
            r#"{"kind":"first_exposure","layer":1,"side":"receptacle"}"#,
            "/layer",
        ),
        (
            r#"{"kind":"first_exposure","layer":3,"side":"receptacle"}"#,
            "/layer",
        ),
        (
            r#"{"kind":"exposed_fraction","side":"slider"}"#,
            "/fraction",
        ),
        (r#"{"kind":"worn_depth","side":"slider"}"#, "/mm"),
        (r#"{"kind":"base_metal","fraction":0.5}"#, "/fraction"),
        (r#"{"kind":"base"}"#, "/kind"),
        (r#"{"kind":"base_metal","side":"tip"}"#, "/side"),
        (r#"{"kind":"resistance"}"#, "/mohm"),
    ] {
        let found = pointers(&life(criterion));
        assert!(
            found.contains(&format!("/life/criteria/0{field}")),
            "{criterion}: {found:?}"
        );
    }
    let bare = |rest: &str| {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"interface":{{"wear":{{"slider":null}}}},"plating":{{"receptacle":[]}},{rest}}}"#
        )
    };
    assert_eq!(
        pointers(&bare(r#""stop":[{"kind":"base_metal"}]"#)),
        ["/stop/0"]
    );
    assert_eq!(
        pointers(&bare(
            r#""stop":[{"kind":"worn_depth","mm":0.001,"side":"slider"}]"#
        )),
        ["/stop/0/side"]
    );
    assert_eq!(
        pointers(&bare(r#""stop":[{"kind":"resistance","mohm":10}]"#)),
        ["/stop/0/kind"]
    );
    assert_eq!(
        pointers(&bare(
            r#""stop":[{"worn_depth_mm":0.001,"kind":"worn_depth","mm":0.1}]"#
        )),
        ["/stop/0/worn_depth_mm"]
    );
    assert_eq!(pointers(&bare(r#""stop":[{}]"#)), ["/stop/0"]);
}
