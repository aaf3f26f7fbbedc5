use solver::effects::{Indicator, Verdict, plan};
use solver::scene::Effect;
use solver::scene::{Scene, SpeedLaw, Temperature, WearLaw};

use crate::spec::Resolved;
use crate::spec::tests::{accepted, faults};
use crate::words::decisions;

/// An SD card with tin on the pad at a temperature.
fn tinned(temperature: &str, rest: &str) -> Resolved {
    accepted(&format!(
        r#"{{"system":{{"kind":"sd_card"}},"environment":{{"temperature_c":{temperature}}},"plating":{{"receptacle":[{{"material":"tin",
        "thickness_um":3,"wear":{{"law":"archard","k":1e-4}}}}]}}{rest}}}"#
    ))
}

fn verdict(scene: &Scene) -> (Verdict, String) {
    let mut decisions = plan(scene).decisions.into_iter();
    let softening = decisions.find(|d| d.effect == Effect::ThermalSoftening);
    let softening = softening.expect("it is decided");
    (softening.verdict, decisions::reason(&softening))
}

#[test]
fn tin_softens_at_85_degrees_and_wears_faster() {
    let rate = |resolved: &Resolved| resolved.scene.receptacle.outer_rate().expect("a rate");
    let (warm, cool) = (tinned("85", ""), tinned("20", ""));
    let ratio = rate(&warm) / rate(&cool);
    assert!((ratio - 211.9 / 146.9).abs() < 1e-12, "{ratio}");
    assert_eq!(verdict(&warm.scene).0, Verdict::Simulated);
    let (skipped, reason) = verdict(&cool.scene);
    assert!(
        skipped == Verdict::Skipped && reason.contains("20 °C"),
        "{reason}"
    );
    // Negligible beside a tolerance of 10 %, of which an effect may take a fifth.
    let rest = r#","accuracy":{"tolerance":0.1}"#;
    assert_eq!(verdict(&tinned("22", rest).scene).0, Verdict::Skipped);
    // Submitted again, the resolved specification is the same.
    let again = serde_json::to_string(&warm.spec).expect("JSON");
    assert_eq!(accepted(&again).scene, warm.scene);
}

#[test]
fn an_unknown_melting_temperature_is_named_and_one_that_is_passed_refused() {
    let own = r#","materials":{"receptacle":{"youngs_modulus_mpa":117000,"poisson_ratio":0.34}},
        "interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-8}}}"#;
    let unknown = tinned("85", own);
    let (verdict, reason) = verdict(&unknown.scene);
    assert_eq!(verdict, Verdict::InputMissing);
    assert!(reason.contains("melting_temperature_c"), "{reason}");
    let warned = unknown.warnings.iter();
    let mut warned = warned.filter(|fault| fault.pointer == "/effects/thermal_softening");
    assert!(warned.next().is_some());
    let molten = r#"{"system":{"kind":"dimm"},"materials":{"receptacle":"tin"},"environment":{"temperature_c":240}}"#;
    let found = faults(molten);
    assert_eq!(found[0].pointer, "/environment/temperature_c");
    assert!(found[0].detail.contains("tin melts"), "{}", found[0].detail);
    let law = r#","interface":{"wear":{"receptacle":{"law":"dissipated_energy","energy_coefficient_mm3_per_j":1e-5}}}"#;
    let bare = format!(
        r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},"environment":{{"temperature_c":85}}{law}}}"#
    );
    assert!(accepted(&bare).scene.receptacle.softening.ratios == [Some(1.0)]);
}

/// Decision, value and reason about an effect of a scene.
fn decided(scene: &Scene, effect: Effect) -> (Verdict, f64, String) {
    let mut decisions = plan(scene).decisions.into_iter();
    let found = decisions.find(|decision| decision.effect == effect);
    let found = found.expect("it is decided");
    let value = found.indicator().map_or(0.0, Indicator::value);
    (found.verdict, value, decisions::reason(&found))
}

#[test]
fn fast_sliding_heats_the_contact_and_slow_does_not() {
    let at = |period: f64| {
        accepted(&format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"motion":{{"kind":"reciprocating","amplitude_mm":0.1,"period_s":{period}}}}}"#
        ))
    };
    let (slow, little, _) = decided(&at(1.0).scene, Effect::FrictionalHeating);
    let (fast, much, reason) = decided(&at(4e-3).scene, Effect::FrictionalHeating);
    assert_eq!((slow, fast), (Verdict::Skipped, Verdict::Simulated));
    // 250 times as fast: at most that much warmer, less where the heat does not reach the far face in a period.
    assert!((100.0..260.0).contains(&(much / little)), "{much} {little}");
    assert!(reason.contains("K on average"), "{reason}");
}

#[test]
fn a_current_heats_the_contact_where_its_force_is_known() {
    let with = |rest: &str| {
        let text =
            format!(r#"{{"system":{{"kind":"sd_card"}},"environment":{{"current_a":10}}{rest}}}"#);
        let (verdict, _, reason) = decided(&accepted(&text).scene, Effect::JouleHeating);
        (verdict, reason)
    };
    let (known, reason) = with("");
    assert_eq!(known, Verdict::Simulated, "{reason}");
    let (unknown, reason) = with(r#","load":{"kind":"line_force","n_per_mm":0.5}"#);
    assert_eq!(unknown, Verdict::Skipped);
    assert!(reason.contains("width_mm"), "{reason}");
    let found = faults(r#"{"system":{"kind":"sd_card"},"environment":{"current_a":-1}}"#);
    assert_eq!(found[0].pointer, "/environment/current_a");
}

#[test]
fn a_law_without_a_temperature_takes_that_of_the_surroundings() {
    let law = |rest: &str| {
        let constants = r#""k":1e-4,"hardness_mpa":6865,"oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,
            "activation_energy_j_mol":138e3,"critical_film_um":10,"molten_fraction":0.01,"latent_heat_j_m3":2e9,"heat_share":0.5,
            "oxide_conductivity_w_mk":3.2,"oxide_melting_temperature_c":1487,"diffusion_distance_um":10"#;
        let text = format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"environment":{{"temperature_c":50}},"interface":{{"friction":{{"law":"coulomb",
            "coefficient":0.3}},"wear":{{"slider":null,"receptacle":{{"law":"oxidation",{constants}{rest}}}}}}}}}"#
        );
        let resolved = accepted(&text);
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, resolved.scene);
        match resolved.scene.receptacle.wear {
            Some(WearLaw::OfSpeed(SpeedLaw::Mechanism(law))) => law,
            other => panic!("{other:?}"),
        }
    };
    let surroundings = law("");
    assert_eq!(
        surroundings.mild.surface.temperature,
        Temperature::OfSurroundings(323.15)
    );
    assert!((surroundings.transition_mm_s - 100.0).abs() <= 0.0);
    let given = law(r#","contact_temperature_c":427,"transition_speed_mm_s":30"#);
    assert_eq!(
        given.severe.surface.temperature,
        Temperature::OfContact(700.15)
    );
    assert!((given.transition_mm_s - 30.0).abs() <= 0.0);
    let bare = r#"{"system":{"kind":"cylinder_on_flat"},"interface":{"wear":{"receptacle":{"law":"oxidation"}}}}"#;
    let pointers: Vec<String> = faults(bare)
        .into_iter()
        .map(|fault| fault.pointer)
        .collect();
    for field in ["k", "critical_film_um", "latent_heat_j_m3"] {
        let pointer = format!("/interface/wear/receptacle/{field}");
        assert!(pointers.contains(&pointer), "{pointers:?}");
    }
}

#[test]
fn a_current_without_a_resistance_heats_nothing() {
    let off = r#"{"system":{"kind":"sd_card"},"environment":{"current_a":50},"effects":{"resistance":"off"}}"#;
    let (verdict, _, reason) = decided(&accepted(off).scene, Effect::JouleHeating);
    assert_eq!(verdict, Verdict::Skipped);
    assert!(reason.contains("switched off"), "{reason}");
    // Without a force the resistance of a contact with a current cannot be computed.
    let unknown = r#"{"system":{"kind":"sd_card"},"environment":{"current_a":5},"load":{"kind":"line_force","n_per_mm":0.5}}"#;
    let warned = accepted(unknown).warnings;
    assert!(
        warned
            .iter()
            .any(|fault| fault.pointer == "/effects/resistance"),
        "{warned:?}"
    );
}

#[test]
fn heat_that_could_matter_asks_for_the_properties_that_it_lacks() {
    let with = |frequency: f64, rest: &str| {
        let text = format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"motion":{{"kind":"reciprocating","amplitude_mm":0.2,"frequency_hz":{frequency}}},
            "materials":{{"receptacle":{{"youngs_modulus_mpa":2e5,"poisson_ratio":0.3,"hardness_mpa":1700{rest}}}}},
            "interface":{{"friction":{{"law":"coulomb","coefficient":0.5}},"wear":{{"receptacle":{{"law":"archard","k":1e-5}}}}}}}}"#
        );
        let (verdict, _, reason) = decided(&accepted(&text).scene, Effect::FrictionalHeating);
        (verdict, reason)
    };
    let conducts = r#","thermal_conductivity_w_mk":50"#;
    let melts = r#","melting_temperature_c":1400"#;
    let (slow, _) = with(0.1, "");
    assert_eq!(slow, Verdict::Skipped);
    for (rest, field) in [
        (melts, "thermal_conductivity_w_mk"),
        (conducts, "melting_temperature_c"),
    ] {
        let (verdict, reason) = with(5_000.0, rest);
        assert_eq!(verdict, Verdict::InputMissing, "{reason}");
        assert!(reason.contains(field), "{reason}");
    }
    let (known, _) = with(5_000.0, &format!("{conducts}{melts}"));
    assert_eq!(known, Verdict::Simulated);
}

#[test]
fn a_part_that_does_not_wear_melts_too() {
    let with = |rest: &str| {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"materials":{{"slider":"tin","receptacle":"steel"}},"plating":{{"slider":[],"receptacle":[]}},
            "interface":{{"wear":{{"slider":null,"receptacle":{{"law":"archard","k":1e-4}}}}}},"environment":{{{rest}}}}}"#
        )
    };
    let found = faults(&with(r#""temperature_c":240"#));
    assert!(found[0].detail.contains("tin melts"), "{}", found[0].detail);
    let scene = accepted(&with(r#""temperature_c":20"#)).scene;
    let to_melting = scene.slider.softening.to_melting_k;
    assert!(
        to_melting.is_some_and(|margin| (margin - 211.9).abs() < 1.0),
        "{to_melting:?}"
    );
    // The hardness of tin counts for the spots.
    let hardness = |rest: &str| {
        let scene = accepted(&with(rest)).scene;
        let electrical = scene.conduction.known().expect("all of it is known");
        electrical.metals.slider[0].hardness_mpa
    };
    let ratio = hardness(r#""temperature_c":85"#) / hardness(r#""temperature_c":20"#);
    assert!((ratio - 146.9 / 211.9).abs() < 1e-3, "{ratio}");
}

#[test]
fn a_contact_that_would_melt_is_warned_of() {
    let text = r#"{"system":{"kind":"cylinder_on_flat"},"motion":{"kind":"reciprocating","amplitude_mm":0.2,"frequency_hz":50000}}"#;
    let warned = accepted(text).warnings;
    assert!(
        warned
            .iter()
            .any(|fault| fault.detail.contains("the contact melts")),
        "{warned:?}"
    );
}

/// On the walls of the fuzz button's groove the indicator of friction has no bound.
#[test]
fn only_heat_melts_a_contact() {
    let text = include_str!("../../../examples/fuzz_button.json");
    let long = text.replace("0.033868", "0.06");
    assert_ne!(long, text);
    for text in [text, &long] {
        let warned = accepted(text).warnings;
        let melts = warned.iter().filter(|fault| fault.detail.contains("melts"));
        assert_eq!(melts.count(), 0, "{warned:?}");
    }
}

#[test]
fn a_dose_is_not_read_from_a_depth_that_heat_changes() {
    let with = |frequency: f64| {
        format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"motion":{{"kind":"reciprocating","amplitude_mm":0.2,"frequency_hz":{frequency}}},
            "interface":{{"friction":{{"law":"coulomb","by_dose":[{{"dose_mpa_mm":0,"coefficient":0.1}},
            {{"dose_mpa_mm":4000,"coefficient":0.5}}]}}}}}}"#
        )
    };
    accepted(&with(1.0));
    let found = faults(&with(2_000.0));
    assert_eq!(found[0].pointer, "/interface/friction/by_dose");
    assert!(
        found[0].detail.contains("frictional_heating"),
        "{}",
        found[0].detail
    );
}
