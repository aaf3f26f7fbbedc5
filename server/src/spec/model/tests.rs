//! Points, and what the tests of all dimensions share.

mod extruded;
mod lines;

use api::spec::{Dimension as Named, Provenance};
use solver::scene::{Dimension, Motion};

use crate::spec::{Refused, Resolved, read};

fn accepted(text: &str) -> Resolved {
    read(text.as_bytes()).expect("accepted")
}

fn pointers(text: &str) -> Vec<String> {
    match read(text.as_bytes()) {
        Err(Refused::Faults(faults)) => faults.into_iter().map(|fault| fault.pointer).collect(),
        other => panic!("{text}: {:?}", other.map(|resolved| resolved.warnings)),
    }
}

/// A memory card's ball with further fields.
fn ball(rest: &str) -> String {
    format!(r#"{{"system":{{"kind":"sd_card"}},"model":{{"dimension":"point"}}{rest}}}"#)
}

#[test]
fn plane_strain_is_the_default_and_a_ball_that_of_a_point_contact() {
    let plane = accepted(r#"{"system":{"kind":"sd_card"}}"#);
    let model = plane.spec.model.expect("it is filled in");
    assert_eq!(model.dimension, Some(Named::PlaneStrain.into()));
    assert_eq!(plane.scene.dimension, Dimension::PlaneStrain);
    let point = accepted(&ball(""));
    let provenance = |pointer| point.spec.provenance.get(pointer);
    assert_eq!(provenance("/model/radius_z_mm"), Some(&Provenance::Assumed));
    let model = point.spec.model.as_ref().expect("it is filled in");
    assert_eq!(model.radius_z_mm, Some(0.4));
    assert!(point.layout.is_none());
    // The force of the preset, without its width.
    let load = point.spec.load.as_ref().expect("it has a load");
    assert_eq!((load.n, load.width_mm), (Some(0.5), None));
    let Dimension::Point(found) = point.scene.dimension else {
        panic!("{:?}", point.scene.dimension);
    };
    assert!((found.force_n - 0.5).abs() < 1e-15);
    assert_eq!(found.radius_across_mm.slider, Some(0.4));
    // Resolved, it is the same again.
    let text = serde_json::to_string(&point.spec).expect("JSON");
    assert_eq!(accepted(&text).scene, point.scene);
}

/// Hertz: a = (3 F R/(4 E*))^(1/3), p0 = 3 F/(2 pi a^2), the middle carries pi a p0/2.
#[test]
fn the_section_of_a_ball_carries_the_line_load_of_its_middle() {
    let point = accepted(&ball(
        r#","load":{"kind":"force","n":0.5,"spring_n_per_mm":2.0}"#,
    ));
    let scene = &point.scene;
    let a = (0.75_f64 * 0.5 * 0.4 / 68_939.0).cbrt();
    let exact = 0.75 * 0.5 / a;
    assert!(
        (scene.load_n_per_mm / exact - 1.0).abs() < 1e-4,
        "{}",
        scene.load_n_per_mm
    );
    let spring = scene.spring_n_per_mm2 / scene.load_n_per_mm;
    assert!((spring - 4.0).abs() < 1e-12, "{spring}");
    let known = scene.conduction.known().expect("it conducts");
    assert!((known.width_mm * scene.load_n_per_mm - 0.5).abs() < 1e-12);
}

#[test]
fn fields_that_mean_nothing_in_a_dimension_are_refused() {
    let plane =
        r#"{"system":{"kind":"sd_card"},"model":{"dimension":"plane_strain","radius_z_mm":1}}"#;
    assert_eq!(pointers(plane), ["/model/radius_z_mm"]);
    let other = r#"{"system":{"kind":"sd_card"},"model":{"dimension":"sphere"}}"#;
    assert_eq!(pointers(other), ["/model/dimension"]);
    for (rest, expected) in [
        (
            r#","load":{"kind":"force","n":1,"width_mm":0.8}"#,
            "/load/width_mm",
        ),
        (
            r#","load":{"kind":"line_force","n_per_mm":1}"#,
            "/load/kind",
        ),
        (r#","load":{"kind":"pressure","mpa":1}"#, "/load/kind"),
        (r#","output":{"fields":true}"#, "/output/fields"),
        // A block that leaves the receptacle.
        (
            r#","mission":[{"motion":{"kind":"reciprocating"},"cycles":1000},{"motion":{"kind":"reciprocating","amplitude_mm":50},"cycles":1}]"#,
            "/mission",
        ),
        (r#","effects":{"friction":"on"}"#, "/effects/friction"),
        (r#","effects":{"relocation":"on"}"#, "/effects/relocation"),
        (
            r#","effects":{"stick_memory":"on"}"#,
            "/effects/stick_memory",
        ),
    ] {
        let found = pointers(&ball(rest));
        assert!(
            found.iter().any(|pointer| pointer == expected),
            "{rest}: {found:?}"
        );
    }
}

#[test]
fn a_point_has_the_motions_of_a_section() {
    let series = r#","motion":{"kind":"fourier","terms":[{"order":1,"sine_mm":0.02},{"order":3,"sine_mm":0.02}]}"#;
    let turning = accepted(&ball(series)).scene;
    assert!(matches!(turning.motion, Motion::Periodic { .. }));
    assert!(matches!(turning.dimension, Dimension::Point(_)));
    let rest = r#","interface":{"wear":{"slider":null}},"plating":{"slider":[]},"motion":{"kind":"continuous","distance_mm":10}"#;
    let continuous = accepted(&ball(rest)).scene;
    assert!(matches!(continuous.motion, Motion::Continuous { .. }));
}

#[test]
fn friction_changes_in_every_dimension_where_nothing_sticks_by_it() {
    let by_cycle = r#"{"law":"coulomb","by_cycle":[{"cycle":0,"coefficient":0.2},{"cycle":9,"coefficient":0.4}]}"#;
    let by_dose = r#"{"law":"coulomb","by_dose":[{"dose_mpa_mm":0,"coefficient":0.2},{"dose_mpa_mm":90,"coefficient":0.4}]}"#;
    let of = |system: &str, model: &str, motion: &str, friction: &str| {
        format!(
            r#"{{"system":{{"kind":"{system}"}},"model":{model}{motion},"interface":{{"friction":{friction}}}}}"#
        )
    };
    let crowned = r#"{"dimension":"auto","width_mm":0.8,"crown_radius_mm":10}"#;
    let line = r#"{"dimension":"line","width_mm":0.8}"#;
    let extruded = r#"{"dimension":"extruded","width_mm":0.8,"layers":2}"#;
    for (system, model) in [
        ("sd_card", r#"{"dimension":"point","radius_z_mm":0.4}"#),
        ("sd_card", line),
        ("sd_card", crowned),
        ("sd_card", extruded),
        (
            "fuzz_button",
            r#"{"dimension":"ring","outer_diameter_mm":1.016,"top":"rigid"}"#,
        ),
    ] {
        for friction in [by_cycle, by_dose] {
            let resolved = accepted(&of(system, model, "", friction));
            assert!(resolved.scene.friction.changes());
            assert_ne!(resolved.scene.dimension, Dimension::PlaneStrain, "{model}");
        }
    }
    // A part would stick once the coefficient has risen.
    let sticking = by_cycle.replace("0.4}", "2}");
    let short = r#","motion":{"kind":"reciprocating","amplitude_mm":2e-4}"#;
    for model in [line, extruded] {
        let found = pointers(&of("sd_card", model, short, &sticking));
        assert_eq!(found, ["/motion"], "{model}");
    }
}

#[test]
fn missions_are_simulated_in_every_dimension() {
    let mission = r#","mission":[{"motion":{"kind":"reciprocating","amplitude_mm":0.01},"cycles":30},{"motion":{"kind":"reciprocating","amplitude_mm":0.02},"cycles":10}],"repeat":5,"order":"mixed"}"#;
    for (system, model) in [
        ("sd_card", r#"{"dimension":"point"}"#),
        ("sd_card", r#"{"dimension":"auto","radius_z_mm":0.5}"#),
        ("sd_card", r#"{"dimension":"line","width_mm":0.8}"#),
        (
            "sd_card",
            r#"{"dimension":"auto","width_mm":0.8,"crown_radius_mm":10}"#,
        ),
        ("fuzz_button", r#"{"dimension":"ring"}"#),
        ("fuzz_button", r#"{"dimension":"extruded"}"#),
    ] {
        let text = format!(r#"{{"system":{{"kind":"{system}"}},"model":{model}{mission}"#);
        let found = accepted(&text);
        assert_ne!(found.scene.dimension, Dimension::PlaneStrain, "{text}");
        let mission = found.scene.mission.expect("it has blocks");
        assert_eq!((mission.blocks.len(), mission.repeat), (2, 5));
    }
}

/// The rate of a law of speed differs from block to block, doses of which do not add.
#[test]
fn missions_of_points_have_one_rate() {
    let law = r#","plating":{"slider":[]},"interface":{"wear":{"receptacle":null,"slider":{"law":"rhee","wear_factor":1e-9,"pressure_exponent":1,"speed_exponent":0.5,"time_exponent":1}}}"#;
    let block = |amplitude: f64| {
        format!(r#"{{"motion":{{"kind":"reciprocating","amplitude_mm":{amplitude}}},"cycles":9}}"#)
    };
    let mission = format!(r#","mission":[{},{}]"#, block(0.01), block(0.02));
    let found = pointers(&ball(&format!("{law}{mission}")));
    assert!(
        found.contains(&"/interface/wear/slider/law".to_owned()),
        "{found:?}"
    );
}

#[test]
fn auto_takes_a_radius_across_without_a_width_as_a_point() {
    let with = |model: &str| {
        accepted(&format!(
            r#"{{"system":{{"kind":"sd_card"}},"model":{model}}}"#
        ))
    };
    let auto = with(r#"{"dimension":"auto","radius_z_mm":2}"#);
    assert_eq!(
        auto.scene,
        with(r#"{"dimension":"point","radius_z_mm":2}"#).scene
    );
    let model = auto.spec.model.as_ref().expect("it is filled in");
    assert_eq!(model.chosen, Some(Named::Point.into()));
    let again = accepted(&serde_json::to_string(&auto.spec).expect("JSON"));
    assert_eq!(again.scene, auto.scene);
    let neither = r#"{"system":{"kind":"sd_card"},"model":{"dimension":"auto"}}"#;
    assert_eq!(pointers(neither), ["/model/width_mm"]);
}

#[test]
fn a_law_of_state_is_refused() {
    let law = r#""law":"rhee","wear_factor":1e-9,"pressure_exponent":1.5,"speed_exponent":1,"time_exponent":1"#;
    let text = ball(&format!(
        r#","plating":{{"slider":[],"receptacle":[]}},"interface":{{"wear":{{"slider":null,"receptacle":{{{law}}}}}}}"#
    ));
    let found = pointers(&text);
    assert!(
        found
            .iter()
            .any(|pointer| pointer == "/interface/wear/receptacle/law"),
        "{found:?}"
    );
}

#[test]
fn a_system_without_a_force_asks_for_one() {
    let text = r#"{"system":{"kind":"cylinder_on_flat"},"model":{"dimension":"point"}}"#;
    assert_eq!(pointers(text), ["/load/kind"]);
}

#[test]
fn contacts_that_are_none_of_half_spaces_are_warned_of() {
    let warned = |text: &str| {
        let warnings = accepted(text).warnings.into_iter();
        warnings
            .filter(|warning| warning.pointer == "/model/dimension")
            .count()
    };
    assert_eq!(warned(&ball("")), 0);
    let thin =
        r#"{"system":{"kind":"sd_card","pad_height_mm":0.05},"model":{"dimension":"point"}}"#;
    assert_eq!(warned(thin), 1);
    let edge = ball(r#","cycles":10,"motion":{"kind":"reciprocating","amplitude_mm":0.97}"#);
    assert_eq!(warned(&edge), 1);
}
