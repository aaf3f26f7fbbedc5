//! Resolution of whole specifications.

mod beyond_limits;
mod faults;
mod round_dimensions;
mod wrong_types;

use super::*;
use crate::estimate::Estimate;
use api::spec::Provenance;
use solver::scene::{Drive, Friction, Motion, WearLaw};

const FUZZ_BUTTON: &str = include_str!("../../examples/fuzz_button.json");

pub(super) fn accepted(text: &str) -> Resolved {
    read(text.as_bytes()).expect("accepted")
}

/// A specification of bare copper on bare copper, as in the base scene, with further fields.
fn bare_fuzz_button(rest: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"fuzz_button"}},"materials":{{"slider":"copper","receptacle":"copper"}},
        "plating":{{"slider":[],"receptacle":[]}},"interface":{{"friction":{{"law":"coulomb","coefficient":1.21}},
            "wear":{{"slider":null,"receptacle":{{"law":"archard","k":0.011,"hardness_mpa":427}}}}}}{rest}}}"#
    )
}

pub(super) fn faults(text: &str) -> Vec<Fault> {
    match read(text.as_bytes()) {
        Err(Refused::Faults(faults)) => faults,
        other => panic!("expected faults, got {other:?}"),
    }
}

fn pointers(text: &str) -> Vec<String> {
    faults(text)
        .into_iter()
        .map(|fault| fault.pointer)
        .collect()
}

#[test]
fn the_base_scene_has_the_values_of_the_source() {
    let scene = accepted(FUZZ_BUTTON).scene;
    assert!((scene.load_n_per_mm - 0.508).abs() < 1e-12);
    assert!((scene.slider.shape.half_width_mm - 0.0254).abs() < 1e-15);
    assert_eq!(scene.friction, Friction::Coulomb { coefficient: 1.21 });
    assert_eq!(scene.slider.wear, None);
    assert_eq!(
        scene.receptacle.wear,
        Some(WearLaw::Archard {
            k_over_h_per_mpa: 0.011 / 427.0
        })
    );
    assert_eq!(
        scene.motion,
        Motion::Reciprocating {
            amplitude_mm: 0.033_868,
            period_s: 16.0
        }
    );
    assert_eq!((scene.cycles, scene.drive), (2000, Drive::Handle));
    assert_eq!(scene.output.stations_mm.len(), 7);
}

#[test]
fn every_kind_resolves_from_its_name_alone() {
    for kind in SystemKind::ALL {
        let resolved = accepted(&format!(r#"{{"system":{{"kind":"{}"}}}}"#, kind.as_str()));
        assert!(resolved.spec.provenance.len() > 20, "{kind:?}");
        assert!(resolved.scene.load_n_per_mm > 0.0);
    }
}

#[test]
fn presets_offer_the_meshes_of_the_source() {
    let of = |preset: &str| {
        let text =
            format!(r#"{{"system":{{"kind":"fuzz_button"}},"accuracy":{{"preset":"{preset}"}}}}"#);
        accepted(&text).scene.accuracy
    };
    let (coarse, fine) = (of("source_coarse"), of("source_fine"));
    let close =
        |size: Option<f64>, expected: f64| size.is_some_and(|s| (s - expected).abs() < 1e-5);
    assert!(close(coarse.contact_element_mm, 0.010_58) && close(fine.contact_element_mm, 0.005_29));
    assert_eq!(fine.increments_per_cycle, Some(32));
    assert_eq!(fine.cycle_jump, None);
}

#[test]
fn a_contact_beyond_small_strains_is_refused_unless_accepted() {
    let spec = |effects: &str| {
        bare_fuzz_button(&format!(
            r#","load":{{"kind":"pressure","mpa":40}},"effects":{{{effects}}}"#
        ))
    };
    let refused = faults(&spec(""));
    assert_eq!(refused[0].pointer, "/load");
    assert!(
        refused[0].detail.contains("1.2 % (limit 1 %)"),
        "{refused:?}"
    );
    accepted(&spec(r#""geometric_nonlinearity":"off""#));
    let on =
        faults(r#"{"system":{"kind":"fuzz_button"},"effects":{"geometric_nonlinearity":"on"}}"#);
    assert_eq!(on[0].pointer, "/effects/geometric_nonlinearity");
}

#[test]
fn the_preset_of_the_fuzz_button_in_bare_copper_is_the_base_scene() {
    let preset = accepted(&bare_fuzz_button(""));
    let mut given = accepted(FUZZ_BUTTON).scene;
    given.output = preset.scene.output.clone();
    assert_eq!(preset.scene, given);
}

#[test]
fn a_resolved_specification_resolves_to_the_same_scene() {
    for kind in SystemKind::ALL {
        let first = accepted(&format!(r#"{{"system":{{"kind":"{}"}}}}"#, kind.as_str()));
        let written = serde_json::to_string(&first.spec).expect("writable");
        assert_eq!(accepted(&written).scene, first.scene);
    }
}

#[test]
fn provenance_distinguishes_given_sourced_and_assumed_values() {
    let provenance = accepted(r#"{"system":{"kind":"fuzz_button","pcb_length_mm":0.1}}"#)
        .spec
        .provenance;
    assert_eq!(provenance["/system/pcb_length_mm"], Provenance::Given);
    assert_eq!(provenance["/system/wire_diameter_mm"], Provenance::Source);
    assert_eq!(provenance["/system/pcb_height_mm"], Provenance::Assumed);
    assert_eq!(
        provenance["/materials/receptacle/hardness_mpa"],
        Provenance::Source
    );
}

#[test]
fn the_plan_estimates_hertz() {
    let mccoll = r#"{"system":{"kind":"cylinder_on_flat","radius_mm":6},
        "materials":{"slider":{"youngs_modulus_mpa":200000,"poisson_ratio":0.3},
                     "receptacle":{"youngs_modulus_mpa":200000,"poisson_ratio":0.3}},
        "load":{"kind":"line_force","n_per_mm":18.5}}"#;
    let resolved = accepted(mccoll);
    let estimates = Estimate::of(&resolved).plan(&resolved, None).estimates;
    assert!((estimates["hertz_half_width_mm"] - 0.035_86).abs() < 1e-5);
    assert!((estimates["hertz_peak_pressure_mpa"] - 328.4).abs() < 0.1);
}

#[test]
fn a_spring_acts_over_the_same_depth_as_its_load() {
    let spring = |load: &str| {
        let text = format!(r#"{{"system":{{"kind":"zif"}},"load":{load}}}"#);
        read(text.as_bytes())
            .expect("a spring is allowed")
            .scene
            .spring_n_per_mm2
    };
    let of_force = spring(r#"{"kind":"force","n":0.5,"width_mm":0.25,"spring_n_per_mm":3}"#);
    let of_line_force = spring(r#"{"kind":"line_force","n_per_mm":2,"spring_n_per_mm":3}"#);
    assert!((of_force - 12.0).abs() < 1e-12 && (of_line_force - 3.0).abs() < 1e-12);
}

#[test]
fn a_round_pin_must_fit_the_pin() {
    let read = |radius: f64| {
        let text = format!(r#"{{"system":{{"kind":"zif","pin_radius_mm":{radius}}}}}"#);
        crate::spec::read(text.as_bytes())
    };
    let scene = read(2.0).expect("a round pin is allowed").scene;
    assert_eq!(scene.receptacle.shape.crown_radius_mm, Some(2.0));
    for radius in [-1.0, 0.3, 0.76] {
        let Err(super::Refused::Faults(faults)) = read(radius) else {
            panic!("{radius} does not fit")
        };
        assert!(
            faults
                .iter()
                .all(|fault| fault.pointer == "/system/pin_radius_mm"),
            "{faults:?}"
        );
    }
}

#[test]
fn a_continuous_motion_is_recorded_in_parts_of_its_distance() {
    let spec = r#"{"system":{"kind":"cylinder_on_flat"},
        "motion":{"kind":"continuous","distance_mm":500},
        "output":{"snapshots_at_distance_mm":[5,500]}}"#;
    let resolved = read(spec.as_bytes()).expect("a turning ring is allowed");
    let Motion::Continuous { step_mm } = resolved.scene.motion else {
        panic!("the motion is continuous")
    };
    assert!((step_mm - 0.005).abs() < 1e-15);
    assert_eq!(resolved.scene.output.snapshots_at_cycles, [1000, 100_000]);
    assert_eq!(resolved.spec.cycles, None);
    let again = serde_json::to_vec(&resolved.spec).expect("it is JSON");
    assert_eq!(
        read(&again).expect("it can be submitted again").scene,
        resolved.scene
    );
}
