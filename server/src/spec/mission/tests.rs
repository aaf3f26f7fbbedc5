//! Missions of specifications.

use api::problem::Fault;
use solver::scene::{Motion, Order, Timing};

use crate::spec;
use crate::spec::tests::{accepted, faults};

/// An SD card (nine contacts of 0.5 N, friction 0.3) with other fields.
fn sd_card(rest: &str) -> String {
    format!(
        r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"force","n":0.5,"width_mm":1.0}},
        "interface":{{"friction":{{"law":"coulomb","coefficient":0.3}},"wear":{{"slider":null,
        "receptacle":{{"law":"archard","k_over_h_per_mpa":6e-9}}}}}},{rest}}}"#
    )
}

/// A mission of these blocks.
fn mission(blocks: &str, rest: &str) -> String {
    sd_card(&format!(r#""mission":[{blocks}]{rest}"#))
}

const MATING: &str = r#"{"name":"matings","motion":{"kind":"insertion","wipe_mm":1.0},"cycles":5}"#;
const RIDE: &str = r#"{"motion":{"kind":"vibration","acceleration_g":100,"frequency_hz":2000,"mass_g":2,"contacts":9,
    "duration_s":0.25}}"#;
const DAYS: &str = r#"{"name":"days","motion":{"kind":"thermal_cycle","delta_t_k":40,"length_mm":20,
    "expansion_mismatch_per_k":6e-6,"tangential_stiffness_n_per_mm":20},"cycles":7}"#;

fn at<'a>(faults: &'a [Fault], pointer: &str) -> Vec<&'a str> {
    let at = faults.iter().filter(|fault| fault.pointer == pointer);
    at.map(|fault| fault.detail.as_str()).collect()
}

#[test]
fn blocks_are_resolved_like_motions_of_their_own() {
    let text = mission(&[MATING, RIDE, DAYS].join(","), r#","repeat":520"#);
    let resolved = accepted(&text);
    let scene = &resolved.scene;
    let blocks = &scene.mission.as_ref().expect("several blocks").blocks;
    let cycles: Vec<u64> = blocks.iter().map(|block| block.cycles).collect();
    // 0.25 s at 2 kHz.
    assert_eq!(cycles, [5, 500, 7]);
    assert_eq!(scene.cycles, 520 * 512);
    assert_eq!(spec::cycles(&resolved.spec), 520 * 512);
    assert!((blocks[0].motion.amplitude_mm() - 0.5).abs() < 1e-15);
    // The arm takes up the expansion.
    assert!(blocks[2].motion.amplitude_mm() <= 0.0);
    let Motion::Reciprocating { amplitude_mm, .. } = scene.motion else {
        panic!("a reciprocating motion");
    };
    assert!(amplitude_mm < 0.5 && (scene.largest_amplitude_mm() - 0.5).abs() < 1e-15);
    let days = resolved
        .warnings
        .iter()
        .filter(|warning| warning.pointer == "/mission/2/motion");
    assert_eq!(days.count(), 1, "{:?}", resolved.warnings);
    let extents = &resolved.blocks;
    assert_eq!(extents[0].name.as_deref(), Some("matings"));
    assert_eq!((extents[0].cycles, extents[1].cycles), (2_600, 260_000));
    assert!((extents[1].duration_h - 130.0 / 3_600.0).abs() < 1e-12);
    assert!(
        extents[1]
            .motion
            .as_ref()
            .is_some_and(|motion| !motion.sticks)
    );
    let provenance = &resolved.spec.provenance;
    assert!(
        provenance.contains_key("/mission/0/motion/wipe_mm"),
        "{provenance:?}"
    );
    assert!(
        !provenance
            .keys()
            .any(|pointer| pointer.starts_with("/motion") || pointer == "/cycles")
    );
    // Submitted again, the resolved specification is the same.
    let again = serde_json::to_string(&resolved.spec).expect("JSON");
    assert_eq!(accepted(&again).scene, resolved.scene);
}

#[test]
fn one_block_is_a_motion_with_all_cycles() {
    let repeated = accepted(&mission(MATING, r#","repeat":20"#));
    let motion = r#""motion":{"kind":"insertion","wipe_mm":1.0},"cycles":100"#;
    assert_eq!(repeated.scene, accepted(&sd_card(motion)).scene);
    assert_eq!(repeated.blocks.len(), 1);
}

/// The order changes when the cycles are done, not how many; of one block there is only one order.
#[test]
fn cycles_are_mixed_where_they_are_asked_to_be() {
    let blocks = [MATING, RIDE, DAYS].join(",");
    let of = |order: &str| accepted(&mission(&blocks, &format!(r#","repeat":520{order}"#)));
    let (in_order, mixed) = (of(""), of(r#","order":"mixed""#));
    let order = |resolved: &spec::Resolved| resolved.scene.mission.as_ref().map(|m| m.order);
    assert_eq!(order(&in_order), Some(Order::InOrder));
    assert_eq!(order(&mixed), Some(Order::Mixed));
    assert_eq!(of(r#","order":"in_order""#).scene, in_order.scene);
    assert_eq!(mixed.blocks, in_order.blocks);
    assert_eq!(mixed.scene.cycles, in_order.scene.cycles);
    let again = serde_json::to_string(&mixed.spec).expect("JSON");
    assert!(again.contains(r#""order":"mixed""#), "{again}");
    assert_eq!(accepted(&again).scene, mixed.scene);
    let single = |order| accepted(&mission(MATING, &format!(r#","repeat":20{order}"#))).scene;
    assert_eq!(single(r#","order":"mixed""#), single(""));
    let found = faults(&mission(&blocks, r#","order":"mixd""#));
    assert!(at(&found, "/order")[0].contains("mixed"), "{found:?}");
    let found = faults(&sd_card(r#""order":"mixed""#));
    assert_eq!(at(&found, "/order").len(), 1, "{found:?}");
}

/// Each block has the waveform of its own motion.
#[test]
fn each_block_has_its_course_in_time() {
    let blocks = ["sine", "triangle"].map(|waveform| {
        format!(
            r#"{{"motion":{{"kind":"reciprocating","waveform":"{waveform}","amplitude_mm":0.01}},"cycles":5}}"#
        )
    });
    let scene = accepted(&mission(&blocks.join(","), "")).scene;
    let blocks = scene.mission.expect("two blocks").blocks;
    let timings: Vec<_> = blocks.iter().map(|block| block.timing.clone()).collect();
    assert_eq!(timings, [Timing::Sine, Timing::Triangle]);
}

#[test]
fn faults_of_blocks_are_at_their_fields() {
    let blocks = [
        r#"{"motion":{"kind":"insertion","wipe_mm":-1},"cycles":0}"#,
        r#"{"motion":{"kind":"continuous","distance_mm":5},"cycles":3}"#,
        r#"{"motion":{"kind":"reciprocating","amplitude_mm":0.01,"drive":"slider_body"}}"#,
        r#"{"motion":{"kind":"vibration","acceleration_g":200,"frequency_hz":50,"mass_g":2,"contacts":9,"duration_s":10},"cycles":3}"#,
    ];
    let text = mission(
        &blocks.join(","),
        r#","repeat":0,"motion":{"kind":"insertion","wipe_mm":1.0},"cycles":4"#,
    );
    let faults = faults(&text);
    for pointer in [
        "/motion",
        "/cycles",
        "/repeat",
        "/mission/0/motion/wipe_mm",
        "/mission/0/cycles",
        "/mission/1/motion/kind",
        "/mission/2/cycles",
        "/mission/2/motion/drive",
        "/mission/3/cycles",
    ] {
        assert!(!at(&faults, pointer).is_empty(), "{pointer}: {faults:?}");
    }
    assert!(at(&faults, "/mission/0/motion/wipe_mm")[0].contains("-1 is outside"));
    assert!(
        faults
            .iter()
            .all(|fault| !fault.pointer.starts_with("/motion/")),
        "{faults:?}"
    );
}

#[test]
fn a_force_that_a_block_needs_is_a_fault_of_the_load() {
    let text = format!(
        r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"line_force","n_per_mm":0.5}},"mission":[{MATING},{RIDE}]}}"#
    );
    assert_eq!(at(&faults(&text), "/load/kind").len(), 1);
}

#[test]
fn limits_of_missions_are_named() {
    let many = vec![MATING; 65].join(",");
    let found = faults(&mission(&many, ""));
    assert!(
        at(&found, "/mission")[0].contains("at most 64"),
        "{found:?}"
    );
    let long = r#"{"motion":{"kind":"insertion","wipe_mm":1.0},"cycles":1000000000}"#;
    let found = faults(&mission(&[long, long].join(","), r#","repeat":1000"#));
    assert!(
        at(&found, "/mission")[0].contains("2000000000000"),
        "{found:?}"
    );
    let found = faults(&sd_card(r#""repeat":3"#));
    assert_eq!(at(&found, "/repeat").len(), 1, "{found:?}");
}
