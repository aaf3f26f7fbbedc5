//! The main job: the fuzz-button specification, submitted over HTTP, solved, streamed back.
//!
//! Requirement: `fretwear demo --exit` ends with 0 and a table of worn depth by cycle and station; where the contact
//! is on the flat floor of the groove the depth grows by 2 (k/H) P' = 26.17 nm a cycle, and the worn area equals
//! (k/H) times the accumulated integral of p |slip|.

use serde_json::Value;
use tests::{Server, fretwear, spec};

/// 2 (k/H) P' with k = 0.011, H = 427 MPa and P' = 10 MPa over 0.0508 mm, mm a cycle.
const FLAT_FLOOR: f64 = 2.0 * 0.011 / 427.0 * 0.508;

#[test]
fn the_demo_solves_its_job_and_exits_with_zero() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let ran = fretwear(folder.path(), &["demo", "--exit"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    // The table's last column is the growth in the middle since the row above, nm a cycle.
    let growth = |cycle: &str| -> f64 {
        let row = ran
            .stdout
            .lines()
            .find(|line| line.split('|').nth(1).map(str::trim) == Some(cycle));
        let cells: Vec<&str> = row
            .expect("the row is there")
            .trim_matches('|')
            .split('|')
            .collect();
        let last = cells.last().expect("a row has cells").trim();
        last.parse().expect("growth is a number")
    };
    for cycle in ["1", "150"] {
        let off = growth(cycle) / (1e6 * FLAT_FLOOR) - 1.0;
        assert!(off.abs() < 0.01, "cycle {cycle}: {off}");
    }
}

#[tokio::test]
async fn the_job_wears_the_flat_floor_by_two_passes_a_cycle() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let body = std::fs::read(spec("fuzz_button.json")).expect("the specification is there");
    let (status, job) = server.submit(body).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(
        (&job["status"], &job["outcome"]),
        (&"succeeded".into(), &"completed".into())
    );

    let (_, history) = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    let numbers = |value: &Value| -> Vec<f64> {
        value
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_f64)
            .collect()
    };
    let cycles = numbers(&history["cycle"]);
    let stations = history["stations"]
        .as_array()
        .expect("stations were requested");
    let middle = stations
        .iter()
        .find(|station| station["x_mm"] == 0.0)
        .expect("x = 0 is one");
    let depth = numbers(&middle["depth_mm"]);
    assert_eq!(cycles.len(), depth.len());
    let at = |cycle: f64| {
        let row = cycles.iter().position(|c| (c - cycle).abs() < 0.5);
        depth[row.expect("the cycle was requested")]
    };
    assert!((at(1.0) / FLAT_FLOOR - 1.0).abs() < 0.01);
    assert!(((at(150.0) - at(1.0)) / 149.0 / FLAT_FLOOR - 1.0).abs() < 0.01);
    let residual = job["summary"]["checks"]["worn_area"]
        .as_f64()
        .expect("it is checked");
    assert!(residual < 1e-9, "{residual}");
    assert!((cycles[cycles.len() - 1] - 2000.0).abs() < 0.5);
}
