//! Requirement: a coefficient of friction that changes, by cycle, by dose or by layer, is given as it was measured; the force
//! follows it, and every fault names its point.

use serde_json::{Value, json};
use tests::Server;

const LOW: f64 = 0.2;
const HIGH: f64 = 0.55;
const CYCLES: u64 = 400;

/// An SD card's contact with a friction and a layer of gold over nickel on its pad, worn through after some 170 cycles.
fn card(friction: &Value, gold: &Value) -> Value {
    let mut layer = json!({
        "material": "hard_gold",
        "thickness_um": 0.05,
        "wear": {"law": "archard", "k_over_h_per_mpa": 2.4e-7},
    });
    if !gold.is_null() {
        layer["friction_coefficient"] = gold.clone();
    }
    let wear =
        json!({"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 2.4e-7}});
    json!({
        "system": {"kind": "sd_card"},
        "interface": {"friction": friction, "wear": wear},
        "plating": {"receptacle": [layer]},
        "cycles": CYCLES,
        "accuracy": {"preset": "draft", "estimate_errors": false},
        "output": {"snapshots_at_cycles": [1, CYCLES]},
    })
}

/// Largest magnitude of a force in the friction loop of a cycle.
async fn largest_force(server: &Server, id: &str, cycle: u64, column: &str) -> f64 {
    let (_, found) = server
        .get(&format!("/v1/jobs/{id}/results/loop?cycle={cycle}"))
        .await;
    let forces = found[column].as_array();
    let forces = forces.expect("a list").iter().filter_map(Value::as_f64);
    forces.fold(0.0, |most: f64, force| most.max(force.abs()))
}

#[tokio::test]
async fn the_force_follows_a_coefficient_that_changes() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let by_cycle = json!({"law": "coulomb", "by_cycle": [
        {"cycle": 0, "coefficient": LOW}, {"cycle": 100, "coefficient": LOW}, {"cycle": 200, "coefficient": HIGH}]});
    let by_dose = json!({"law": "coulomb", "by_dose": [
        {"dose_mpa_mm": 0, "coefficient": LOW}, {"dose_mpa_mm": 200, "coefficient": HIGH}]});
    let base = json!({"law": "coulomb", "coefficient": HIGH});
    for (friction, gold) in [
        (by_cycle, Value::Null),
        (by_dose, Value::Null),
        (base, json!(LOW)),
    ] {
        let job = server.ended(&card(&friction, &gold)).await;
        let id = job["id"].as_str().expect("a job has an id").to_owned();
        assert_eq!(job["outcome"], "completed", "{job}");
        let load = job["spec"]["load"].clone();
        let number = |field: &str| load[field].as_f64().expect("a number");
        let load = number("n") / number("width_mm");
        let column = "tangential_force_n_per_mm";
        let first = largest_force(&server, &id, 1, column).await / load;
        let last = largest_force(&server, &id, CYCLES, column).await / load;
        assert!(
            (first / LOW - 1.0).abs() < 0.02,
            "{friction}: {first} in cycle 1"
        );
        assert!(
            (last / HIGH - 1.0).abs() < 0.05,
            "{friction}: {last} at the end"
        );
        let checks = &job["summary"]["checks"];
        assert!(
            checks["friction_cone"]
                .as_f64()
                .is_some_and(|cone| cone < 1e-8)
        );
        assert!(
            checks["worn_area"]
                .as_f64()
                .is_some_and(|area| area < 1e-11)
        );
    }
}

#[tokio::test]
async fn the_force_of_a_contact_of_finite_width_follows_the_coefficient() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let by_cycle = json!({"law": "coulomb", "by_cycle": [
        {"cycle": 0, "coefficient": LOW}, {"cycle": 20, "coefficient": LOW}, {"cycle": 40, "coefficient": HIGH}]});
    for model in [
        json!({"dimension": "point", "radius_z_mm": 0.4}),
        json!({"dimension": "line", "width_mm": 0.8}),
        json!({"dimension": "extruded", "width_mm": 0.8, "layers": 2, "ends": "held"}),
    ] {
        let mut spec = card(&by_cycle, &Value::Null);
        spec["model"] = model.clone();
        spec["load"] = json!({"kind": "force", "n": 0.5});
        spec["cycles"] = json!(60);
        spec["output"] = json!({"snapshots_at_cycles": [1, 60]});
        let job = server.ended(&spec).await;
        let id = job["id"].as_str().expect("a job has an id").to_owned();
        assert_eq!(job["outcome"], "completed", "{job}");
        let column = "tangential_force_n";
        let first = largest_force(&server, &id, 1, column).await;
        let last = largest_force(&server, &id, 60, column).await;
        // A draft's forces are off by 0.6 % at most; those of the other coefficient are 2.75 times as large.
        assert!((first / (0.5 * LOW) - 1.0).abs() < 0.02, "{model}: {first}");
        assert!((last / (0.5 * HIGH) - 1.0).abs() < 0.02, "{model}: {last}");
    }
}

#[tokio::test]
async fn faults_of_a_table_name_the_point() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let point = |cycle: u64, coefficient: f64| json!({"cycle": cycle, "coefficient": coefficient});
    let table = [point(10, 0.2), point(10, 3.0), point(5, 0.4)];
    let spec = card(&json!({"law": "coulomb", "by_cycle": table}), &json!(0.3));
    let (status, problem) = server.submit(spec.to_string()).await;
    assert_eq!(status, 422, "{problem}");
    let faults = problem["faults"].as_array().expect("a list").iter();
    let pointers: Vec<&str> = faults
        .filter_map(|fault| fault["pointer"].as_str())
        .collect();
    for expected in [
        "/interface/friction/by_cycle/1/coefficient",
        "/interface/friction/by_cycle/1/cycle",
        "/interface/friction/by_cycle/2/cycle",
        "/plating/receptacle/0/friction_coefficient",
    ] {
        assert!(pointers.contains(&expected), "{problem}");
    }
    assert_eq!(pointers.len(), 4, "{problem}");
}
