//! Scenes of all regimes: systems, friction, slip regimes, wear of both sides, springs, stiffness and depth of wear.

use serde_json::{Value, json};
use tests::{bare_preset, merged};

/// Scenes of a second at most from each regime: every effect is decisive in one of them and skipped in another, as far as it can be.
const ONE_OF_EACH_REGIME: [&str; 35] = [
    "fuzz_button, friction 0.05",
    "sd_card",
    "sd_card, friction 0",
    "sd_card, friction 0.05",
    "dimm",
    "zif",
    "zif, 20 cycles",
    "cylinder_on_flat",
    "cylinder_on_flat, friction 0.6",
    "sd_card, amplitude 0.00005 mm",
    "sd_card, amplitude 0.001 mm",
    "sd_card, amplitude 0.005 mm",
    "cylinder_on_flat, amplitude 0.005 mm",
    "cylinder_on_flat, amplitude 0.1 mm",
    "cylinder_on_flat, slider wears 0.1 times as fast",
    "sd_card, spring 0.1 N/mm",
    "cylinder_on_flat, spring 10 N/mm",
    "sd_card, 5000 cycles, spring 20 N/mm",
    "cylinder_on_flat, whole slider driven, friction 0.1",
    "cylinder_on_flat, whole slider driven, friction 0.6",
    "sd_card, soft slider, friction 0.1",
    "sd_card, soft slider, friction 0.5",
    "sd_card, soft slider, friction 0.8",
    "sd_card, soft receptacle, friction 0.1",
    "slender slider",
    "sd_card, 0.2 um of gold on the receptacle",
    "cylinder_on_flat, 50 um of gold on both sides",
    "sd_card, -40 °C",
    "sd_card, 24 °C",
    "sd_card, 85 °C",
    "cylinder_on_flat, 0.001 mm/s",
    "cylinder_on_flat, 30 mm/s",
    "cylinder_on_flat, 400 mm/s",
    "sd_card, 0.1 A",
    "sd_card, 20 A",
];

const KINDS: [&str; 5] = ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"];

/// Few scenes with their names.
pub(super) fn one_of_each_regime() -> Vec<(String, Value)> {
    let mut scenes = all();
    scenes.retain(|(name, _)| ONE_OF_EACH_REGIME.contains(&&name[..]));
    assert_eq!(scenes.len(), ONE_OF_EACH_REGIME.len(), "names are unique");
    scenes
}

/// All scenes with their names.
pub(super) fn all() -> Vec<(String, Value)> {
    let mut scenes = Vec::new();
    for kind in KINDS {
        add_to(&mut scenes, kind.to_owned(), kind, &json!({}));
        for coefficient in [0.0, 0.05, 0.6] {
            let friction = match coefficient {
                0.0 => json!({"law": "frictionless"}),
                _ => json!({"law": "coulomb", "coefficient": coefficient}),
            };
            let name = format!("{kind}, friction {coefficient}");
            add_to(
                &mut scenes,
                name,
                kind,
                &json!({"interface": {"friction": friction}}),
            );
        }
    }
    for kind in ["sd_card", "cylinder_on_flat"] {
        for amplitude in [5e-5, 2e-4, 1e-3, 5e-3, 0.1] {
            let name = format!("{kind}, amplitude {amplitude} mm");
            let motion =
                json!({"kind": "reciprocating", "amplitude_mm": amplitude, "period_s": 0.05});
            add_to(&mut scenes, name, kind, &json!({"motion": motion}));
        }
        for share in [1.0, 0.1, 1e-3, 1e-5] {
            let name = format!("{kind}, slider wears {share} times as fast");
            let law = |k: f64| json!({"law": "archard", "k_over_h_per_mpa": k});
            let wear = json!({"slider": law(1e-6 * share), "receptacle": law(1e-6)});
            add_to(
                &mut scenes,
                name,
                kind,
                &json!({"interface": {"wear": wear}}),
            );
        }
        for spring in [1e-3, 0.1, 10.0] {
            let name = format!("{kind}, spring {spring} N/mm");
            let load =
                json!({"kind": "force", "n": 0.5, "width_mm": 0.8, "spring_n_per_mm": spring});
            add_to(&mut scenes, name, kind, &json!({"load": load}));
        }
    }
    for coefficient in [0.1, 0.6] {
        for kind in ["sd_card", "cylinder_on_flat"] {
            let name = format!("{kind}, whole slider driven, friction {coefficient}");
            let changes = json!({
                "motion": {"kind": "reciprocating", "amplitude_mm": 0.1, "period_s": 0.05, "drive": "slider_body"},
                "interface": {"friction": {"law": "coulomb", "coefficient": coefficient}},
            });
            add_to(&mut scenes, name, kind, &changes);
        }
    }
    add_soft_to(&mut scenes);
    let driven = json!({"cycles": 2_000});
    add_to(
        &mut scenes,
        "fuzz_button, 2000 cycles".to_owned(),
        "fuzz_button",
        &driven,
    );
    // The block is worn to a part of its height.
    let thin = json!({"system": {"kind": "cylinder_on_flat", "flat_height_mm": 0.02}, "cycles": 1_000_000,
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.005, "period_s": 0.05}});
    add_to(
        &mut scenes,
        "thin block, short stroke".to_owned(),
        "cylinder_on_flat",
        &thin,
    );
    add_slender_to(&mut scenes);
    for spring in [20.0, 200.0] {
        let name = format!("sd_card, 5000 cycles, spring {spring} N/mm");
        let load = json!({"kind": "force", "n": 0.5, "width_mm": 0.8, "spring_n_per_mm": spring});
        add_to(
            &mut scenes,
            name,
            "sd_card",
            &json!({"load": load, "cycles": 5_000}),
        );
    }
    add_plated_to(&mut scenes);
    add_heated_to(&mut scenes);
    for cycles in [20, 20_000] {
        let name = format!("zif, {cycles} cycles");
        add_to(&mut scenes, name, "zif", &json!({"cycles": cycles}));
    }
    add_presets_to(&mut scenes);
    add_fast_to(&mut scenes);
    add_currents_to(&mut scenes);
    scenes
}

/// A slider that friction bends.
fn add_slender_to(scenes: &mut Vec<(String, Value)>) {
    let slender = json!({
        "system": {"kind": "cylinder_on_flat", "radius_mm": 25.0, "slider_half_width_mm": 0.5, "slider_height_mm": 1.25,
            "flat_length_mm": 5.0, "flat_height_mm": 3.0},
        "cycles": 60,
        "load": {"kind": "line_force", "n_per_mm": 20.0},
        "interface": {"friction": {"law": "coulomb", "coefficient": 0.5}, "wear": {
            "slider": {"law": "archard", "k_over_h_per_mpa": 1e-6}, "receptacle": {"law": "archard", "k_over_h_per_mpa": 1e-6}}},
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.8, "period_s": 0.05}});
    add_to(
        scenes,
        "slender slider".to_owned(),
        "cylinder_on_flat",
        &slender,
    );
}

/// A soft body on either side.
fn add_soft_to(scenes: &mut Vec<(String, Value)>) {
    let hardness_mpa = 100.0;
    let soft =
        json!({"youngs_modulus_mpa": 3000.0, "poisson_ratio": 0.38, "hardness_mpa": hardness_mpa});
    for (side, coefficient) in [
        ("slider", 0.1),
        ("slider", 0.5),
        ("receptacle", 0.1),
        ("slider", 0.8),
    ] {
        let name = format!("sd_card, soft {side}, friction {coefficient}");
        let mut changes = json!({
            "materials": {side: soft},
            "interface": {"friction": {"law": "coulomb", "coefficient": coefficient}},
        });
        if side == "receptacle" {
            let law = json!({"law": "archard", "k": 0.004, "hardness_mpa": hardness_mpa});
            changes["interface"]["wear"] = json!({"receptacle": law});
        }
        add_to(scenes, name, "sd_card", &changes);
    }
}

/// Two layers over a base that wears twenty times as fast as the outer one: through on both sides, on one of them, and not.
fn add_plated_to(scenes: &mut Vec<(String, Value)>) {
    let law = |rate: f64| json!({"law": "archard", "k_over_h_per_mpa": rate});
    let layers = |thickness_um: f64| {
        json!([
            {"material": "hard_gold", "thickness_um": thickness_um, "wear": law(1e-6)},
            {"material": "nickel", "thickness_um": 1.5 * thickness_um, "wear": law(4e-6)},
        ])
    };
    let wear = json!({"slider": law(2e-5), "receptacle": law(2e-5)});
    for kind in ["sd_card", "cylinder_on_flat"] {
        for thickness_um in [0.05, 0.5, 50.0] {
            let changes = json!({
                "plating": {"slider": layers(thickness_um), "receptacle": layers(thickness_um)},
                "interface": {"wear": wear},
            });
            let name = format!("{kind}, {thickness_um} um of gold on both sides");
            add_to(scenes, name, kind, &changes);
        }
        let changes = json!({
            "plating": {"receptacle": layers(0.2)},
            "interface": {"wear": {"slider": null, "receptacle": law(2e-5)}},
        });
        let name = format!("{kind}, 0.2 um of gold on the receptacle");
        add_to(scenes, name, kind, &changes);
    }
}

/// Copper hardly, noticeably and much warmer or colder than its hardness was measured at, and tin.
fn add_heated_to(scenes: &mut Vec<(String, Value)>) {
    for temperature in [-40, 24, 85, 300] {
        let changes = json!({"environment": {"temperature_c": temperature}});
        let name = format!("sd_card, {temperature} °C");
        add_to(scenes, name, "sd_card", &changes);
    }
    let tin =
        json!([{"material": "tin", "thickness_um": 5, "wear": {"law": "archard", "k": 1e-4}}]);
    let changes = json!({"environment": {"temperature_c": 85}, "plating": {"receptacle": tin}});
    let name = "cylinder_on_flat, tin at 85 °C".to_owned();
    add_to(scenes, name, "cylinder_on_flat", &changes);
}

/// Mean speeds over seven orders of magnitude, at which friction heats the contact by nothing up to some hundred kelvin.
fn add_fast_to(scenes: &mut Vec<(String, Value)>) {
    const AMPLITUDE_MM: f64 = 0.05;
    for (kind, speeds) in [
        ("fuzz_button", &[1e-3, 1.0, 1e2, 1e3, 1e4][..]),
        ("cylinder_on_flat", &[1e-3, 10.0, 30.0, 100.0, 400.0]),
    ] {
        for speed in speeds {
            let motion = json!({
                "kind": "reciprocating",
                "amplitude_mm": AMPLITUDE_MM,
                "period_s": 4.0 * AMPLITUDE_MM / speed,
            });
            let name = format!("{kind}, {speed} mm/s");
            add_to(scenes, name, kind, &json!({"motion": motion}));
        }
    }
}

/// Currents that heat the contact by nothing up to some hundred kelvin.
fn add_currents_to(scenes: &mut Vec<(String, Value)>) {
    for current_a in [0.1, 3.0, 20.0] {
        let changes = json!({
            "load": {"kind": "force", "n": 0.5, "width_mm": 0.8},
            "environment": {"current_a": current_a},
        });
        let name = format!("sd_card, {current_a} A");
        add_to(scenes, name, "sd_card", &changes);
    }
}

/// The platings of the presets after few cycles, and one of them until both layers of the slider are through. (That takes up to two
/// minutes a run with the others.)
fn add_presets_to(scenes: &mut Vec<(String, Value)>) {
    for kind in ["fuzz_button", "sd_card", "dimm", "zif"] {
        let preset = json!({"system": {"kind": kind}});
        scenes.push((format!("{kind} with its platings"), merged(preset, short())));
    }
    let worn = json!({
        "system": {"kind": "dimm"},
        "cycles": 2_000_000,
        "stop": [{"kind": "base_metal"}],
    });
    let name = "dimm with its platings, to base metal".to_owned();
    scenes.push((name, merged(short(), worn)));
}

/// Adds the bare preset of a kind with changes, at few cycles unless given. Laws replace those of the preset as a whole.
fn add_to(scenes: &mut Vec<(String, Value)>, name: String, kind: &str, changes: &Value) {
    let mut base = bare_preset(kind);
    for law in ["friction", "wear/slider", "wear/receptacle"] {
        let pointer = format!("/interface/{law}");
        if let Some(replaced) = base.pointer_mut(&pointer)
            && changes.pointer(&pointer).is_some()
        {
            *replaced = Value::Null;
        }
    }
    let spec = merged(merged(base, short()), changes.clone());
    scenes.push((name, spec));
}

/// Few cycles, for the tolerance of all scenes.
fn short() -> Value {
    json!({
        "cycles": 500,
        "accuracy": {"tolerance": super::TOLERANCE, "estimate_errors": false},
    })
}
