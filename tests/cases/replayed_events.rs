//! Requirement: the event stream of a finished job replays from any `Last-Event-ID`.

use eventsource_stream::Eventsource;
use futures_util::StreamExt;
use tests::{Server, spec};

/// Ids and names of a stream, to its end.
async fn stream(server: &Server, id: &str, after: Option<&str>) -> Vec<(String, String)> {
    let mut request = server
        .client
        .get(format!("{}/v1/jobs/{id}/events", server.base));
    if let Some(after) = after {
        request = request.header("Last-Event-ID", after);
    }
    let response = request.send().await.expect("the service answers");
    assert_eq!(response.status(), 200);
    let mut events = response.bytes_stream().eventsource();
    let mut seen = Vec::new();
    while let Some(event) = events.next().await {
        let event = event.expect("the stream is whole");
        seen.push((event.id, event.event));
    }
    seen
}

#[tokio::test]
async fn a_finished_job_replays_from_any_event() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let body = std::fs::read(spec("mccoll.json")).expect("the specification is there");
    let (_, job) = server.submit(body).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let live = stream(&server, &id, None).await;
    assert_eq!(live.last().map(|event| event.1.as_str()), Some("done"));

    let all = stream(&server, &id, Some("0")).await;
    let ids: Vec<u64> = all.iter().filter_map(|(id, _)| id.parse().ok()).collect();
    let durable: Vec<u64> = (1..=ids.last().copied().expect("there are events")).collect();
    assert_eq!(ids, durable, "ids count without gaps");
    for after in [1, durable.len() / 2, durable.len() - 1] {
        let rest = stream(&server, &id, Some(&after.to_string())).await;
        assert_eq!(
            rest,
            all[all.len() - (durable.len() - after)..],
            "after {after}"
        );
    }
}
