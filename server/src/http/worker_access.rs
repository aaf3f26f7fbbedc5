//! Access of remote workers: where the service requires a token, they need one of their own that is not revoked.

use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::http::access::{is_for_workers, sent_digest, token_required};
use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Middleware that rejects requests of workers without a token.
pub(super) async fn check(State(app): State<App>, request: Request, next: Next) -> Response {
    if app.access.requires_token() && is_for_workers(&request) {
        let digest = sent_digest(request.headers());
        match app.store.accepts_worker_token(&digest).await {
            Ok(true) => {}
            Ok(false) => {
                return token_required(
                    "send `Authorization: Bearer TOKEN` with a token for workers that is not revoked; \
                     `fretwear worker-token create` makes one",
                );
            }
            Err(error) => return ProblemResponse::from(error).into_response(),
        }
    }
    next.run(request).await
}
