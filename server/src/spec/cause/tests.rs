//! Trials from the stage of a field on are those of whole specifications.

use super::*;

/// Gives all fields that can be given at once.
const ALL: &str = r#"{"system":{"kind":"cylinder_on_flat","radius_mm":6,"flat_length_mm":12,"flat_height_mm":5,
    "slider_half_width_mm":3,"slider_height_mm":5,"crown_radius_mm":40},"model":{"dimension":"line","width_mm":3,"crown_radius_mm":90},
    "materials":{"slider":"copper"},"load":{"kind":"force","n":30},"motion":{"kind":"reciprocating","amplitude_mm":0.2},
    "accuracy":{"tolerance":0.1,"overrides":{"contact_element_mm":0.02}}}"#;

const OTHERS: [&str; 5] = [
    r#"{"system":{"kind":"sd_card","contact_radius_mm":0.5},"model":{"dimension":"point","radius_z_mm":0.8},
    "accuracy":{"preset":"draft"},"load":{"kind":"force","n":0.4}}"#,
    r#"{"system":{"kind":"fuzz_button","pcb_height_mm":0.07},"model":{"dimension":"ring","outer_diameter_mm":1.2},
    "motion":{"kind":"reciprocating","amplitude_mm":0.03},"materials":{"receptacle":"copper"}}"#,
    r#"{"system":{"kind":"zif"},"model":{"dimension":"auto","width_mm":0.5,"crown_radius_mm":4},
    "load":{"kind":"force","n":0.3},"cycles":500}"#,
    r#"{"system":{"kind":"dimm"},"load":{"kind":"force","n":0.3},"stop":[{"worn_depth_mm":1e-4}],"motion":
    {"kind":"thermal_cycle","delta_t_k":40,"period_s":3600,"length_mm":10,"expansion_mismatch_per_k":1e-5}}"#,
    r#"{"system":{"kind":"cylinder_on_flat","radius_mm":3},"accuracy":{"preset":"source_fine"},"load":{"kind":"pressure","mpa":2},
    "mission":[{"motion":{"kind":"reciprocating","amplitude_mm":0.1},"cycles":50},
    {"motion":{"kind":"reciprocating","amplitude_mm":0.2},"cycles":70}],"output":{"stations_mm":[0.1]}}"#,
];

/// Fields that a specification gives, and in how many trials of them the scene was resolved.
fn trials(text: &str) -> (Vec<String>, usize) {
    let spec: Spec = serde_json::from_str(text).expect("a specification");
    let document = serde_json::to_value(&spec).expect("JSON");
    let kind = spec.system.kind.known().expect("a kind");
    let mut diagnostics = Diagnostics::default();
    let bodies = Bodies::resolve(kind, &spec, &mut diagnostics);
    let loading = Loading::resolve(&bodies, &spec, &mut diagnostics);
    let numerics = Numerics::resolve(&loading, &spec, &mut diagnostics);
    assert!(
        diagnostics.is_clean(),
        "{text}: {:?}",
        diagnostics.into_faults()
    );
    let mut resolved = 0;
    let mut given = Vec::new();
    for field in fields(kind).filter(|field| document.pointer(field).is_some()) {
        let without = without(&document, &field).expect("a specification");
        if without == spec {
            continue;
        }
        let from_stage = scene_of(&without, &field, &numerics);
        assert_eq!(from_stage, filled::scene_of(&without, kind), "{field}");
        resolved += usize::from(from_stage.is_some());
        given.push(field);
    }
    (given, resolved)
}

#[test]
fn a_trial_from_a_stage_on_has_the_scene_of_the_whole_specification() {
    let resolved: usize = OTHERS.iter().map(|text| trials(text).1).sum();
    assert!(resolved >= 10, "{resolved} trials");
}

#[test]
fn a_specification_causes_13_trials_at_most() {
    let (given, resolved) = trials(ALL);
    assert_eq!(given.len(), 13, "{given:?}");
    // The width of a line has no default.
    assert_eq!(resolved, 12);
    // Tolerance and preset exclude each other, and no model has more than two of the lengths.
    let most = SystemKind::ALL
        .map(|kind| fields(kind).count())
        .into_iter()
        .max();
    assert_eq!(most, Some(given.len() + 3));
}
