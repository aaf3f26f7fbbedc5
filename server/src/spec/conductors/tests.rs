//! Conductors, spots, films and criteria of specifications.

use solver::effects::{Verdict, plan};
use solver::law::resistance::Deformation;
use solver::scene::Effect;
use solver::scene::{Electrical, Scene};

use crate::spec::Resolved;
use crate::spec::tests::{accepted, faults};
use crate::words::decisions;

/// An SD card with hard gold over nickel on the pad and a tip that does not wear.
fn card(interface: &str, rest: &str) -> String {
    let layer = |name: &str, um: f64| {
        format!(
            r#"{{"material":"{name}","thickness_um":{um},"wear":{{"law":"archard","k":1e-4}}}}"#
        )
    };
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"interface":{{"wear":{{"slider":null}}{interface}}},
        "plating":{{"receptacle":[{},{}]}}{rest}}}"#,
        layer("hard_gold", 0.76),
        layer("nickel", 1.27)
    )
}

fn electrical(resolved: &Resolved) -> &Electrical {
    let known = resolved.scene.conduction.known();
    known.expect("everything is known")
}

fn pointers(text: &str) -> Vec<String> {
    let found = faults(text).into_iter();
    found.map(|fault| fault.pointer).collect()
}

fn verdict(scene: &Scene) -> (Verdict, String) {
    let mut decisions = plan(scene).decisions.into_iter();
    let decision = decisions.find(|decision| decision.effect == Effect::Resistance);
    let decision = decision.expect("it is decided");
    (decision.verdict, decisions::reason(&decision))
}

const FILM: &str = r#","films":[{"specific_resistance_ohm_mm2":1e-5}]"#;

#[test]
fn metals_have_the_hardness_of_their_law_and_the_resistivity_of_their_material() {
    let resolved = accepted(&card("", ""));
    let known = electrical(&resolved);
    let metals = &known.metals.receptacle;
    assert_eq!(metals.len(), 3);
    assert!((metals[0].bottom_mm - 0.76e-3).abs() < 1e-15);
    assert!((metals[1].bottom_mm - 2.03e-3).abs() < 1e-15 && metals[2].bottom_mm.is_infinite());
    assert!((metals[1].resistivity_ohm_m - 6.99e-8).abs() < 1e-20);
    assert!((metals[0].hardness_mpa - 1_700.0).abs() < 1e-9);
    assert!(metals.iter().all(|metal| metal.film.is_none()));
    assert_eq!(known.spots.deformation, Deformation::Plastic);
    let provenance = &resolved.spec.provenance["/interface/spots/count"];
    assert_eq!(*provenance, api::spec::Provenance::Assumed);
    assert_eq!(verdict(&resolved.scene).0, Verdict::Simulated);
    // Submitted again, the resolved specification is the same.
    let again = serde_json::to_string(&resolved.spec).expect("JSON");
    assert_eq!(accepted(&again).scene, resolved.scene);
    // Gold at 200 °C is softer.
    let warm = accepted(&card("", r#","environment":{"temperature_c":200}"#));
    assert!(electrical(&warm).metals.receptacle[0].hardness_mpa < 1_500.0);
}

#[test]
fn films_lie_on_the_metals_that_they_name() {
    let films = r#","films":[{"specific_resistance_ohm_mm2":1e-5},
        {"layer":2,"side":"receptacle","specific_resistance_ohm_mm2":1e-6,"growth_exponent":0.5,"growth_time_h":2}]"#;
    let resolved = accepted(&card(films, ""));
    let known = electrical(&resolved);
    let specific = |side: &[solver::scene::Metal]| {
        let films = side.iter().map(|metal| metal.film);
        films
            .map(|film| film.map(|film| film.specific_resistance_ohm_mm2))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        specific(&known.metals.receptacle),
        [None, Some(1e-6), Some(1e-5)]
    );
    assert_eq!(specific(&known.metals.slider), [Some(1e-5)]);
    let growth = known.metals.receptacle[1].film.and_then(|film| film.growth);
    assert!(growth.is_some_and(|growth| (growth.time_s - 7_200.0).abs() < 1e-9));
    for (film, field) in [
        (r#"{"layer":1}"#, "/specific_resistance_ohm_mm2"),
        (
            r#"{"layer":3,"specific_resistance_ohm_mm2":1e-5}"#,
            "/layer",
        ),
        (
            r#"{"layer":0,"specific_resistance_ohm_mm2":1e-5}"#,
            "/layer",
        ),
        (
            r#"{"layer":1,"side":"slider","specific_resistance_ohm_mm2":1e-5}"#,
            "/layer",
        ),
        (
            r#"{"side":"tip","specific_resistance_ohm_mm2":1e-5}"#,
            "/side",
        ),
        (
            r#"{"specific_resistance_ohm_mm2":1e-5,"growth_exponent":0.5}"#,
            "/growth_time_h",
        ),
        (
            r#"{"specific_resistance_ohm_mm2":1e-5,"growth_time_h":1}"#,
            "/growth_exponent",
        ),
        (
            r#"{"specific_resistance_ohm_mm2":0}"#,
            "/specific_resistance_ohm_mm2",
        ),
    ] {
        let found = pointers(&card(&format!(r#","films":[{film}]"#), ""));
        assert_eq!(found, [format!("/interface/films/0{field}")], "{film}");
    }
    let twice = r#","films":[{"specific_resistance_ohm_mm2":1e-5},{"side":"slider","specific_resistance_ohm_mm2":1e-6}]"#;
    assert_eq!(pointers(&card(twice, "")), ["/interface/films/1"]);
    let grows = r#"{"system":{"kind":"sd_card"},"motion":{"kind":"continuous","distance_mm":1},"interface":{"wear":{"slider":null},
        "films":[{"specific_resistance_ohm_mm2":1e-5,"growth_exponent":0.5,"growth_time_h":2}]}}"#;
    assert_eq!(pointers(grows), ["/interface/films/0/growth_exponent"]);
}

#[test]
fn several_spots_need_a_circle_and_elastic_ones_a_radius() {
    let spots = |fields: &str| card(&format!(r#","spots":{{{fields}}}"#), "");
    for (fields, field) in [
        (r#""count":3"#, "cluster_diameter_mm"),
        (r#""cluster_diameter_mm":0.1"#, "cluster_diameter_mm"),
        (r#""count":0"#, "count"),
        (r#""count":1001,"cluster_diameter_mm":0.1"#, "count"),
        (r#""deformation":"elastic""#, "asperity_radius_mm"),
        (r#""deformation":"auto""#, "asperity_radius_mm"),
        (
            r#""deformation":"plastic","asperity_radius_mm":0.4"#,
            "asperity_radius_mm",
        ),
        (r#""deformation":"rigid""#, "deformation"),
    ] {
        let expected = format!("/interface/spots/{field}");
        assert_eq!(pointers(&spots(fields)), [expected], "{fields}");
    }
    let resolved = accepted(&spots(r#""asperity_radius_mm":0.4"#));
    let found = electrical(&resolved).spots.deformation;
    assert!(matches!(found, Deformation::LowerPressure(asperity) if asperity.modulus_mpa > 5e4));
}

#[test]
fn a_resistance_that_is_not_modelled_names_what_it_lacks() {
    let life = r#","life":{"criteria":[{"kind":"resistance","mohm":10},{"kind":"base_metal"}]}"#;
    let bare = accepted(&card("", life));
    assert_eq!(bare.resistance_lacks.len(), 1);
    assert!(bare.resistance_lacks[0].contains("interface.films"));
    assert!(electrical(&bare).life_mohm.is_empty() && bare.scene.life.len() == 1);
    let filmed = accepted(&card(FILM, life));
    assert!(filmed.resistance_lacks.is_empty());
    assert_eq!(electrical(&filmed).life_mohm, [10.0]);
    // A limit of the whole contact ends a run once, whichever side is named.
    let stop = r#","stop":[{"kind":"resistance","mohm":10,"side":"slider"}]"#;
    assert_eq!(electrical(&accepted(&card(FILM, stop))).stop_mohm, [10.0]);
    assert_eq!(pointers(&card("", stop)), ["/stop/0/kind"]);
    let off = format!(r#"{stop},"effects":{{"resistance":"off"}}"#);
    let [fault] = &faults(&card(FILM, &off))[..] else {
        panic!("one fault");
    };
    assert!(
        fault.detail.contains("effects.resistance"),
        "{}",
        fault.detail
    );
}

#[test]
fn what_is_not_known_is_input_that_is_missing_where_it_is_asked_for() {
    let own = r#","materials":{"receptacle":{"youngs_modulus_mpa":117000,"poisson_ratio":0.34}}"#;
    let laws = r#","interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-8}}"#;
    let of = |rest: &str| format!(r#"{{"system":{{"kind":"sd_card"}}{own}{laws}{rest}}}}}"#);
    let silent = accepted(&of(""));
    let (skipped, reason) = verdict(&silent.scene);
    assert_eq!(skipped, Verdict::Skipped);
    assert!(reason.contains("resistivity_ohm_m"), "{reason}");
    assert!(silent.spec.interface.spots.is_none());
    let asked = accepted(&of(FILM));
    assert_eq!(verdict(&asked.scene).0, Verdict::InputMissing);
    let mut warned = asked.warnings.iter();
    assert!(warned.any(|fault| fault.pointer == "/effects/resistance"));
    assert_eq!(
        asked.resistance_lacks,
        [
            "`materials.receptacle.resistivity_ohm_m`",
            "`materials.receptacle.hardness_mpa`"
        ]
    );
    // A load per mm has no force.
    let line = accepted(
        r#"{"system":{"kind":"sd_card"},"load":{"kind":"line_force","n_per_mm":0.5},"effects":{"resistance":"off"}}"#,
    );
    assert!(line.resistance_lacks[0].contains("`force`"));
    let forced = r#"{"system":{"kind":"fuzz_button"},"effects":{"resistance":"on"}}"#;
    assert_eq!(pointers(forced), ["/effects/resistance"]);
}

#[test]
fn a_current_of_high_frequency_is_warned_of() {
    let skin = |rest: &str| {
        let resolved = accepted(&card("", rest));
        let mut decisions = plan(&resolved.scene).decisions.into_iter();
        let decision = decisions.find(|decision| decision.effect == Effect::SkinEffect);
        let mut warned = resolved.warnings.iter();
        let is_warned = warned.any(|fault| fault.pointer == "/effects/skin_effect");
        (decision.expect("it is decided"), is_warned)
    };
    let (direct, is_warned) = skin("");
    assert!(direct.indicator().is_none() && !is_warned, "{direct:?}");
    let (slow, is_warned) = skin(r#","environment":{"frequency_hz":50}"#);
    assert!(slow.indicator().is_some_and(|found| found.value() < 1e-6) && !is_warned);
    let (fast, is_warned) = skin(r#","environment":{"frequency_hz":1e9}"#);
    let reason = decisions::reason(&fast);
    assert!(reason.contains("direct current") && is_warned, "{reason}");
    assert!(fast.indicator().is_some_and(|found| found.value() > 1.0));
    assert_eq!(fast.verdict, Verdict::Skipped);
}
