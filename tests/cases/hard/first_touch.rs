//! Requirement: a contact narrower than one element, and one of thousands of elements, both carry their load.
//! Source: Johnson 1985, eq. 4.43 to 4.45 (Hertz line contact: a = 35.86 um, p0 = 328.4 MPa).
//! Naive: a coarse mesh touches with one node, whose neighbours alternate between open and closed; an active set that
//! grows or shrinks by one node an iteration takes thousands of iterations on a fine one.

use serde_json::json;

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::{AGREEMENT, cylinder};

fn with_elements_of(contact_element_mm: f64, changes: serde_json::Value) -> Run {
    let mut spec = cylinder(changes);
    spec["accuracy"]["overrides"] = json!({"contact_element_mm": contact_element_mm});
    solve(&spec)
}

#[test]
fn a_contact_of_one_node_carries_the_load() {
    let run = with_elements_of(0.4, json!({"cycles": 50}));
    hold(&run);
    let touch = &run.snapshots[0].positions[0];
    let pressed: Vec<usize> = (0..touch.x_mm.len())
        .filter(|&i| touch.pressure_mpa[i] > 0.0)
        .collect();
    assert_eq!(pressed.len(), 1, "{:?}", touch.pressure_mpa);
    let width = 0.5 * (touch.x_mm[pressed[0] + 1] - touch.x_mm[pressed[0] - 1]);
    let carried = width * touch.pressure_mpa[pressed[0]];
    assert!((carried / 18.5 - 1.0).abs() < 1e-9, "{carried}");
    assert!(run.depth() > 0.0);
}

#[test]
fn eight_hundred_elements_meet_hertz() {
    meet_hertz(0.000_09);
}

/// A contact that carries its load on elements of a size, in a stroke of a fraction of one.
fn meet_hertz(contact_element_mm: f64) {
    let run = with_elements_of(
        contact_element_mm,
        json!({
            "system": {"flat_length_mm": 0.6, "flat_height_mm": 0.6, "slider_half_width_mm": 0.3, "slider_height_mm": 0.6},
            "interface": {"friction": {"law": "frictionless", "coefficient": null}, "wear": {"receptacle": null}},
            "motion": {"amplitude_mm": 0.3 * contact_element_mm},
            "cycles": 1,
        }),
    );
    hold(&run);
    let peak = run.summary().initial.peak_pressure_mpa;
    assert!((peak / 328.4 - 1.0).abs() < AGREEMENT, "{peak}");
}

mod long {
    /// 2.4 GB.
    #[test]
    #[ignore = "long: takes 40 s"]
    fn two_thousand_elements_meet_hertz() {
        super::meet_hertz(0.000_036);
    }
}
