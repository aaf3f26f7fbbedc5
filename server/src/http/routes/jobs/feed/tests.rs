//! Content of a stream of all changes: with the service stopped it ends after what there is.

use crate::http::tests::Service;
use serde_json::Value;

/// Events of a feed: name, id, document.
async fn feed(service: &Service, after: Option<i64>) -> Vec<(String, i64, Value)> {
    service.app.stopping.cancel();
    let after = after.map(|id| id.to_string());
    let headers: Vec<(&str, &str)> = after
        .iter()
        .map(|id| ("last-event-id", id.as_str()))
        .collect();
    let (status, _, text) = service.text("GET", "/v1/events", &headers, "").await;
    assert_eq!(status, 200);
    let field = |block: &str, name: &str| {
        let mut lines = block.lines();
        lines.find_map(|line| line.strip_prefix(name).map(|value| value.trim().to_owned()))
    };
    text.split("\n\n")
        .filter_map(|block| {
            let id = field(block, "id:")?.parse().expect("a number");
            let data = serde_json::from_str(&field(block, "data:")?).expect("JSON");
            Some((field(block, "event:")?, id, data))
        })
        .collect()
}

const SPEC: &str = r#"{"system":{"kind":"dimm"}}"#;

#[tokio::test]
async fn a_new_feed_begins_with_the_present_revision() {
    let service = Service::new().await;
    service.queued(SPEC).await;
    let events = feed(&service, None).await;
    assert_eq!(events.len(), 1);
    assert_eq!((events[0].0.as_str(), events[0].1), ("start", 1));
}

#[tokio::test]
async fn jobs_are_sent_once_each_as_they_are_now_and_deletions_as_such() {
    let service = Service::new().await;
    let first = service.queued(SPEC).await;
    let second = service.queued(SPEC).await;
    let third = service.queued(SPEC).await;
    for id in [&first, &third] {
        service.post(&format!("/v1/jobs/{id}/cancel"), "").await;
    }
    service
        .send("DELETE", &format!("/v1/jobs/{third}"), &[], "")
        .await;
    let events = feed(&service, Some(0)).await;
    let seen: Vec<(&str, &str, &str)> = events
        .iter()
        .map(|(name, _, data)| {
            let text = |field: &str| data[field].as_str().unwrap_or_default();
            (name.as_str(), text("id"), text("status"))
        })
        .collect();
    let expected = [
        ("job", second.as_str(), "queued"),
        ("job", first.as_str(), "cancelled"),
        ("deleted", third.as_str(), ""),
    ];
    assert_eq!(seen, expected);
    assert!(events.is_sorted_by(|a, b| a.1 < b.1));
    // The same document as in a list.
    let (_, _, list) = service.get("/v1/jobs").await;
    assert_eq!(list["jobs"][1], events[1].2);
}

#[tokio::test]
async fn a_feed_resumes_after_the_last_event_that_was_received() {
    let service = Service::new().await;
    service.queued(SPEC).await;
    let id = service.queued(SPEC).await;
    let all = feed(&service, Some(0)).await;
    let rest = feed(&service, Some(all[0].1)).await;
    assert_eq!(rest, all[1..]);
    assert_eq!(rest[0].2["id"], id);
    assert_eq!(feed(&service, Some(all[1].1)).await, []);
}

#[tokio::test]
async fn a_revision_that_was_never_given_is_reset() {
    let service = Service::new().await;
    service.queued(SPEC).await;
    let events = feed(&service, Some(99)).await;
    assert_eq!((events[0].0.as_str(), events[0].1), ("reset", 1));
    let (status, ..) = service
        .send("GET", "/v1/events", &[("last-event-id", "x")], "")
        .await;
    assert_eq!(status, 400);
}
