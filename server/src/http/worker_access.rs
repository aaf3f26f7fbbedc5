//! Access of remote workers: where the service requires a token, they need one of their own that is not revoked. It gives access to the leases
//! that jobs were claimed under with it, and to no others: these are as lost to it.

use std::collections::HashSet;

use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::http::access::{is_for_workers, sent_digest, token_required};
use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::store::{Lease, Store, StoreError};

/// The token of a worker's request; `None` where the service requires none.
#[derive(Debug, Clone, Copy)]
pub(super) struct WorkerToken(pub(super) Option<Uuid>);

impl WorkerToken {
    /// Those leases that jobs were claimed under with this token; all without one.
    pub(super) async fn owned(
        self,
        store: &Store,
        leases: impl IntoIterator<Item = Lease>,
    ) -> Result<HashSet<Lease>, StoreError> {
        let leases: Vec<_> = leases.into_iter().collect();
        let owned = match self.0 {
            Some(token) => store.owned(token, &leases).await?,
            None => leases,
        };
        Ok(owned.into_iter().collect())
    }

    /// Checks whether a job was claimed under a lease with this token.
    pub(super) async fn owns(self, store: &Store, lease: Lease) -> Result<bool, StoreError> {
        Ok(self.owned(store, [lease]).await?.contains(&lease))
    }
}

/// Middleware that rejects requests of workers without a token, and notes the token of the others.
pub(super) async fn check(State(app): State<App>, mut request: Request, next: Next) -> Response {
    if is_for_workers(&request) {
        let mut token = None;
        if app.access.requires_token() {
            let digest = sent_digest(request.headers());
            token = match app.store.valid_worker_token(&digest).await {
                Ok(Some(token)) => Some(token),
                Ok(None) => {
                    return token_required(
                        "send `Authorization: Bearer TOKEN` with a token for workers that is not revoked; \
                         `fretwear worker-token create` makes one",
                    );
                }
                Err(error) => return ProblemResponse::from(error).into_response(),
            };
        }
        request.extensions_mut().insert(WorkerToken(token));
    }
    next.run(request).await
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use serde_json::{Value, json};
    use sha2::{Digest, Sha256};

    use super::*;
    use crate::export::files::sha256;
    use crate::http::Access;
    use crate::http::tests::Service;
    use crate::store::tests::request;
    use crate::worker::protocol::PROGRAM;

    const USERS: &str = "0123456789abcdef";

    /// A service that requires tokens, and those of two workers.
    async fn service() -> (Service, [&'static str; 2]) {
        let mut service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        service.app.access = Access::new(Some(USERS), &[]).expect("access");
        let tokens = ["token-of-the-owner", "token-of-another"];
        for token in tokens {
            let digest = Sha256::digest(token).into();
            let added = service.app.store.add_worker_token(token, &digest).await;
            added.expect("the store");
        }
        (service, tokens)
    }

    /// Claims the job of the service, and repeats it with the other token; the lease.
    async fn claimed(service: &Service, [owner, other]: [&str; 2]) -> Value {
        let claim = json!({
            "program": PROGRAM, "host": "n1", "slots": 1, "wait": Duration::ZERO,
            "request": request(10_000, Duration::from_secs(9)),
        });
        let claim = claim.to_string();
        let claims = "/v1/worker/claims";
        let (_, claimed) = (service.with_token("POST", claims, Some(owner), &claim)).await;
        let again = (service.with_token("POST", claims, Some(other), &claim)).await;
        assert_eq!(again, (200, json!([])));
        json!({"job": claimed[0]["id"], "number": claimed[0]["lease"]})
    }

    #[tokio::test]
    async fn a_token_has_no_access_to_the_leases_of_another() {
        let (service, tokens) = service().await;
        let lease = claimed(&service, tokens).await;
        let update = json!({
            "number": 1, "progress": {"cycle": 0, "cycles": 1, "fraction": 0.0},
            "rows": [], "snapshots": [], "files": [], "checkpoint": null, "events": [],
        });
        let write = |kind| json!([{"lease": lease, "update": update, "kind": kind}]).to_string();
        let length = Duration::from_secs(9);
        let renewal = write(json!({ "renew": length }));
        let end =
            json!({"transition": "fail", "reason": "it is mine", "outcome": null, "summary": null});
        let end = write(json!({ "end": end }));
        let beat =
            json!({"worker": Uuid::now_v7(), "leases": [lease], "length": length, "failing": null});
        let restart = json!({"lease": lease, "number": 2}).to_string();
        let of_lease = format!(
            "{}/{}",
            lease["job"].as_str().expect("an id"),
            lease["number"]
        );
        let file = format!(
            "/v1/worker/files/{of_lease}/a.vtu?sha256={}",
            sha256(b"fields")
        );
        let checkpoint = format!("/v1/worker/checkpoints/{of_lease}");
        let (lost, held) = (json!("lost"), json!({"held": {"cancel_requested": false}}));
        // Method, path, body; answers to another token and to that of the lease.
        let cases = [
            (
                "POST",
                "/v1/worker/leases",
                beat.to_string(),
                json!([lost]),
                json!([held]),
            ),
            (
                "POST",
                "/v1/worker/writes",
                renewal,
                json!([{"lease": lost}]),
                json!([{"lease": held}]),
            ),
            ("PUT", &file, "fields".to_owned(), json!(409), json!(200)),
            ("GET", &checkpoint, String::new(), json!(null), json!(null)),
            (
                "POST",
                "/v1/worker/restarts",
                restart,
                lost.clone(),
                held.clone(),
            ),
            (
                "POST",
                "/v1/worker/writes",
                end.replace("\"number\":1", "\"number\":3"),
                json!([{"status": null}]),
                json!([{"status": "failed"}]),
            ),
        ];
        let [owner, other] = tokens;
        for (method, path, body, refused, done) in cases {
            for (token, expected) in [(other, refused), (owner, done)] {
                let (status, answer) = service.with_token(method, path, Some(token), &body).await;
                let answer = if method == "PUT" {
                    json!(status)
                } else {
                    answer
                };
                assert_eq!(answer, expected, "{token}: {method} {path}");
            }
        }
        for token in [None, Some(USERS), Some("token-of-nobody")] {
            let (status, _) = service.with_token("GET", &checkpoint, token, "").await;
            assert_eq!(status, 401);
        }
    }
}
