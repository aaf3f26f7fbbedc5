//! The bits of a job's results, for comparing runs.

use serde_json::Value;

use crate::Server;

/// Everything in a finished job that must not depend on interruptions: name and checksum of each result, and the
/// summary without its cost.
///
/// # Panics
/// If the service does not answer.
pub async fn of(server: &Server, id: &str) -> Value {
    let (_, mut job) = server.get(&format!("/v1/jobs/{id}")).await;
    let (status, manifest) = server.get(&format!("/v1/jobs/{id}/results")).await;
    assert_eq!(status, 200, "{manifest}");
    if let Some(summary) = job["summary"].as_object_mut() {
        summary.remove("cost");
    }
    let files: Vec<Value> = manifest["files"]
        .as_array()
        .unwrap_or_else(|| panic!("{manifest}"))
        .iter()
        .filter(|file| file["name"] != "summary.json")
        .cloned()
        .collect();
    assert!(!files.is_empty(), "{manifest}");
    serde_json::json!([job["status"], job["outcome"], job["summary"], files])
}

/// Data of a job's events of one name; checks that the events have no gaps and end with `done` if the job has ended.
///
/// # Panics
/// If the numbers of the events have gaps, or `done` is missing or not the last.
pub async fn events(server: &Server, id: &str, name: &str) -> Vec<Value> {
    let url = format!("{}/v1/jobs/{id}/events", server.base);
    let request = server.client.get(url).header("last-event-id", "0");
    let text = request.send().await.expect("a stream").text().await;
    let text = text.expect("the stream ends");
    let (mut found, mut next, mut names) = (Vec::new(), 1, Vec::new());
    for block in text.split("\n\n").filter(|block| block.contains("event:")) {
        let field = |field: &str| {
            let line = block.lines().find(|line| line.starts_with(field));
            line.map(|line| line[field.len()..].trim().to_owned())
        };
        let event = field("event:").expect("an event has a name");
        let number = field("id:").expect("an event has a number");
        assert_eq!(number.parse(), Ok(next), "events of {id} have gaps");
        next += 1;
        if event == name {
            let data = field("data:").expect("an event has data");
            found.push(serde_json::from_str(&data).expect("data are JSON"));
        }
        names.push(event);
    }
    let done = names.iter().position(|name| name == "done");
    assert_eq!(done, Some(names.len() - 1), "{id}: `done` comes once, last");
    found
}
