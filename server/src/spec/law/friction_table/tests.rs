//! Tables of friction, coefficients of layers, and what they do not go with.

use solver::scene::Friction;
use solver::sides::Side;

use crate::spec::tests::{accepted, faults};

const BY_CYCLE: &str = r#"{"law":"coulomb","by_cycle":[{"cycle":0,"coefficient":0.2},{"cycle":5e3,"coefficient":0.55}]}"#;
const BY_DOSE: &str = r#"{"law":"coulomb","by_dose":[{"dose_mpa_mm":0,"coefficient":0.2},{"dose_mpa_mm":2e4,"coefficient":0.55}]}"#;
const WEAR: &str = r#"{"law":"archard","k":1e-4,"hardness_mpa":1700}"#;

/// An SD card with a friction and more.
fn card(friction: &str, rest: &str) -> String {
    format!(r#"{{"system":{{"kind":"sd_card"}},"interface":{{"friction":{friction}}}{rest}}}"#)
}

/// Gold and nickel with these fields more on the receptacle of an SD card, over a base that wears.
fn plated(friction: &str, [gold, nickel]: [&str; 2], rest: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"interface":{{{friction}"wear":{{"receptacle":{WEAR}}}}},"plating":{{"receptacle":[
        {{"material":"hard_gold","thickness_um":0.76,"wear":{WEAR}{gold}}},
        {{"material":"nickel","thickness_um":1.27,"wear":{WEAR}{nickel}}}]}}{rest}}}"#
    )
}

fn pointers(text: &str) -> Vec<String> {
    let found = faults(text).into_iter();
    found.map(|fault| fault.pointer).collect()
}

#[test]
fn tables_are_resolved_and_stay_what_they_are() {
    for (friction, end) in [(BY_CYCLE, 5e3), (BY_DOSE, 2e4)] {
        let resolved = accepted(&card(friction, ""));
        let (Friction::ByCycle(table) | Friction::ByDose(table)) = &resolved.scene.friction else {
            panic!("a table: {:?}", resolved.scene.friction);
        };
        // The 1 000 cycles of the preset end the table by cycle.
        assert!((table.at(0.1 * end) - 0.235).abs() < 1e-15 && resolved.scene.friction.changes());
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, resolved.scene);
    }
    // 1 000 cycles of the preset meet a fifth of the table.
    let resolved = accepted(&card(BY_CYCLE, ""));
    assert!((resolved.scene.largest_friction() - 0.27).abs() < 1e-15);
}

#[test]
fn points_that_do_not_ascend_or_are_too_few_are_named() {
    let by_cycle =
        |points: &str| card(&format!(r#"{{"law":"coulomb","by_cycle":[{points}]}}"#), "");
    let point = r#"{"cycle":10,"coefficient":0.2}"#;
    assert_eq!(pointers(&by_cycle("")), ["/interface/friction/by_cycle"]);
    assert_eq!(pointers(&by_cycle(point)), ["/interface/friction/by_cycle"]);
    let same = by_cycle(&format!("{point},{point}"));
    let [fault] = &faults(&same)[..] else {
        panic!("one fault");
    };
    assert_eq!(fault.pointer, "/interface/friction/by_cycle/1/cycle");
    assert_eq!(fault.detail, "10 is not above the 10 of the point before");
    let many: Vec<String> = (0..65)
        .map(|cycle| format!(r#"{{"cycle":{cycle},"coefficient":0.2}}"#))
        .collect();
    assert_eq!(
        pointers(&by_cycle(&many.join(","))),
        ["/interface/friction/by_cycle"]
    );
    let outside = r#"{"cycle":0,"coefficient":0.2},{"cycle":9,"coefficient":2.5}"#;
    assert_eq!(
        pointers(&by_cycle(outside)),
        ["/interface/friction/by_cycle/1/coefficient"]
    );
}

#[test]
fn one_form_of_the_coefficient_is_given() {
    let both = BY_CYCLE.replace(r#""law""#, r#""coefficient":0.3,"law""#);
    assert_eq!(pointers(&card(&both, "")), ["/interface/friction/by_cycle"]);
    let both = BY_DOSE.replace(r#""law""#, r#""coefficient":0.3,"law""#);
    assert_eq!(pointers(&card(&both, "")), ["/interface/friction/by_dose"]);
    let tables = BY_DOSE.replace(
        r#""law":"coulomb""#,
        BY_CYCLE.trim_matches(['{', '}']).trim_end_matches('}'),
    );
    let tables = tables.replace("0.55],", "0.55}],");
    assert_eq!(
        pointers(&card(&tables, "")),
        ["/interface/friction/by_dose"]
    );
    // The coefficient of the preset.
    let none = accepted(&card(r#"{"law":"coulomb"}"#, ""));
    assert_eq!(none.scene.friction, Friction::Coulomb { coefficient: 0.3 });
    let frictionless = BY_CYCLE.replace("coulomb", "frictionless");
    assert_eq!(
        pointers(&card(&frictionless, "")),
        ["/interface/friction/by_cycle"]
    );
}

#[test]
fn layers_have_coefficients_of_their_own_over_that_of_the_base() {
    let friction = r#""friction":{"law":"coulomb","coefficient":0.6},"#;
    let resolved = accepted(&plated(
        friction,
        [r#","friction_coefficient":0.2"#, ""],
        "",
    ));
    let Friction::ByLayer(layers) = &resolved.scene.friction else {
        panic!("layers: {:?}", resolved.scene.friction);
    };
    assert_eq!(layers.receptacle, [0.2, 0.6, 0.6]);
    assert!(layers.slider.is_empty());
    assert!((resolved.scene.friction.unworn() - 0.2).abs() < 1e-15);
    assert!((resolved.scene.largest_friction() - 0.6).abs() < 1e-15);
    let again = serde_json::to_string(&resolved.spec).expect("JSON");
    assert_eq!(accepted(&again).scene, resolved.scene);
    // Below the layers the preset's coefficient, where none is given.
    let preset = accepted(&plated("", [r#","friction_coefficient":0.2"#; 2], ""));
    let Friction::ByLayer(layers) = &preset.scene.friction else {
        panic!("layers: {:?}", preset.scene.friction);
    };
    assert_eq!(layers.of(Side::Receptacle)[..], [0.2, 0.2, 0.3]);
}

#[test]
fn coefficients_of_layers_do_not_go_with_other_forms() {
    let gold = [r#","friction_coefficient":0.2"#, ""];
    let at = "/plating/receptacle/0/friction_coefficient";
    for friction in [BY_CYCLE, BY_DOSE, r#"{"law":"frictionless"}"#] {
        let text = plated(&format!(r#""friction":{friction},"#), gold, "");
        assert_eq!(pointers(&text), [at], "{friction}");
    }
    let outside = [r#","friction_coefficient":2.1"#, ""];
    assert_eq!(pointers(&plated("", outside, "")), [at]);
}

#[test]
fn laws_with_one_coefficient_are_refused_beside_one_that_changes() {
    let energy = r#"{"law":"dissipated_energy","energy_coefficient_mm3_per_j":1e-5}"#;
    let sarkar = r#"{"law":"sarkar","k":1e-4,"hardness_mpa":1700}"#;
    let saracibar = r#"{"law":"saracibar","k":1e-4,"hardness_mpa":1700,"reference_friction":0.3}"#;
    let severe = r#"{"law":"severe_oxidation","molten_fraction":0.01,"latent_heat_j_m3":2e9,"heat_share":0.5,
        "oxide_conductivity_w_mk":3.2,"oxide_melting_temperature_c":1487,"contact_temperature_c":20,"diffusion_distance_um":10,
        "hardness_mpa":6865}"#;
    for law in [energy, sarkar, saracibar, severe] {
        let wear = format!(r#","wear":{{"receptacle":{law}}}"#);
        let text = |friction: &str| {
            format!(
                r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},"interface":{{"friction":{friction}{wear}}}}}"#
            )
        };
        assert_eq!(
            pointers(&text(BY_CYCLE)),
            ["/interface/wear/receptacle/law"],
            "{law}"
        );
        // A table of one coefficient is one coefficient.
        accepted(&text(&BY_CYCLE.replace("0.55", "0.2")));
    }
    let layer = plated("", [r#","friction_coefficient":0.2"#, ""], "").replacen(WEAR, energy, 1);
    assert_eq!(pointers(&layer), ["/interface/wear/receptacle/law"]);
    let layer = plated("", [r#","friction_coefficient":0.2"#, ""], "");
    let (base, layers) = layer.split_at(layer.find("plating").expect("a plating"));
    let text = format!("{base}{}", layers.replacen(WEAR, sarkar, 1));
    assert_eq!(pointers(&text), ["/plating/receptacle/0/wear/law"]);
}

#[test]
fn doses_need_a_surface_that_wears_as_deep() {
    let unworn = |side: &str| {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"interface":{{"friction":{BY_DOSE},"wear":{{{side}}}}}}}"#
        )
    };
    let neither = unworn(r#""receptacle":null,"slider":null"#);
    assert_eq!(pointers(&neither), ["/interface/friction/by_dose"]);
    // 0.76 um at 5.9e-8 1/MPa last 12 920 MPa mm.
    let shallow = format!(
        r#"{{"system":{{"kind":"sd_card"}},"interface":{{"friction":{BY_DOSE},"wear":{{"receptacle":null}}}},"plating":{{"receptacle":[
        {{"material":"hard_gold","thickness_um":0.76,"wear":{WEAR}}}]}}}}"#
    );
    let [fault] = &faults(&shallow)[..] else {
        panic!("one fault");
    };
    assert_eq!(fault.pointer, "/interface/friction/by_dose");
    assert!(
        fault.detail.contains("1.2920e4") && fault.detail.contains("2.0000e4"),
        "{}",
        fault.detail
    );
    accepted(&shallow.replace("2e4", "12000"));
}

/// A depth is one dose by `archard` and `barwell`; by laws of pressure and speed it is not.
#[test]
fn doses_are_read_from_depths_that_tell_them() {
    let barwell = r#"{"law":"barwell","k_over_h_per_mpa":2e-7,"course":"accelerating","characteristic_dose_mpa_mm":300}"#;
    let rhee = r#"{"law":"rhee","wear_factor":2e-7,"pressure_exponent":1.2,"speed_exponent":1,"time_exponent":1}"#;
    let card = |friction: &str, law: &str| {
        let wear = format!(r#""wear":{{"slider":null,"receptacle":{law}}}"#);
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},"interface":{{"friction":{friction},{wear}}}}}"#
        )
    };
    accepted(&card(BY_DOSE, barwell));
    let [fault] = &faults(&card(BY_DOSE, rhee))[..] else {
        panic!("one fault");
    };
    assert_eq!(fault.pointer, "/interface/friction/by_dose");
    assert!(fault.detail.contains("receptacle"), "{}", fault.detail);
    accepted(&card(BY_CYCLE, barwell));
    accepted(&card(BY_CYCLE, rhee));
}

#[test]
fn continuous_motion_has_no_cycles_and_a_derived_slip_one_coefficient() {
    let continuous = r#","motion":{"kind":"continuous","distance_mm":100}"#;
    assert_eq!(
        pointers(&card(BY_CYCLE, continuous)),
        ["/interface/friction/by_cycle"]
    );
    accepted(&card(BY_DOSE, continuous));
    let thermal = r#","motion":{"kind":"thermal_cycle","delta_t_k":60,"length_mm":67,"expansion_mismatch_per_k":6e-6}"#;
    let held = thermal.replace('}', r#","tangential_stiffness_n_per_mm":500}"#);
    let warned = |friction: &str, motion: &str| {
        let resolved = accepted(&card(friction, motion));
        let mut warnings = resolved.warnings.into_iter();
        warnings.any(|warning| warning.detail.contains("derived once"))
    };
    assert!(warned(BY_CYCLE, &held) && warned(BY_DOSE, &held));
    assert!(!warned(r#"{"law":"coulomb","coefficient":0.3}"#, &held));
    // Without an arm the friction takes up nothing.
    assert!(!warned(BY_CYCLE, thermal));
}
