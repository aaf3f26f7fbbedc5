//! Requirement: `POST /v1/studies` queues the runs of a study as ordinary jobs; after their end, errors, Pareto front,
//! observed orders, table and picture are available.

use serde_json::json;
use tests::Server;

#[tokio::test]
async fn an_accuracy_study_runs_as_jobs_of_the_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let request = json!({
        "name": "short fretting test",
        "base": {
            "system": {"kind": "cylinder_on_flat", "radius_mm": 6.0, "flat_length_mm": 12.0, "flat_height_mm": 6.0},
            "load": {"kind": "line_force", "n_per_mm": 18.5},
            "cycles": 100, "accuracy": {"preset": "draft"}
        },
        "budget_s": 4
    });
    let (status, study) = server.post_json("/v1/studies", &request).await;
    assert_eq!(status, 202);
    let path = format!("/v1/studies/{}", study["id"].as_str().expect("an id"));
    let jobs = study["jobs"].as_array().expect("jobs");
    assert!(jobs.len() >= 12, "{study}");
    let document = server.batch_ended(&path).await;
    assert_eq!(document["counts"]["succeeded"], jobs.len(), "{document}");
    let study = &document["study"];
    let runs = study["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), jobs.len());
    assert!(runs.iter().any(|run| run["on_front"] == true));
    for run in runs {
        assert!(run["errors"]["depth"].as_f64().expect("an error") >= 0.0);
        assert!(run["cpu_s"].as_f64() > Some(0.0));
    }
    let orders = study["reference"]["orders"].as_array().expect("orders");
    assert!(!orders.is_empty(), "{}", study["reference"]);

    let (status, table) = server.get(&format!("{path}/table")).await;
    assert_eq!(status, 200);
    let table = table.as_str().expect("CSV");
    assert_eq!(table.lines().count(), runs.len() + 1, "{table}");
    let picture = |format: &str| {
        let picture = format!("{}{path}/picture?format={format}", server.base);
        let client = server.client.clone();
        async move {
            let answer = client.get(picture).send().await.expect("an answer");
            answer.bytes().await.expect("a body")
        }
    };
    let drawing = String::from_utf8(picture("svg").await.to_vec()).expect("text");
    assert!(drawing.contains("processor time (s)"), "{drawing}");
}
