//! Requirement: of a vibration the slip of a contact follows, or that it does not slip and from which acceleration on it would.

use serde_json::{Value, json};
use tests::{Server, fretwear, spec};

/// The SD card under random vibration, for a minute and at a coarse tolerance.
fn vibrated() -> Value {
    let text = std::fs::read(spec("sd_card_vibration.json")).expect("the specification is there");
    let mut spec: Value = serde_json::from_slice(&text).expect("JSON");
    spec["accuracy"] = json!({"preset": "draft"});
    spec["motion"]["duration_s"] = json!(60);
    spec
}

/// The summary of a specification, solved by the service.
async fn solved(server: &Server, spec: &Value) -> Value {
    let job = server.ended(spec).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    assert_eq!(job["plan"]["motion"], job["summary"]["motion"]);
    job["summary"].clone()
}

#[tokio::test]
async fn a_shaken_card_wears_as_one_that_is_moved_by_its_slip() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let shaken = solved(&server, &vibrated()).await;
    let motion = &shaken["motion"];
    assert_eq!(shaken["cycles_done"], 12_000);
    let mut moved = vibrated();
    moved["cycles"] = json!(12_000);
    moved["motion"] = json!({
        "kind": "reciprocating",
        "amplitude_mm": motion["slip_amplitude_mm"],
        "frequency_hz": 200
    });
    let moved = solved(&server, &moved).await;
    assert!(moved["motion"].is_null());
    assert_eq!(shaken["receptacle"], moved["receptacle"]);
}

#[tokio::test]
async fn a_card_that_its_contacts_hold_does_not_wear() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let mut still = vibrated();
    still["cycles"] = json!(1_000);
    still["motion"] = json!({
        "kind": "vibration", "acceleration_g": 20, "frequency_hz": 200, "mass_g": 2, "contacts": 9
    });
    let summary = solved(&server, &still).await;
    let motion = &summary["motion"];
    let from = motion["slips_from_g"].as_f64().expect("a number");
    assert!((from - 68.83).abs() < 0.01, "{motion}");
    assert_eq!(motion["sticks"], true);
    assert_eq!(summary["receptacle"]["max_depth_mm"], 0.0);
    let file = folder.path().join("still.json");
    std::fs::write(&file, still.to_string()).expect("a file can be written");
    let plan = fretwear(folder.path(), &["plan", "still.json"]);
    let says = plan
        .stdout
        .contains("the contact does not slip, slip begins at 68.831 g");
    assert!(says, "{}", plan.stdout);
}
