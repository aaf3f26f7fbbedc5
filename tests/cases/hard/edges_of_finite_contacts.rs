//! Requirement: a contact that would leave its body is refused with the amplitude and the limit, or warned of, and one beside the edge runs.
//! Source: three_d.md 8. The receptacle of a ring is a section of the length `pcb_length_mm` about its centre line; half-spaces of a point contact have
//! no edges, so that only the unworn contact is held back from them, and the worn one is warned of.
//! Naive: indices beyond the last node, or pressures on air.

use serde_json::{Value, json};
use server::spec::{self, Refused};

use super::invariants::across::{faults, hold};
use super::run::solve;
use super::specs::{ring, spring};

/// Faults of a specification that is refused.
fn refused(spec: &Value) -> Vec<String> {
    let Err(Refused::Faults(faults)) = spec::read(spec.to_string().as_bytes()) else {
        panic!("it is accepted: {spec}");
    };
    let faults = faults.into_iter();
    faults
        .map(|fault| format!("{}: {}", fault.pointer, fault.detail))
        .collect()
}

/// At 0 degrees the wire comes to lie over the edge of the ring below; across the motion it stays in its middle.
#[test]
fn a_ring_slides_up_to_the_edge_of_the_one_below() {
    let block = |length: f64| json!({"pcb_length_mm": length, "pcb_height_mm": 0.0635});
    for length in [0.072, 0.0678] {
        let run = solve(&ring(json!({"system": block(length), "cycles": 20})));
        let found = faults(&run);
        assert!(found.is_empty(), "{length}: {}", found.join("\n"));
        run.summary();
    }
    let found = refused(&ring(json!({"system": block(0.0677)})));
    assert!(
        found.len() == 1 && found[0].starts_with("/motion: amplitude is 0.033868 mm"),
        "{found:?}"
    );
    assert!(found[0].contains("0.03385"), "{found:?}");
}

#[test]
fn a_ball_is_kept_from_the_edge() {
    let ball = || json!({"dimension": "point"});
    let found = refused(&spring(
        ball(),
        json!({"motion": {"amplitude_mm": 0.99}, "system": {"pad_length_mm": 2.0}}),
    ));
    assert!(
        found
            .iter()
            .any(|fault| fault.starts_with("/motion: the contact of") && fault.contains("0.99 mm")),
        "{found:?}"
    );
    let near = spring(
        ball(),
        json!({"motion": {"amplitude_mm": 0.97}, "system": {"pad_length_mm": 2.0}, "cycles": 2}),
    );
    let resolved = spec::read(near.to_string().as_bytes()).expect("it is accepted");
    assert!(
        resolved
            .warnings
            .iter()
            .any(|fault| fault.detail.contains("from the edge of the receptacle")),
        "{:?}",
        resolved.warnings
    );
}

/// A flattening ball grows out of its first window, by a factor of ten.
#[test]
fn a_ball_outgrows_its_window() {
    let wear = json!({"law": "archard", "k_over_h_per_mpa": 5.9e-6});
    let changes =
        json!({"interface": {"wear": {"slider": wear, "receptacle": null}}, "cycles": 5000});
    let run = solve(&spring(json!({"dimension": "point"}), changes));
    hold(&run);
    let across = |report: &solver::record::CycleReport| {
        report
            .extent
            .expect("an extent")
            .contact_half_length_across_mm
    };
    let grown = across(&run.summary().last) / across(&run.reports[0]);
    assert!(grown > 5.0, "{grown}");
}
