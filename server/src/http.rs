//! HTTP server: router, and what the routes share.

mod access;
mod body_problems;
mod extract;
mod idempotency_key;
mod job_error;
mod limits;
mod listener;
pub mod openapi;
mod paging;
mod problem;
mod routes;

use std::sync::Arc;

use axum::http::{HeaderValue, Method, Uri, header};
use axum::response::{IntoResponse, Response};
use axum::{Router, middleware};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;
use tower::limit::GlobalConcurrencyLimitLayer;
use tower_http::set_header::SetResponseHeaderLayer;
use tower_http::trace::TraceLayer;
use utoipa::OpenApi;
use utoipa::openapi::OpenApi as Document;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::estimate::machine::CalibrationCache;
use crate::store::Store;

use problem::ProblemType;
use routes::{batches, jobs, operation, results, systems};

pub use access::{Access, TokenError};
pub use listener::serve;

/// Maximum number of concurrent requests, over all connections; more wait. Event streams count until their response
/// starts; long polls have a lower limit of their own.
const MAX_REQUESTS: usize = 1024;
/// Maximum number of waiting long polls; another one is answered at once, as if it had timed out.
const MAX_LONG_POLLS: usize = 768;
/// Maximum number of open event streams.
const MAX_STREAMS: usize = 1024;
/// `Content-Security-Policy` of everything but the pages: a browser loads and runs nothing.
const DEFAULT_CONTENT_POLICY: &str = "default-src 'none'; frame-ancestors 'none'";
/// Maximum size of a body, bytes.
const MAX_BODY_BYTES: usize = 1 << 20;

/// State that the routes share.
#[derive(Debug, Clone)]
pub struct App {
    /// Job store.
    pub store: Arc<Store>,
    /// Cancelled at shutdown; ends streams and long polls.
    pub stopping: CancellationToken,
    access: Access,
    /// Measured speed of this machine.
    machine: CalibrationCache,
    archive_permits: Arc<Semaphore>,
    /// Permits to expand a batch into its jobs.
    expansion_permits: Arc<Semaphore>,
    long_poll_permits: Arc<Semaphore>,
    stream_permits: Arc<Semaphore>,
}

impl App {
    /// State over a store.
    pub fn new(store: Arc<Store>, access: Access, stopping: CancellationToken) -> Self {
        Self {
            machine: CalibrationCache::open(Some(store.machine_file())),
            store,
            stopping,
            access,
            archive_permits: Arc::new(Semaphore::new(results::download_archive::MAX_ARCHIVES)),
            expansion_permits: Arc::new(Semaphore::new(batches::submit::MAX_EXPANSIONS)),
            long_poll_permits: Arc::new(Semaphore::new(MAX_LONG_POLLS)),
            stream_permits: Arc::new(Semaphore::new(MAX_STREAMS)),
        }
    }
}

#[derive(OpenApi)]
#[openapi(
    components(schemas(
        results::read_snapshot::Format,
        batches::picture::PictureFormat,
        results::read_history::HistoryFormat,
        api::event::Done
    )),
    info(
        title = "fretwear",
        description = "Wear of electrical contacts under vibration: submit jobs, follow them, fetch their results."
    )
)]
struct Interface;

/// Router of all routes.
pub fn router(app: App) -> Router {
    let access = middleware::from_fn_with_state(app.access.clone(), access::check);
    routes_and_document()
        .0
        .fallback(no_such_path)
        .method_not_allowed_fallback(wrong_method)
        .layer(access)
        .layer(GlobalConcurrencyLimitLayer::new(MAX_REQUESTS))
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

/// The routes and their OpenAPI document.
fn routes_and_document() -> (Router<App>, Document) {
    OpenApiRouter::with_openapi(Interface::openapi())
        .routes(routes!(jobs::submit::submit, jobs::list::list))
        .routes(routes!(jobs::show::show, jobs::delete::remove))
        .routes(routes!(jobs::cancel::cancel))
        .routes(routes!(jobs::stream::events))
        .routes(routes!(results::list::manifest))
        .routes(routes!(results::download_file::file))
        .routes(routes!(results::download_archive::archive))
        .routes(routes!(results::read_history::wear_history))
        .routes(routes!(results::read_snapshot::profile))
        .routes(routes!(results::read_snapshot::pressure))
        .routes(routes!(results::read_snapshot::friction_loop))
        .routes(routes!(
            batches::submit::submit_sweep,
            batches::list::list_sweeps
        ))
        .routes(routes!(
            batches::show::show_sweep,
            batches::delete::remove_sweep
        ))
        .routes(routes!(batches::outcomes::sweep_outcomes))
        .routes(routes!(batches::cancel::cancel_sweep))
        .routes(routes!(
            batches::submit::submit_study,
            batches::list::list_studies
        ))
        .routes(routes!(
            batches::show::show_study,
            batches::delete::remove_study
        ))
        .routes(routes!(batches::outcomes::study_table))
        .routes(routes!(batches::picture::study_picture))
        .routes(routes!(batches::cancel::cancel_study))
        .routes(routes!(jobs::plan::make_plan))
        .routes(routes!(systems::list::systems))
        .routes(routes!(systems::show::system))
        .routes(routes!(operation::serve_pages::dashboard))
        .routes(routes!(operation::serve_pages::docs))
        .routes(routes!(operation::serve_pages::asset))
        .routes(routes!(operation::show_openapi::openapi))
        .routes(routes!(operation::check_health::healthz))
        .routes(routes!(operation::check_health::readyz))
        .routes(routes!(operation::show_metrics::metrics))
        .split_for_parts()
}

async fn no_such_path(uri: Uri) -> Response {
    ProblemType::NoSuchPath
        .with_detail(format!("there is no route {}", uri.path()))
        .into_response()
}

async fn wrong_method(method: Method, uri: Uri) -> Response {
    ProblemType::WrongMethod
        .with_detail(format!("{} does not support {method}", uri.path()))
        .into_response()
}

#[cfg(test)]
pub(crate) mod tests;
