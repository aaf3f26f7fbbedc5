//! `POST /v1/worker/claims`: claims jobs, and waits for one.

use std::time::Duration;

use axum::extract::State;
use axum::{Extension, Json};
use tokio::time::Instant;
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::worker_access::WorkerToken;
use crate::http::worker_body::WorkerBody;
use crate::queue::Capacity;
use crate::store::{Claim, ClaimRequest};
use crate::worker::JobSource;
use crate::worker::protocol::{ClaimBody, LONGEST_WAIT, MAX_SLOTS, PROGRAM, lease_length};

/// Interval at which a waiting request looks for a job, in case it missed a notification: none waits 5 s longer for that.
const POLL_INTERVAL: Duration = Duration::from_secs(4);

/// The worker cannot work for this service.
#[derive(Debug, thiserror::Error)]
#[error(
    "the worker is fretwear {worker}, the service is {PROGRAM}: install that version on the worker's machine"
)]
pub(crate) struct OtherVersion {
    worker: String,
}

impl RouteError for OtherVersion {
    const TYPE: ProblemType = ProblemType::WORKER_VERSION;
}

/// The worker was drained.
#[derive(Debug, thiserror::Error)]
#[error("worker {0} takes no more jobs: it was drained")]
pub(crate) struct Drained(Uuid);

impl RouteError for Drained {
    const TYPE: ProblemType = ProblemType::WORKER_DRAINED;
}

/// Claims jobs; without one it waits for a while and then claims none. A worker that takes no more jobs gets those of a repeated request.
pub(crate) async fn claim(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    WorkerBody(body): WorkerBody<ClaimBody>,
) -> Result<Json<Vec<Claim>>, ProblemResponse> {
    if body.program != PROGRAM {
        let worker = body.program;
        return Err(OtherVersion { worker }.into());
    }
    let mut request = ClaimRequest {
        is_remote: true,
        token: token.0,
        lease: lease_length(body.request.lease),
        capacity: Capacity {
            slots: body.request.capacity.slots.min(MAX_SLOTS),
            ..body.request.capacity
        },
        ..body.request
    };
    let (worker, memory) = (request.request.worker, request.capacity.memory);
    app.workers.claims(worker, &body.host, body.slots, memory);
    let until = Instant::now() + body.wait.min(LONGEST_WAIT);
    loop {
        let is_draining = app.workers.is_draining(worker);
        if is_draining {
            request.capacity.slots = 0;
        }
        let claims = JobSource::claim(&*app.store, &request).await?;
        if is_draining && claims.is_empty() {
            return Err(Drained(worker).into());
        }
        let may_wait = request.capacity.slots > 0 && !app.stopping.is_cancelled();
        if !claims.is_empty() || !may_wait || Instant::now() >= until {
            return Ok(Json(claims));
        }
        tokio::select! {
            () = app.store.job_waiting() => {}
            () = tokio::time::sleep_until(until.min(Instant::now() + POLL_INTERVAL)) => {}
            () = app.stopping.cancelled() => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use serde_json::{Value, json};

    use crate::http::tests::Service;
    use crate::store::tests::request;
    use crate::worker::protocol::PROGRAM;

    async fn claim(service: &Service, program: &str) -> (u16, Value) {
        let body = json!({
            "program": program,
            "host": "n1",
            "slots": 2,
            "request": request(1_000, Duration::from_secs(9)),
            "wait": Duration::ZERO,
        });
        let (status, _, claims) = service.post("/v1/worker/claims", &body.to_string()).await;
        (status.as_u16(), claims)
    }

    #[tokio::test]
    async fn a_worker_gets_the_next_job_with_its_specification() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, claims) = claim(&service, PROGRAM).await;
        assert_eq!((status, claims[0]["id"].as_str()), (200, Some(id.as_str())));
        let spec = claims[0]["spec"].as_str().expect("JSON");
        assert!(spec.contains("\"dimm\""), "{spec}");
    }

    #[tokio::test]
    async fn a_worker_of_another_version_is_refused_with_a_sentence() {
        let service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, problem) = claim(&service, "0.0.9 (abc)").await;
        assert_eq!(
            (status, &problem["type"]),
            (409, &json!("/problems/worker-version"))
        );
        let detail = problem["detail"].as_str().expect("a sentence");
        assert!(
            detail.contains("0.0.9 (abc)") && detail.contains(PROGRAM),
            "{detail}"
        );
    }
}
