//! Requirement: a dimple on a pad is a job like any other. It reports volumes and maps of the whole contact, and says when plane strain
//! misjudges a life.

use std::path::Path;

use serde_json::{Value, json};
use tests::{Server, fretwear, spec};

/// The dimple of a memory card's spring until its gold is through.
fn dimple() -> Value {
    let text = std::fs::read(spec("sd_card_dimple.json")).expect("the specification is there");
    serde_json::from_slice(&text).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn last(column: &Value) -> f64 {
    let values = column.as_array().expect("a column");
    number(values.last().expect("a row"))
}

/// Volume below a map, and its deepest place.
fn measured(map: &Value) -> (f64, f64) {
    let place = |axis: &str, index: usize| number(&map[axis][index]);
    let cell = (place("x_mm", 1) - place("x_mm", 0)) * (place("z_mm", 1) - place("z_mm", 0));
    let rows = map["depth_mm"].as_array().expect("rows").iter();
    let depths = rows
        .flat_map(|row| row.as_array().expect("a row"))
        .map(number);
    let (sum, most) = depths.fold((0.0, 0.0), |(sum, most): (f64, f64), depth| {
        (sum + depth, most.max(depth))
    });
    (cell * sum, most)
}

#[tokio::test]
async fn a_dimple_is_a_job_with_volumes_and_maps() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let job = server.ended(&dimple()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    assert_eq!(job["outcome"], "stop_condition", "{job}");
    assert_eq!(job["spec"]["model"]["dimension"], "point");
    let summary = &job["summary"];
    let cycles = number(&summary["cycles_done"]);
    assert_eq!(summary["life"][0]["status"], "reached");
    // k F s of hard gold; the last jump has worn some of the nickel below, too.
    let slider = &summary["slider"];
    let volume = 1e-5 / 1_700.0 * 0.5 * 0.08 * cycles;
    assert!(
        (number(&slider["worn_volume_mm3"]) / volume - 1.0).abs() < 1e-2,
        "{slider}"
    );
    assert!((number(&summary["extent"]["load_n"]) - 0.5).abs() < 1e-9);

    let history = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await
        .1;
    assert!(
        (last(&history["slider"]["worn_volume_mm3"]) - number(&slider["worn_volume_mm3"])).abs()
            < 1e-18
    );
    assert!(last(&history["contact_half_length_across_mm"]) > 2.0 * 0.013);

    let files = server.get(&format!("/v1/jobs/{id}/results")).await.1;
    let name = format!("maps-{cycles}.json");
    let mut entries = files["files"].as_array().expect("a list").iter();
    let entry = entries
        .find(|file| file["name"] == name.as_str())
        .expect("maps of the end");
    assert_eq!(entry["media_type"], "application/json");
    let path = format!("/v1/jobs/{id}/results/files/{name}");
    let maps: Value = serde_json::from_slice(&server.bytes_in_the_end(&path).await).expect("JSON");
    for side in ["slider", "receptacle"] {
        let (volume, deepest) = measured(&maps[side]);
        // Values have seven digits.
        let of = |field: &str| number(&summary[side][field]);
        assert!(
            (volume / of("worn_volume_mm3") - 1.0).abs() < 1e-6,
            "{side}"
        );
        assert!((deepest / of("max_depth_mm") - 1.0).abs() < 1e-6, "{side}");
    }
    let pressure = maps["contact"]["pressure_mpa"].as_array().expect("rows");
    let peak = pressure
        .iter()
        .flat_map(|row| row.as_array().expect("a row"))
        .map(number);
    let peak = peak.fold(0.0, f64::max);
    assert!((peak / number(&summary["peak_pressure_mpa"]) - 1.0).abs() < 1e-6);
}

/// Cycles until the gold is through, of a model.
fn life(folder: &Path, model: &Value) -> f64 {
    let mut spec = dimple();
    spec["model"] = model.clone();
    spec["cycles"] = json!(1_000_000);
    spec["accuracy"] = json!({"tolerance": 0.05, "estimate_errors": false});
    if model["dimension"] == "plane_strain" {
        spec["load"]["width_mm"] = json!(0.8);
    }
    std::fs::write(folder.join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(folder, &["solve", "spec.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    assert_eq!(summary["outcome"], "stop_condition");
    number(&summary["cycles_done"])
}

#[test]
fn plane_strain_overrates_the_life_of_a_dimple_twenty_times() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let plane = life(folder.path(), &json!({"dimension": "plane_strain"}));
    let mut before = 0.0;
    for radius in [0.4, 2.0, 10.0] {
        let model = json!({"dimension": "point", "radius_z_mm": radius});
        let point = life(folder.path(), &model);
        println!(
            "radius across {radius} mm: {point} cycles, {:.1} times sooner than {plane}",
            plane / point
        );
        // The flatter the crown, the nearer it is to the section of 0.8 mm.
        assert!(point > before && point < plane);
        before = point;
        if radius < 1.0 {
            // 27.5 of rigid bodies; 20.3 at 2 %, 5 % of either life.
            let sooner = plane / point;
            assert!((18.0..24.0).contains(&sooner), "{sooner}");
        }
    }
}

/// The deck of its section would be another contact.
#[test]
fn a_dimple_has_no_deck_of_a_section() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), dimple().to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["export", "spec.json"]);
    assert_eq!(
        (ran.code, ran.stdout.as_str()),
        (Some(1), ""),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr
            .contains("only a section and extruded bodies have a mesh"),
        "{}",
        ran.stderr
    );
}
