//! Warnings of what is left out although it is beyond its limit.

use super::accepted;
use crate::words::{decisions, effects};

/// The warning of an effect, if there is one.
fn warned(text: &str, effect: &str) -> Option<String> {
    let pointer = format!("/effects/{effect}");
    let mut warnings = accepted(text).warnings.into_iter();
    let found = warnings.find(|fault| fault.pointer == pointer);
    found.map(|fault| fault.detail)
}

/// Reason of the plan for its decision about an effect.
fn reason(text: &str, name: &str) -> String {
    let plan = solver::effects::plan(&accepted(text).scene);
    let mut decisions = plan.decisions.into_iter();
    let found = decisions.find(|decision| effects::name(decision.effect) == name);
    decisions::reason(&found.expect("every effect is decided about"))
}

/// Loads that have no force: by pressure and by line force.
#[test]
fn a_bare_copper_button_yields_whatever_its_load_is_given_as() {
    let fuzz = include_str!("../../../examples/fuzz_button.json");
    let found = warned(fuzz, "plasticity").expect("it yields");
    assert!(found.contains("times the hardness of the"), "{found}");
    assert!(found.contains("misses a permanent depth"), "{found}");
    // The surface of a contact that slides with 1.21 yields from 1/(3 sqrt 3 mu) on.
    assert!(found.contains("begins at 0.16 times"), "{found}");
    let bare = r#","plating":{"slider":[],"receptacle":[]},"materials":{"slider":"copper","receptacle":"copper"}"#;
    for load in [
        r#"{"kind":"line_force","n_per_mm":0.5}"#,
        r#"{"kind":"pressure","mpa":10}"#,
        r#"{"kind":"force","n":0.05,"width_mm":0.1}"#,
    ] {
        let text = format!(r#"{{"system":{{"kind":"fuzz_button"}},"load":{load}{bare}}}"#);
        assert!(warned(&text, "plasticity").is_some(), "{load}");
    }
}

/// 0.76 um of hard gold on a ball of copper: the contact is 20 times as wide.
#[test]
fn a_thin_layer_does_not_decide_about_yield() {
    let ball = |gold_um: f64| {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"force","n":0.5}},"model":{{"dimension":"point"}},
            "materials":{{"slider":"copper","receptacle":"copper"}},
            "plating":{{"slider":[{{"material":"hard_gold","thickness_um":{gold_um},"wear":{{"law":"archard","k":1e-5}}}}],
            "receptacle":[{{"material":"hard_gold","thickness_um":30,"wear":{{"law":"archard","k":1e-5}}}}]}},
            "interface":{{"wear":{{"slider":{{"law":"archard","k":1e-4}},"receptacle":null}}}}}}"#
        )
    };
    let thin = warned(&ball(0.76), "plasticity").expect("the copper yields");
    assert!(thin.contains("on the slider, 427 MPa"), "{thin}");
    assert!(thin.contains("of the outermost layer"), "{thin}");
    let thick = reason(&ball(30.0), "plasticity");
    assert!(thick.contains("1700 MPa"), "{thick}");
}

/// The wire of 662 MPa on gold of 1 700 yields at its surface alone, by its friction of 0.55.
#[test]
fn plans_of_presets_state_pressure_and_onset_and_two_yield_by_friction() {
    for kind in api::spec::SystemKind::ALL {
        let name = serde_json::to_value(kind).expect("a name");
        let text = format!(r#"{{"system":{{"kind":{name}}}}}"#);
        let reason = reason(&text, "plasticity");
        assert!(reason.contains("yield begins at"), "{reason}");
        // At the surface, by their high coefficients of friction.
        let yields = name == "fuzz_button" || name == "cylinder_on_flat";
        let warned = warned(&text, "plasticity");
        assert_eq!(warned.is_some(), yields, "{name}");
        assert_eq!(reason.ends_with("it is elastic"), !yields, "{reason}");
        assert_eq!(
            reason.contains("enclosed by elastic matter"),
            yields,
            "{reason}"
        );
    }
}

#[test]
fn a_load_that_is_even_across_the_width_is_warned_of_with_the_life() {
    let text = r#"{"system":{"kind":"sd_card"},"load":{"kind":"force","n":0.5,"width_mm":0.8}}"#;
    let found = warned(text, "across_width").expect("a ball wears through sooner");
    assert!(found.contains("times sooner"), "{found}");
    let ball = r#"{"system":{"kind":"sd_card"},"load":{"kind":"force","n":0.5},"model":{"dimension":"point"}}"#;
    assert_eq!(warned(ball, "across_width"), None);
}
