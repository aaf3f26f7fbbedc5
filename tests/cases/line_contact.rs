//! Requirement: a contact along a line, a ring or a crowned spring, is a job like any other. It reports its sections, their profiles and
//! their histories, and `auto` chooses it where a contact requires it.

use serde_json::{Value, json};
use tests::{Server, fretwear, spec};

fn document(name: &str) -> Value {
    let text = std::fs::read(spec(name)).expect("the specification is there");
    serde_json::from_slice(&text).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(number)
        .collect()
}

/// The ring on few sections, coarse and short.
fn ring() -> Value {
    let mut ring = document("fuzz_button_ring.json");
    ring["cycles"] = json!(40);
    ring["accuracy"] = json!({"preset": "draft", "overrides": {"stations": 5}});
    ring["output"] = json!({"stations_mm": [0.0], "snapshots_at_cycles": [10, 40]});
    ring
}

#[tokio::test]
async fn a_ring_is_a_job_with_sections() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let job = server.ended(&ring()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    assert_eq!(job["outcome"], "completed", "{job}");
    let summary = &job["summary"];
    // Under a rigid top all places sink alike, by k F/(2 R) a cycle but for the first ones, and the force is balanced.
    let stations = summary["stations"].as_array().expect("sections");
    let depths: Vec<f64> = stations
        .iter()
        .map(|station| number(&station["receptacle"]["max_depth_mm"]))
        .collect();
    assert_eq!(depths.len(), 5);
    let sunk = 40.0 * 0.011 / 427.0 * 0.834 / (2.0 * 0.4826);
    for depth in &depths {
        // The elastic approach differs by some 10 nm, of 0.9 um.
        assert!((depth / depths[0] - 1.0).abs() < 0.04, "{depths:?}");
        assert!((depth / sunk - 1.0).abs() < 0.1, "{depths:?} {sunk}");
    }
    let carried: f64 = stations
        .iter()
        .map(|station| number(&station["length_mm"]))
        .sum();
    assert!((carried - 2.0 * std::f64::consts::PI * 0.4826).abs() < 1e-9);
    assert!((number(&summary["extent"]["load_n"]) - 0.834).abs() < 1e-6);
    // The common height is found to 1e-5 of the force.
    assert!(number(&summary["checks"]["force_balance"]) <= 1e-5);
    // mu F over 4 A a cycle.
    let energy = number(&summary["extent"]["dissipated_energy_mj"]);
    let work = 1.21 * 0.834 * 4.0 * 0.033_868 * 40.0;
    assert!((energy / work - 1.0).abs() < 0.02, "{energy} {work}");

    let results = format!("/v1/jobs/{id}/results");
    let history = server.get(&format!("{results}/wear-history")).await.1;
    let series = history["line_stations"].as_array().expect("sections");
    assert_eq!(series.len(), 5);
    let last = numbers(&series[2]["receptacle_max_depth_mm"]);
    assert!((last[last.len() - 1] / depths[2] - 1.0).abs() < 1e-12);
    assert!((number(&series[2]["theta_deg"]) - 90.0).abs() < 1e-12);

    // Profiles of a section: that across the motion if none is named.
    let own = server
        .get_in_the_end(&format!("{results}/profile?cycle=40"))
        .await
        .1;
    let first = server
        .get(&format!("{results}/profile?cycle=40&station=0"))
        .await
        .1;
    assert_eq!(own["receptacle"], first["receptacle"]);
    let beside = server
        .get(&format!("{results}/profile?cycle=40&station=2"))
        .await
        .1;
    let deepest = numbers(&beside["receptacle"]["depth_mm"])
        .into_iter()
        .fold(0.0, f64::max);
    assert!((deepest / depths[2] - 1.0).abs() < 1e-12);
    let pressure = server.get(&format!("{results}/pressure?station=2")).await.1;
    assert_eq!(
        pressure["positions"].as_array().map(Vec::len),
        Some(3),
        "{pressure}"
    );
    let (status, missing) = server.get(&format!("{results}/profile?station=5")).await;
    assert_eq!(
        (status, &missing["type"]),
        (404, &json!("/problems/no-such-result"))
    );
    assert!(
        missing["detail"]
            .as_str()
            .is_some_and(|detail| detail.contains("5 sections")),
        "{missing}"
    );
}

/// Walls that would overhang are no graph: the run ends with what it has, and says so.
#[test]
fn a_groove_as_deep_as_the_wire_ends_a_ring() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut spec = ring();
    // So soft that it takes 40 cycles to the radius of the wire.
    spec["interface"]["wear"]["receptacle"] =
        json!({"law": "archard", "k": 0.4, "hardness_mpa": 427});
    spec["cycles"] = json!(400);
    spec["accuracy"]["estimate_errors"] = json!(false);
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(
        folder.path(),
        &["solve", "spec.json", "--json", "--out", "out"],
    );
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    assert_eq!(summary["outcome"], "deeper_than_radius", "{}", ran.stderr);
    let cycles = number(&summary["cycles_done"]);
    assert!(cycles > 10.0 && cycles < 100.0, "{cycles}");
    let file = folder.path().join(format!("out/stations-{cycles}.json"));
    let found: Value = serde_json::from_slice(&std::fs::read(file).expect("a file")).expect("JSON");
    assert_eq!(found["stations"].as_array().map(Vec::len), Some(5));
}

/// A crown whose contact grows to the ends of the width is worn as a line of sections, others as a point.
#[test]
fn auto_simulates_what_a_crown_calls_for() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut spec = document("sd_card_crown.json");
    spec["model"]["dimension"] = json!("auto");
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let plan = fretwear(folder.path(), &["plan", "spec.json"]);
    assert!(
        plan.stdout
            .contains("model `point`: the contact, 7.9 times"),
        "{}",
        plan.stdout
    );
    let crown = json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10});
    spec["model"] = json!({"dimension": "auto", "width_mm": 0.8, "crown_radius_mm": 1000});
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let plan = fretwear(folder.path(), &["plan", "spec.json"]);
    assert!(
        plan.stdout
            .contains("model `line`: the contact is expected to grow"),
        "{}",
        plan.stdout
    );
    spec["model"] = crown;
    spec["cycles"] = json!(300);
    spec["accuracy"] = json!({"preset": "draft", "estimate_errors": false});
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["solve", "spec.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    let loads: Vec<f64> = summary["stations"]
        .as_array()
        .expect("sections")
        .iter()
        .map(|station| number(&station["line_load_n_per_mm"]))
        .collect();
    // The middle carries most, the ends nothing.
    assert!(loads.windows(2).all(|pair| pair[0] >= pair[1]), "{loads:?}");
    assert!(loads[0] > 3.0 && loads[loads.len() - 1] <= 0.0, "{loads:?}");
}

/// Integral over places of values by the trapezoidal rule.
fn trapezoidal(at: &[f64], values: &[f64]) -> f64 {
    let pairs = at.windows(2).zip(values.windows(2));
    pairs
        .map(|(at, values)| 0.5 * (at[1] - at[0]) * (values[0] + values[1]))
        .sum()
}

/// The maps of worn depth of lines and of a width hold the worn volume of the summary to their seven digits; of a ring with the length of its centre line, 0.4826 mm from the
/// axis.
#[test]
fn maps_along_a_line_hold_the_worn_volume() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut crown = document("sd_card_crown.json");
    crown["cycles"] = json!(40);
    crown["accuracy"] = json!({"preset": "draft"});
    crown["stop"] = json!([]);
    crown["output"] = json!({"snapshots_at_cycles": [40]});
    let mut extruded = document("fuzz_button_extruded.json");
    extruded["model"] =
        json!({"dimension": "extruded", "width_mm": 0.01058, "layers": 4, "layer_growth": 1.5});
    extruded["cycles"] = json!(40);
    extruded["accuracy"] = json!({"preset": "draft"});
    extruded["output"] = json!({"snapshots_at_cycles": [40]});
    for (spec, length_per_place) in [
        (ring(), 0.4826_f64.to_radians()),
        (crown, 1.0),
        (extruded, 1.0),
    ] {
        std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
        let ran = fretwear(folder.path(), &["solve", "spec.json", "--out", "results"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let read = |name: &str| -> Value {
            let text = std::fs::read(folder.path().join("results").join(name)).expect(name);
            serde_json::from_slice(&text).expect("JSON")
        };
        let (maps, summary) = (read("maps-40.json"), read("summary.json"));
        for side in ["receptacle", "slider"] {
            let map = &maps[side];
            let along = if map["theta_deg"].is_array() {
                numbers(&map["theta_deg"])
            } else {
                numbers(&map["z_mm"])
            };
            assert!(along.windows(2).all(|pair| pair[0] < pair[1]), "{along:?}");
            let rows = map["depth_mm"].as_array().expect("rows");
            let sections: Vec<f64> = rows
                .iter()
                .map(|row| trapezoidal(&along, &numbers(row)))
                .collect();
            let volume = length_per_place * trapezoidal(&numbers(&map["x_mm"]), &sections);
            let worn = number(&summary[side]["worn_volume_mm3"]);
            assert!(
                (volume - worn).abs() <= 1e-6 * worn,
                "{side}: {volume} {worn}"
            );
        }
        let picture = folder.path().join("results").join("maps-40.svg");
        assert!(
            std::fs::read_to_string(picture)
                .expect("a picture")
                .contains("depth")
        );
    }
}
