//! Requirement: elements a thousand times as high as wide do not affect the contact.
//! Source: Johnson 1985, eq. 4.43 to 4.45 (Hertz line contact, p0 = 328.4 MPa).
//! Naive: triangles or reduced integration lock or show hourglass modes at that aspect ratio, and quality checks of the
//! aspect ratio alone refuse the mesh.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::cylinder;

#[test]
fn slender_elements_far_below_the_contact_do_not_change_hertz_pressure() {
    let run = solve(&cylinder(json!({
        "interface": {"friction": {"law": "frictionless", "coefficient": null}, "wear": {"receptacle": null}},
        "motion": {"amplitude_mm": 0.001},
        "cycles": 1,
        "accuracy": {"overrides": {"contact_element_mm": 0.001}},
    })));
    hold(&run);
    let model = solver::model::build(&run.scene, &solver::effects::plan(&run.scene))
        .expect("it can be meshed");
    let mesh = &model.bodies.receptacle.zones[0].mesh;
    let (nodes, middle) = (mesh.coordinates(), mesh.spines() / 2);
    let width = mesh.x()[middle + 1] - mesh.x()[middle];
    let far = mesh.far_node(middle);
    let height = nodes[far - 1][1] - nodes[far][1];
    assert!(height / width > 1e3, "{height} {width}");
    let peak = run.summary().initial.peak_pressure_mpa;
    assert!((peak / 328.4 - 1.0).abs() < 0.02, "{peak}");
}
