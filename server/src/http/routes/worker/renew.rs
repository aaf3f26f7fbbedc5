//! `POST /v1/worker/leases`: the heartbeat of a worker for all its jobs.

use axum::extract::State;
use axum::{Extension, Json};

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::worker_access::WorkerToken;
use crate::http::worker_body::WorkerBody;
use crate::store::LeaseState;
use crate::worker::protocol::{LeasesBody, MOST_LEASES, lease_length};

/// Renews leases; answers with their states, in the same order.
pub(crate) async fn renew(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    WorkerBody(body): WorkerBody<LeasesBody>,
) -> Result<Json<Vec<LeaseState>>, ProblemResponse> {
    if body.leases.len() > MOST_LEASES {
        let detail = format!("{} leases, {MOST_LEASES} at most", body.leases.len());
        return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
    }
    app.workers.beats(body.worker, body.failing.as_deref());
    let (leases, length) = (&body.leases, lease_length(body.length));
    Ok(Json(app.store.heartbeat(leases, length, token.0).await?))
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use uuid::Uuid;

    use super::*;
    use crate::http::tests::Service;
    use crate::store::Lease;

    #[tokio::test]
    async fn a_heartbeat_has_a_largest_number_of_leases_and_of_bytes() {
        let service = Service::new().await;
        let beats = async |count: usize, failing: Option<String>| {
            let lease = Lease {
                job: Uuid::max(),
                number: i64::MAX,
            };
            let leases = vec![lease; count];
            let length = std::time::Duration::from_secs(9);
            let body = json!({"worker": Uuid::max(), "leases": leases, "length": length, "failing": failing});
            let (status, _, answer) = service.post("/v1/worker/leases", &body.to_string()).await;
            (status.as_u16(), answer)
        };
        let (status, states) = beats(MOST_LEASES, None).await;
        assert_eq!(status, 200, "{states}");
        assert_eq!(states.as_array().map(Vec::len), Some(MOST_LEASES));
        let (status, problem) = beats(MOST_LEASES + 1, None).await;
        let detail = problem["detail"].as_str().expect("a sentence");
        assert_eq!((status, detail), (400, "4097 leases, 4096 at most"));
        let (status, problem) = beats(1, Some("x".repeat(1 << 20))).await;
        let detail = problem["detail"].as_str().expect("a sentence");
        assert_eq!(
            (status, detail),
            (413, "the body has more than 1048576 bytes")
        );
    }
}
