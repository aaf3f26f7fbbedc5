//! Replay, live events and end of streams.

use crate::http::tests::Service;
use crate::queue::Transition;
use crate::store::{End, EventName, JobUpdate};

/// Names and ids of a stream's events.
fn parse(text: &str) -> Vec<(String, Option<i64>)> {
    let field = |block: &str, name: &str| {
        block
            .lines()
            .find_map(|line| line.strip_prefix(name).map(|value| value.trim().to_owned()))
    };
    text.split("\n\n")
        .filter_map(|block| {
            let id = field(block, "id:").map(|id| id.parse().expect("a number"));
            field(block, "event:").map(|name| (name, id))
        })
        .collect()
}

async fn finished_job(service: &Service) -> String {
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let store = &service.app.store;
    let claim = store.claim_next(i64::MAX).await.expect("a job");
    let update = JobUpdate {
        events: vec![
            (EventName::Progress, "{}".into()),
            (EventName::Cycle, "{}".into()),
        ],
        ..JobUpdate::default()
    };
    store.record_next(&claim, &update).await;
    store.record_next(&claim, &update).await;
    let end = End {
        transition: Transition::Succeed,
        reason: None,
        outcome: None,
        summary: None,
    };
    store.end_next(&claim, &JobUpdate::default(), &end).await;
    id
}

#[tokio::test]
async fn a_finished_job_replays_from_any_last_event_id() {
    let service = Service::new().await;
    let path = format!("/v1/jobs/{}/events", finished_job(&service).await);
    let new = parse(&service.text("GET", &path, &[], "").await.2);
    assert_eq!(new[0], ("snapshot".to_owned(), None));
    let all = &new[1..];
    let ids: Vec<_> = all.iter().map(|event| event.1.expect("an id")).collect();
    assert_eq!(ids, [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!((all[1].0.as_str(), all[6].0.as_str()), ("attempt", "done"));
    for after in 0..7_usize {
        let header = after.to_string();
        let (status, _, text) = service
            .text("GET", &path, &[("last-event-id", &header)], "")
            .await;
        assert_eq!(status, 200);
        assert_eq!(parse(&text), all[after..], "after {after}");
    }
    for after in ["7", "99"] {
        assert_eq!(
            service
                .text("GET", &path, &[("last-event-id", after)], "")
                .await
                .0,
            204
        );
    }
}

#[tokio::test]
async fn a_live_stream_ends_with_done() {
    let service = Service::new().await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let path = format!("/v1/jobs/{id}/events");
    let (stream, _) = tokio::join!(service.text("GET", &path, &[], ""), async {
        tokio::task::yield_now().await;
        service.post(&format!("/v1/jobs/{id}/cancel"), "").await
    });
    let names: Vec<_> = parse(&stream.2).into_iter().map(|event| event.0).collect();
    assert_eq!(names, ["snapshot", "progress", "done"]);
}

#[tokio::test]
async fn a_stream_from_beyond_the_last_event_ends_with_the_job() {
    let service = Service::new().await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let path = format!("/v1/jobs/{id}/events");
    let beyond = [("last-event-id", "99999")];
    let (stream, _) = tokio::join!(service.text("GET", &path, &beyond, ""), async {
        tokio::task::yield_now().await;
        service.post(&format!("/v1/jobs/{id}/cancel"), "").await
    });
    assert_eq!(parse(&stream.2), []);
}

#[tokio::test]
async fn a_stream_ends_when_the_service_stops() {
    let service = Service::new().await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let path = format!("/v1/jobs/{id}/events");
    let (stream, ()) = tokio::join!(service.text("GET", &path, &[], ""), async {
        tokio::task::yield_now().await;
        service.app.stopping.cancel();
    });
    assert!(!stream.2.contains("event: done"));
}

#[tokio::test]
async fn proxies_neither_store_nor_collect_a_stream() {
    let service = Service::new().await;
    let path = format!("/v1/jobs/{}/events", finished_job(&service).await);
    service.app.stopping.cancel();
    for path in [path.as_str(), "/v1/events"] {
        let (status, headers, _) = service.text("GET", path, &[], "").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "text/event-stream");
        assert_eq!(headers["x-accel-buffering"], "no");
        assert_eq!(headers["cache-control"], "no-store");
    }
}

#[tokio::test]
async fn invalid_event_ids_are_problems() {
    let service = Service::new().await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let path = format!("/v1/jobs/{id}/events");
    assert_eq!(
        service
            .send("GET", &path, &[("last-event-id", "x")], "")
            .await
            .0,
        400
    );
    assert_eq!(
        service
            .get("/v1/jobs/00000000-0000-7000-8000-000000000000/events")
            .await
            .0,
        404
    );
}

#[tokio::test]
async fn a_stream_over_the_limit_is_rejected() {
    let service = Service::new().await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let all = u32::try_from(crate::http::app::MAX_STREAMS).expect("a count");
    let taken = service
        .app
        .stream_permits
        .clone()
        .acquire_many_owned(all)
        .await;
    let path = format!("/v1/jobs/{id}/events");
    let (status, headers, problem) = service.get(&path).await;
    assert_eq!(
        (status.as_u16(), problem["type"].as_str()),
        (503, Some("/problems/busy"))
    );
    assert_eq!(headers["retry-after"], "5");
    drop(taken);
    service.post(&format!("/v1/jobs/{id}/cancel"), "").await;
    assert_eq!(service.text("GET", &path, &[], "").await.0, 200);
}
