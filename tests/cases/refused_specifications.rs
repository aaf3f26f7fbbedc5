//! Requirement: a specification with an unknown field, a negative radius and an unknown material is refused at once
//! with three faults, each with its JSON pointer; `NaN`, a wrong type or malformed JSON get a 400 with the position; a
//! refused request queues no job.

use serde_json::Value;
use tests::{Server, fretwear};

const THREE_FAULTS: &str = r#"{
  "system": {"kind": "cylinder_on_flat", "radius_mm": -6.0},
  "materials": {"slider": "unobtainium"},
  "cylces": 10
}"#;

const POINTERS: [&str; 3] = ["/cylces", "/materials/slider", "/system/radius_mm"];

#[tokio::test]
async fn three_faults_are_reported_at_once_and_no_job_is_queued() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (status, problem) = server.submit(THREE_FAULTS).await;
    assert_eq!(status, 422, "{problem}");
    let faults = problem["faults"].as_array().expect("faults are listed");
    let mut pointers: Vec<&str> = faults
        .iter()
        .filter_map(|fault| fault["pointer"].as_str())
        .collect();
    pointers.sort_unstable();
    assert_eq!(pointers, POINTERS, "{problem}");

    for broken in [
        r#"{"system": {"kind": "sd_card"}, "cycles": NaN}"#,
        r#"{"system": {"kind": "sd_card"}, "cycles": "many"}"#,
        r#"{"system": {"kind": "sd_card"}"#,
        "",
    ] {
        let (status, problem) = server.submit(broken).await;
        assert_eq!(status, 400, "{broken}: {problem}");
        let text = problem.to_string();
        assert!(text.contains("/cycles") || text.contains("line"), "{text}");
    }
    let (_, list) = server.get("/v1/jobs").await;
    let count = list
        .as_object()
        .into_iter()
        .flat_map(|page| page.values())
        .find_map(Value::as_array);
    assert_eq!(count.map(Vec::len), Some(0), "{list}");
}

#[test]
fn the_command_line_refuses_with_exit_code_two() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("spec.json");
    std::fs::write(&path, THREE_FAULTS).expect("a file can be written");
    let ran = fretwear(folder.path(), &["solve", "spec.json"]);
    assert_eq!(ran.code, Some(2));
    for pointer in POINTERS {
        assert!(ran.stderr.contains(pointer), "{}", ran.stderr);
    }
    assert!(ran.stdout.is_empty(), "{}", ran.stdout);
}
