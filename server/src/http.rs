//! HTTP: one file a route, each in the order error, handler, tests.

mod access;
mod archive;
mod body_problems;
mod cancel;
mod cancel_study;
mod cancel_sweep;
mod events;
mod extract;
mod file;
mod friction_loop;
mod health;
mod job_error;
mod limits;
mod list;
mod list_sweeps;
mod listener;
mod make_plan;
mod manifest;
mod metrics;
pub mod openapi;
mod pages;
mod paging;
mod pressure;
mod problem;
mod profile;
mod remove;
mod remove_sweep;
mod request_key;
mod show;
mod show_study;
mod show_sweep;
mod stored_part;
mod study_picture;
mod study_table;
mod submit;
mod submit_study;
mod submit_sweep;
mod sweep_outcomes;
mod system_schema;
mod systems;
mod wear_history;

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

use crate::machine::Kept;
use crate::store::Store;

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
    machine: Kept,
    /// Archives that may be made at once.
    archives: Arc<Semaphore>,
    /// Studies whose runs may be chosen at once.
    programmes: Arc<Semaphore>,
    long_polls: Arc<Semaphore>,
    streams: Arc<Semaphore>,
}

impl App {
    /// Over a store, for those who have access.
    pub fn new(store: Arc<Store>, access: Access, stopping: CancellationToken) -> Self {
        Self {
            machine: Kept::open(Some(store.machine_file())),
            store,
            stopping,
            access,
            archives: Arc::new(Semaphore::new(archive::AT_ONCE)),
            programmes: Arc::new(Semaphore::new(submit_study::AT_ONCE)),
            long_polls: Arc::new(Semaphore::new(LONG_POLLS)),
            streams: Arc::new(Semaphore::new(STREAMS)),
        }
    }
}

#[derive(OpenApi)]
#[openapi(
    components(schemas(
        stored_part::Format,
        study_picture::PictureFormat,
        wear_history::HistoryFormat,
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
        .routes(routes!(submit::submit, list::list))
        .routes(routes!(show::show, remove::remove))
        .routes(routes!(cancel::cancel))
        .routes(routes!(events::events))
        .routes(routes!(manifest::manifest))
        .routes(routes!(file::file))
        .routes(routes!(archive::archive))
        .routes(routes!(wear_history::wear_history))
        .routes(routes!(profile::profile))
        .routes(routes!(pressure::pressure))
        .routes(routes!(friction_loop::friction_loop))
        .routes(routes!(
            submit_sweep::submit_sweep,
            list_sweeps::list_sweeps
        ))
        .routes(routes!(show_sweep::show_sweep, remove_sweep::remove_sweep))
        .routes(routes!(sweep_outcomes::sweep_outcomes))
        .routes(routes!(cancel_sweep::cancel_sweep))
        .routes(routes!(submit_study::submit_study))
        .routes(routes!(show_study::show_study))
        .routes(routes!(study_table::study_table))
        .routes(routes!(study_picture::study_picture))
        .routes(routes!(cancel_study::cancel_study))
        .routes(routes!(make_plan::make_plan))
        .routes(routes!(systems::systems))
        .routes(routes!(systems::system))
        .routes(routes!(pages::dashboard))
        .routes(routes!(pages::docs))
        .routes(routes!(pages::asset))
        .routes(routes!(openapi::openapi))
        .routes(routes!(health::healthz))
        .routes(routes!(health::readyz))
        .routes(routes!(metrics::metrics))
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
