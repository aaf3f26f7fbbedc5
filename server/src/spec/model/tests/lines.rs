//! Rings, lines and the choice between dimensions.

use api::spec::{Dimension as Named, EnumValue};
use solver::scene::{Dimension, LineShape, RingMotion, Top};

use super::{accepted, pointers};

/// A fuzz button's ring, or a memory card's line, with further fields.
fn ring(rest: &str) -> String {
    format!(r#"{{"system":{{"kind":"fuzz_button"}},"model":{{"dimension":"ring"}}{rest}}}"#)
}

fn line(own: &str, rest: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"model":{{"dimension":"line","width_mm":0.8{own}}}{rest}}}"#
    )
}

/// The source's pressure of 10 MPa on the width of the wire, 0.508 N/mm, on 3.032 mm.
#[test]
fn a_ring_carries_the_load_of_its_section_along_its_centre_line() {
    let found = accepted(&ring(""));
    let Dimension::Line(own) = found.scene.dimension else {
        panic!("{:?}", found.scene.dimension);
    };
    let LineShape::Ring { radius_mm, .. } = own.shape else {
        panic!("{:?}", own.shape);
    };
    assert!((radius_mm - 0.4826).abs() < 1e-12);
    assert!((own.force_n - 0.508 * own.shape.length_mm()).abs() < 1e-12);
    assert!((own.force_n - 1.540).abs() < 1e-3, "{}", own.force_n);
    assert_eq!((own.top, own.stations), (Top::Rigid, None));
    let force = accepted(&ring(r#","load":{"kind":"force","n":0.834}"#)).scene;
    assert!((force.load_n_per_mm - 0.834 / own.shape.length_mm()).abs() < 1e-15);
    let text = serde_json::to_string(&found.spec).expect("JSON");
    assert_eq!(accepted(&text).scene, found.scene);
    assert!(found.layout.is_some());
}

/// A motion about the axis of the ring, and an even pressure on its wire.
#[test]
fn a_ring_turns_and_is_pressed_where_its_model_says_so() {
    let of = |own: &str| {
        let text =
            format!(r#"{{"system":{{"kind":"fuzz_button"}},"model":{{"dimension":"ring"{own}}}}}"#);
        *accepted(&text).scene.dimension.line().expect("a line")
    };
    let motion = |line: solver::scene::Line| match line.shape {
        LineShape::Ring { motion, .. } => motion,
        LineShape::Straight { .. } => panic!("{:?}", line.shape),
    };
    assert_eq!(motion(of("")), RingMotion::InPlane);
    assert_eq!(motion(of(r#","motion":"torsion""#)), RingMotion::Torsion);
    assert_eq!(of(r#","top":"pressure""#).top, Top::Pressure);
    let bent = line(r#","top":"pressure""#, "");
    assert_eq!(pointers(&bent), ["/model/top"]);
    let turned = line(r#","motion":"torsion""#, "");
    assert_eq!(pointers(&turned), ["/model/motion"]);
}

/// The spring and the force are those of the whole line.
#[test]
fn a_line_shares_its_force_and_its_spring() {
    let load = r#","load":{"kind":"force","n":0.5,"spring_n_per_mm":2.0}"#;
    let scene = accepted(&line(r#","crown_radius_mm":10,"tilt_mrad":-1"#, load)).scene;
    assert!((scene.load_n_per_mm - 0.625).abs() < 1e-15);
    assert!((scene.spring_n_per_mm2 - 2.5).abs() < 1e-15);
    let Dimension::Line(own) = scene.dimension else {
        panic!("{:?}", scene.dimension);
    };
    let shape = LineShape::Straight {
        width_mm: 0.8,
        crown_radius_mm: Some(10.0),
        tilt_mrad: -1.0,
    };
    assert_eq!((own.shape, own.force_n), (shape, 0.5));
    let known = scene.conduction.known().expect("its hardnesses are known");
    assert!((known.width_mm - 0.8).abs() < 1e-15);
    let per_mm = r#","load":{"kind":"line_force","n_per_mm":0.625,"spring_n_per_mm":2.5}"#;
    let scene_per_mm = accepted(&line(r#","crown_radius_mm":10,"tilt_mrad":-1"#, per_mm)).scene;
    assert_eq!(scene_per_mm.dimension, scene.dimension);
    assert!((scene_per_mm.spring_n_per_mm2 - 2.5).abs() < 1e-15);
}

#[test]
fn lines_rings_and_extruded_bodies_have_fields_inside_them() {
    let fields = r#","output":{"fields":true}"#;
    let extruded = format!(
        r#"{{"system":{{"kind":"fuzz_button"}},"model":{{"dimension":"extruded"}}{fields}}}"#
    );
    for text in [
        ring(fields),
        line(r#","crown_radius_mm":10"#, fields),
        extruded,
    ] {
        assert!(accepted(&text).scene.output.fields, "{text}");
    }
}

#[test]
fn fields_that_mean_nothing_along_a_line_are_refused() {
    for (text, expected) in [
        (ring(r#","load":{"kind":"force","n":1,"width_mm":3}"#), "/load/width_mm"),
        (
            ring(r#","motion":{"kind":"continuous","distance_mm":10}"#),
            "/motion/kind",
        ),
        // The blocks of a mission are those of a motion.
        (
            ring(r#","mission":[{"motion":{"kind":"reciprocating"},"cycles":9},{"motion":{"kind":"fourier","terms":[{"order":1,"sine_mm":0.02},{"order":3,"sine_mm":0.02}]},"cycles":9}]"#),
            "/mission/1/motion/kind",
        ),
        (
            ring(r#","mission":[{"motion":{"kind":"reciprocating"},"cycles":9},{"motion":{"kind":"reciprocating","amplitude_mm":1e-6},"cycles":9}]"#),
            "/mission",
        ),
        (ring(r#","effects":{"stick_memory":"on"}"#), "/effects/stick_memory"),
        (ring(r#","effects":{"resistance":"on"}"#), "/effects/resistance"),
        (
            ring(r#","accuracy":{"overrides":{"stations":2}}"#),
            "/accuracy/overrides/stations",
        ),
        (
            line(r#","crown_radius_mm":10"#, r#","accuracy":{"overrides":{"stations":3}}"#),
            "/accuracy/overrides/stations",
        ),
        // The middle of a crown sticks longest.
        (
            line(r#","crown_radius_mm":10"#, r#","motion":{"kind":"reciprocating","amplitude_mm":1e-4}"#),
            "/motion",
        ),
        // Off the board.
        (
            ring(r#","motion":{"kind":"reciprocating","amplitude_mm":0.06}"#),
            "/motion",
        ),
        // The whole contact sticks.
        (
            ring(r#","motion":{"kind":"reciprocating","amplitude_mm":1e-6}"#),
            "/motion",
        ),
        // The thesis' drive deforms no section alike under a rigid top.
        (
            ring(r#","motion":{"kind":"reciprocating","drive":"slider_body"}"#),
            "/motion/drive",
        ),
        // Farther than the ring is wide.
        (
            ring(r#","motion":{"kind":"reciprocating","amplitude_mm":0.6}"#),
            "/motion",
        ),
        (line(r#","outer_diameter_mm":1"#, ""), "/model/outer_diameter_mm"),
        (line(r#","radius_z_mm":1"#, ""), "/model/radius_z_mm"),
        (line(r#","top":"soft""#, ""), "/model/top"),
        (line(r#","tilt_mrad":1e3"#, ""), "/model/tilt_mrad"),
        (
            r#"{"system":{"kind":"sd_card"},"model":{"dimension":"line"}}"#.to_owned(),
            "/model/width_mm",
        ),
        (
            r#"{"system":{"kind":"sd_card"},"model":{"dimension":"ring"}}"#.to_owned(),
            "/model/outer_diameter_mm",
        ),
        (
            r#"{"system":{"kind":"fuzz_button"},"model":{"dimension":"ring","outer_diameter_mm":0.1}}"#.to_owned(),
            "/model/outer_diameter_mm",
        ),
        (
            r#"{"system":{"kind":"sd_card"},"accuracy":{"overrides":{"stations":9}}}"#.to_owned(),
            "/accuracy/overrides/stations",
        ),
    ] {
        let found = pointers(&text);
        assert!(
            found.iter().any(|pointer| pointer == expected),
            "{text}: {found:?}"
        );
    }
}

/// Where the choice of `auto` changes: no crown, a flat one, a round one, a crown as round as the section, a tilt.
#[test]
fn auto_chooses_by_numbers() {
    let chosen = |own: &str, rest: &str| {
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"model":{{"dimension":"auto","width_mm":0.8{own}}},"load":{{"kind":"force","n":0.5}}{rest}}}"#
        );
        let found = accepted(&text);
        let again = accepted(&serde_json::to_string(&found.spec).expect("JSON"));
        assert_eq!(again.scene, found.scene);
        let name = found
            .spec
            .model
            .as_ref()
            .and_then(|model| model.chosen.as_ref());
        let name = name.and_then(EnumValue::known).expect("it is written");
        let reason = found.chosen.expect("it has a reason");
        assert!(reason.contains(name.as_str()), "{reason}");
        let is_its = match found.scene.dimension {
            Dimension::PlaneStrain => name == Named::PlaneStrain,
            Dimension::Line(_) => name == Named::Line,
            Dimension::Point(_) => name == Named::Point,
            Dimension::Extruded(_) => false,
        };
        assert!(is_its, "{name:?}");
        name
    };
    assert_eq!(chosen("", ""), Named::PlaneStrain);
    assert_eq!(chosen(r#","crown_radius_mm":0.4"#, ""), Named::Point);
    assert_eq!(chosen(r#","crown_radius_mm":3"#, ""), Named::Point);
    assert_eq!(chosen(r#","crown_radius_mm":10"#, ""), Named::Point);
    // The contact grows to the ends of the width.
    assert_eq!(chosen(r#","crown_radius_mm":1000"#, ""), Named::Line);
    assert_eq!(chosen(r#","tilt_mrad":1"#, ""), Named::Line);
    // So flat that it is worn alike, of which 4e-9 mm are no part.
    assert_eq!(chosen(r#","tilt_mrad":5e-6"#, ""), Named::PlaneStrain);
    // A point has no fields inside the bodies.
    assert_eq!(
        chosen(r#","crown_radius_mm":10"#, r#","output":{"fields":true}"#),
        Named::Line
    );
    // A law that only a section supports.
    let powers = r#","plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"rhee","wear_factor":1e-9,"pressure_exponent":1.5,"speed_exponent":1,"time_exponent":1}}}"#;
    assert_eq!(
        chosen(r#","crown_radius_mm":10"#, powers),
        Named::PlaneStrain
    );
}

/// A crown whose contact is about round is a point; and the most loaded section yields first.
#[test]
fn crowned_lines_are_warned_of() {
    let warned = |text: &str, pointer: &str| {
        let warnings = accepted(text).warnings.into_iter();
        warnings.filter(|fault| fault.pointer == pointer).count()
    };
    for (crown, expected) in [("1", 1), ("10", 0), ("1000", 0)] {
        let text = line(&format!(r#","crown_radius_mm":{crown}"#), "");
        assert_eq!(warned(&text, "/model/crown_radius_mm"), expected, "{crown}");
    }
    let copper = r#","materials":{"slider":"copper","receptacle":"copper"},"plating":{"slider":[],"receptacle":[]},
        "interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k":1e-5,"hardness_mpa":427}}}"#;
    assert_eq!(
        warned(
            &line(r#","crown_radius_mm":10"#, copper),
            "/effects/plasticity"
        ),
        1
    );
    assert_eq!(warned(&line("", copper), "/effects/plasticity"), 0);
}
