//! HTTP: one file a route, each in the order error, handler, tests.

mod archive;
mod cancel;
mod cancel_sweep;
mod events;
mod extract;
mod file;
mod friction_loop;
mod health;
mod host;
mod list;
mod make_plan;
mod manifest;
mod metrics;
mod pressure;
mod problem;
mod profile;
mod remove;
mod show;
mod show_sweep;
mod stored_part;
mod submit;
mod submit_sweep;
mod sweep_outcomes;
mod systems;
mod wear_history;

use std::sync::Arc;

use axum::extract::DefaultBodyLimit;
use axum::http::{HeaderValue, Method, Uri, header};
use axum::response::{IntoResponse, Response};
use axum::{Json, Router, middleware};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;
use tower_http::set_header::SetResponseHeaderLayer;
use tower_http::trace::TraceLayer;
use utoipa::OpenApi;
use utoipa::openapi::OpenApi as Document;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::store::Store;

/// Largest accepted body, bytes.
const BODY_LIMIT: usize = 1 << 20;

/// What every route may use.
#[derive(Debug, Clone)]
pub struct App {
    /// The store.
    pub store: Arc<Store>,
    /// Ends streams and long polls when the service stops.
    pub stopping: CancellationToken,
    /// How many archives may be made at once.
    archives: Arc<Semaphore>,
}

impl App {
    /// Over a store.
    pub fn new(store: Arc<Store>, stopping: CancellationToken) -> Self {
        Self {
            store,
            stopping,
            archives: Arc::new(Semaphore::new(archive::AT_ONCE)),
        }
    }
}

#[derive(OpenApi)]
#[openapi(
    components(schemas(stored_part::Format, wear_history::HistoryFormat, api::event::Done)),
    info(
        title = "fretwear",
        description = "Wear of electrical contacts under vibration: submit a study, follow it, fetch its results."
    )
)]
struct Described;

/// All routes.
pub fn router(app: App) -> Router {
    let (router, document) = described();
    router
        .route(
            "/openapi.json",
            axum::routing::get(move || std::future::ready(Json(document.clone()))),
        )
        .fallback(no_route)
        .method_not_allowed_fallback(wrong_method)
        .layer(DefaultBodyLimit::max(BODY_LIMIT))
        .layer(middleware::from_fn(host::check))
        .layer(SetResponseHeaderLayer::if_not_present(
            header::X_CONTENT_TYPE_OPTIONS,
            HeaderValue::from_static("nosniff"),
        ))
        .layer(TraceLayer::new_for_http())
        .with_state(app)
}

/// The OpenAPI document of all routes.
pub fn openapi() -> Document {
    described().1
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
        .routes(routes!(submit_sweep::submit_sweep))
        .routes(routes!(show_sweep::show_sweep))
        .routes(routes!(sweep_outcomes::sweep_outcomes))
        .routes(routes!(cancel_sweep::cancel_sweep))
        .routes(routes!(make_plan::make_plan))
        .routes(routes!(systems::systems))
        .routes(routes!(systems::system))
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
