//! HTTP: one file a route, each in the order error, handler, tests.

mod access;
mod body_problems;
mod extract;
mod job_error;
mod limits;
mod listener;
mod paging;
mod problem;
mod request_key;
mod routes;

pub use routes::operation::openapi;

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

use routes::{batches, jobs, operation, results, systems};

pub use access::{Access, TokenError};
pub use listener::serve;

/// Requests that are worked on at once, over all connections; more wait. Streams count until they have begun, and long
/// polls have a limit of their own below it.
const REQUESTS: usize = 1024;
/// Long polls that wait at once; one more is answered at once, as if its time were over.
const LONG_POLLS: usize = 768;
/// Event streams that are open at once.
const STREAMS: usize = 1024;
/// What an answer that is no page may do in a browser: nothing.
const NO_CONTENT_POLICY: &str = "default-src 'none'; frame-ancestors 'none'";
/// Largest accepted body, bytes.
const BODY_LIMIT: usize = 1 << 20;

/// What every route may use.
#[derive(Debug, Clone)]
pub struct App {
    /// The store.
    pub store: Arc<Store>,
    /// Ends streams and long polls when the service stops.
    pub stopping: CancellationToken,
    access: Access,
    /// What this machine takes for the engine's work.
    machine: CalibrationCache,
    /// Archives that may be made at once.
    archives: Arc<Semaphore>,
    /// Batches that may be expanded at once.
    expansions: Arc<Semaphore>,
    long_polls: Arc<Semaphore>,
    streams: Arc<Semaphore>,
}

impl App {
    /// Over a store, for those who have access.
    pub fn new(store: Arc<Store>, access: Access, stopping: CancellationToken) -> Self {
        Self {
            machine: CalibrationCache::open(Some(store.machine_file())),
            store,
            stopping,
            access,
            archives: Arc::new(Semaphore::new(results::archive::AT_ONCE)),
            expansions: Arc::new(Semaphore::new(batches::submit::EXPANSIONS)),
            long_polls: Arc::new(Semaphore::new(LONG_POLLS)),
            streams: Arc::new(Semaphore::new(STREAMS)),
        }
    }
}

#[derive(OpenApi)]
#[openapi(
    components(schemas(
        results::stored_part::Format,
        batches::picture::PictureFormat,
        results::wear_history::HistoryFormat,
        api::event::Done
    )),
    info(
        title = "fretwear",
        description = "Wear of electrical contacts under vibration: submit a study, follow it, fetch its results."
    )
)]
struct Described;

/// All routes.
pub fn router(app: App) -> Router {
    let access = middleware::from_fn_with_state(app.access.clone(), access::check);
    described()
        .0
        .fallback(no_route)
        .method_not_allowed_fallback(wrong_method)
        .layer(access)
        .layer(GlobalConcurrencyLimitLayer::new(REQUESTS))
        .layer(SetResponseHeaderLayer::if_not_present(
            header::CONTENT_SECURITY_POLICY,
            HeaderValue::from_static(NO_CONTENT_POLICY),
        ))
        .layer(SetResponseHeaderLayer::if_not_present(
            header::X_CONTENT_TYPE_OPTIONS,
            HeaderValue::from_static("nosniff"),
        ))
        .layer(TraceLayer::new_for_http())
        .with_state(app)
}

fn described() -> (Router<App>, Document) {
    OpenApiRouter::with_openapi(Described::openapi())
        .routes(routes!(jobs::submit::submit, jobs::list::list))
        .routes(routes!(jobs::show::show, jobs::delete::remove))
        .routes(routes!(jobs::cancel::cancel))
        .routes(routes!(jobs::stream_events::events))
        .routes(routes!(results::list::manifest))
        .routes(routes!(results::download::file))
        .routes(routes!(results::archive::archive))
        .routes(routes!(results::wear_history::wear_history))
        .routes(routes!(results::profile::profile))
        .routes(routes!(results::pressure::pressure))
        .routes(routes!(results::friction_loop::friction_loop))
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
        .routes(routes!(jobs::make_plan::make_plan))
        .routes(routes!(systems::read::systems))
        .routes(routes!(systems::read::system))
        .routes(routes!(operation::pages::dashboard))
        .routes(routes!(operation::pages::docs))
        .routes(routes!(operation::pages::asset))
        .routes(routes!(operation::openapi::openapi))
        .routes(routes!(operation::health::healthz))
        .routes(routes!(operation::health::readyz))
        .routes(routes!(operation::metrics::metrics))
        .split_for_parts()
}

async fn no_route(uri: Uri) -> Response {
    problem::Kind::NoRoute
        .because(format!("nothing is at {}", uri.path()))
        .into_response()
}

async fn wrong_method(method: Method, uri: Uri) -> Response {
    problem::Kind::WrongMethod
        .because(format!("{} does not take {method}", uri.path()))
        .into_response()
}

#[cfg(test)]
pub(crate) mod tests;
