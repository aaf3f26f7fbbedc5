//! The limit of concurrent requests, and bodies that do not arrive.

use std::task::Poll;

use axum::body::Body;
use axum::http::Request;
use futures_util::stream;
use tokio::sync::mpsc::{UnboundedSender, unbounded_channel};
use tokio::task::JoinSet;
use tower::ServiceExt;

use super::Service;
use crate::http::app::MAX_REQUESTS;
use crate::http::router;

fn post_request(path: &str, body: Body) -> Request<Body> {
    let request = Request::post(path).header("host", "127.0.0.1");
    let request = request.header("content-type", "application/json");
    request.body(body).expect("a request")
}

fn get_request(path: &str) -> Request<Body> {
    let request = Request::get(path).header("host", "127.0.0.1");
    request.body(Body::empty()).expect("a request")
}

/// A body that says that it is waited for and never ends.
fn endless_body(waited_for: &UnboundedSender<()>) -> Body {
    let mut waited_for = Some(waited_for.clone());
    let never = stream::poll_fn(move |_| {
        if let Some(waited_for) = waited_for.take() {
            waited_for.send(()).expect("the test listens");
        }
        Poll::Pending::<Option<Result<Vec<u8>, std::io::Error>>>
    });
    Body::from_stream(never)
}

#[tokio::test]
async fn unfinished_bodies_keep_no_request_waiting() {
    let service = Service::new().await;
    let router = router(service.app.clone());
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let claim = service.app.store.claim_next(i64::MAX).await;
    let lease = claim.expect("a job").lease;
    let file = format!("/v1/worker/files/{id}/{lease}/a.vtu?sha256=00");
    let (waited_for, mut waits) = unbounded_channel();
    let mut open = JoinSet::new();
    for number in 0..=MAX_REQUESTS {
        let body = endless_body(&waited_for);
        let request = match number % 3 {
            0 => post_request("/v1/plans", body),
            1 => post_request("/v1/worker/writes", body),
            _ => {
                let request = Request::put(&file).header("host", "127.0.0.1");
                request.body(body).expect("a request")
            }
        };
        open.spawn(router.clone().oneshot(request));
        waits.recv().await.expect("its body is waited for");
    }
    for path in ["/v1/jobs", "/healthz"] {
        let answer = router.clone().oneshot(get_request(path)).await;
        assert_eq!(answer.expect("an answer").status(), 200, "{path}");
    }
    assert!(open.try_join_next().is_none(), "all are still unfinished");
}

#[tokio::test]
async fn concurrent_requests_are_limited() {
    let service = Service::new().await;
    let router = router(service.app.clone());
    let most = u32::try_from(MAX_REQUESTS).expect("a number");
    let others = service.app.request_permits.acquire_many(most).await;
    let mut waiting = [
        get_request("/v1/jobs"),
        post_request("/v1/plans", Body::from("{}")),
    ]
    .map(|request| Box::pin(router.clone().oneshot(request)));
    for request in &mut waiting {
        assert!(futures_util::poll!(request).is_pending());
    }
    for path in ["/healthz", "/readyz"] {
        let answer = router.clone().oneshot(get_request(path)).await;
        assert_eq!(answer.expect("an answer").status(), 200, "{path}");
    }
    drop(others);
    let [list, plan] = waiting;
    assert_eq!(list.await.expect("an answer").status(), 200);
    assert_eq!(plan.await.expect("an answer").status(), 400);
}
