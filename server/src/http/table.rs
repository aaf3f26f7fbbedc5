//! The table of routes: every handler, and the OpenAPI document that follows from them.

use axum::Router;
use axum::routing::{get, post, put};
use utoipa::OpenApi;
use utoipa::openapi::OpenApi as Document;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::http::app::App;
use crate::http::routes::{batches, jobs, operation, results, systems, worker, worker_tokens};

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

/// The routes of remote workers, which are not in the document.
fn worker_routes() -> Router<App> {
    Router::new()
        .route("/claims", post(worker::claim::claim))
        .route("/leases", post(worker::renew::renew))
        .route("/writes", post(worker::write::write))
        .route("/restarts", post(worker::restart::restart))
        .route("/demand", get(worker::show_demand::show_demand))
        .route(
            "/checkpoints/{job}/{lease}",
            get(worker::show_checkpoint::show_checkpoint),
        )
        .route(
            "/files/{job}/{lease}/{name}",
            put(worker::put_file::put_file),
        )
}

/// The routes and their OpenAPI document.
pub(super) fn routes_and_document() -> (Router<App>, Document) {
    OpenApiRouter::with_openapi(Interface::openapi())
        .routes(routes!(jobs::submit::submit, jobs::list::list))
        .routes(routes!(jobs::show::show, jobs::delete::remove))
        .routes(routes!(jobs::show_spec::show_spec))
        .routes(routes!(jobs::cancel::cancel))
        .routes(routes!(jobs::retry::retry))
        .routes(routes!(jobs::retry_filtered::retry_filtered))
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
        .routes(routes!(batches::plan::make_sweep_plan))
        .routes(routes!(batches::show_base::show_sweep_base))
        .routes(routes!(batches::outcomes::sweep_outcomes))
        .routes(routes!(batches::cancel::cancel_sweep))
        .routes(routes!(batches::retry::retry_sweep))
        .routes(routes!(
            batches::submit::submit_study,
            batches::list::list_studies
        ))
        .routes(routes!(
            batches::show::show_study,
            batches::delete::remove_study
        ))
        .routes(routes!(batches::show_base::show_study_base))
        .routes(routes!(batches::outcomes::study_table))
        .routes(routes!(batches::picture::study_picture))
        .routes(routes!(batches::cancel::cancel_study))
        .routes(routes!(batches::retry::retry_study))
        .routes(routes!(jobs::plan::make_plan))
        .routes(routes!(systems::list::systems))
        .routes(routes!(systems::show::system))
        .routes(routes!(jobs::feed::all_events))
        .routes(routes!(jobs::list_labels::labels))
        .routes(routes!(results::compare_histories::histories))
        .routes(routes!(results::list_quantities::list_quantities))
        .routes(routes!(operation::show_service::service))
        .routes(routes!(operation::list_workers::workers))
        .routes(routes!(operation::drain_worker::drain_worker))
        .routes(routes!(operation::serve_pages::dashboard))
        .routes(routes!(operation::serve_pages::docs))
        .routes(routes!(operation::serve_pages::book))
        .route("/book/{*path}", get(operation::serve_pages::book_page))
        .route("/assets/{*path}", get(operation::serve_pages::asset))
        .routes(routes!(
            worker_tokens::create::create_worker_token,
            worker_tokens::list::worker_tokens
        ))
        .routes(routes!(worker_tokens::revoke::revoke_worker_token))
        .nest("/v1/worker", OpenApiRouter::from(worker_routes()))
        .routes(routes!(operation::explain_problem::explain))
        .routes(routes!(operation::show_openapi::openapi))
        .routes(routes!(operation::check_health::healthz))
        .routes(routes!(operation::check_health::readyz))
        .routes(routes!(operation::show_metrics::metrics))
        .split_for_parts()
}
