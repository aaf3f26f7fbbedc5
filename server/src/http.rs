//! HTTP server: router, and what the routes share.

mod access;
mod app;
mod arrival;
mod bodies;
mod body_limits;
mod compression;
mod connections;
mod disk_space;
mod extract;
pub mod idempotency_key;
mod job_error;
mod limits;
mod listener;
pub mod openapi;
mod paging;
mod problem;
mod problem_type;
mod routes;
mod slots;
mod table;
mod tls;
mod verified_file;
mod worker_access;
mod worker_body;
mod worker_registry;

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderValue, Method, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use axum::{Router, middleware};
use tower_http::set_header::SetResponseHeaderLayer;
use tower_http::trace::TraceLayer;

use crate::metrics::Metrics;
use problem::ProblemType;

pub use access::{Access, TokenError};
pub use app::App;
pub(crate) use limits::check as check_limits;
pub use listener::serve;
pub use tls::{Tls, TlsError};
pub(crate) use worker_registry::WorkerRegistry;

/// `Content-Security-Policy` of everything but the pages: a browser loads and runs nothing.
const DEFAULT_CONTENT_POLICY: &str = "default-src 'none'; frame-ancestors 'none'";

/// Router of all routes.
pub fn router(app: App) -> Router {
    let access = middleware::from_fn_with_state(app.access.clone(), access::check);
    let worker_access = middleware::from_fn_with_state(app.clone(), worker_access::check);
    let requests = middleware::from_fn_with_state(app.clone(), bodies::admit);
    let disk_space = middleware::map_response_with_state(app.clone(), disk_space::explain);
    let metrics = Arc::clone(app.store.metrics());
    let observed = middleware::from_fn_with_state(metrics, observe);
    table::routes_and_document()
        .0
        .route_layer(requests)
        .route_layer(observed)
        .fallback(no_such_path)
        .method_not_allowed_fallback(wrong_method)
        .layer(disk_space)
        .layer(compression::layer())
        .layer(middleware::map_response(compression::weaken_etag))
        .layer(middleware::map_request(compression::accept_identity))
        .layer(worker_access)
        .layer(access)
        .layer(SetResponseHeaderLayer::if_not_present(
            header::CONTENT_SECURITY_POLICY,
            HeaderValue::from_static(DEFAULT_CONTENT_POLICY),
        ))
        .layer(SetResponseHeaderLayer::if_not_present(
            header::X_CONTENT_TYPE_OPTIONS,
            HeaderValue::from_static("nosniff"),
        ))
        .layer(TraceLayer::new_for_http())
        .with_state(app)
}

/// Middleware that counts the answers of each route, and their time.
async fn observe(
    State(metrics): State<Arc<Metrics>>,
    route: MatchedPath,
    request: Request,
    next: Next,
) -> Response {
    let (method, began) = (request.method().clone(), Instant::now());
    let response = next.run(request).await;
    let status = response.status().as_u16();
    metrics.answered(method.as_str(), route.as_str(), status, began.elapsed());
    response
}

async fn no_such_path(uri: Uri) -> Response {
    ProblemType::NO_SUCH_PATH
        .with_detail(format!("there is no route {}", uri.path()))
        .into_response()
}

async fn wrong_method(method: Method, uri: Uri) -> Response {
    ProblemType::WRONG_METHOD
        .with_detail(format!("{} does not support {method}", uri.path()))
        .into_response()
}

#[cfg(test)]
pub(crate) mod tests;
