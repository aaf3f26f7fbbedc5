//! `GET /v1/jobs/{id}/results/profile`: worn depth along both surfaces.

use api::problem::Problem;
use api::results::Profile;
use axum::extract::State;
use axum::response::Response;

use crate::export::{csv, thin};
use crate::http::App;
use crate::http::extract::{JobId, Params};
use crate::http::routes::results::stored_part::{Forms, ResultError, SnapshotQuery, respond};
use crate::store::SnapshotPart;

/// Worn depth along both surfaces, at the stored cycle nearest to the named one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/profile",
    tag = "results",
    params(("id" = Uuid, Path, description = "The job"), SnapshotQuery),
    responses(
        (status = 200, description = "The document", content((Profile = "application/json"), (String = "text/csv"))),
        (status = 400, description = "A query parameter cannot be read", body = Problem),
        (status = 404, description = "No such job, or nothing stored so far", body = Problem),
    )
)]
pub(in crate::http) async fn profile(
    state: State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ResultError> {
    let forms = Forms {
        csv: csv::profile,
        thin: thin::profile,
    };
    respond::<Profile>(state, id, query, SnapshotPart::Profile, forms).await
}

#[cfg(test)]
mod tests {
    use crate::http::routes::results::stored_part::checks;

    #[tokio::test]
    async fn the_nearest_stored_cycle_answers() {
        checks::nearest("profile").await;
    }

    #[tokio::test]
    async fn csv_names_units_in_its_header() {
        checks::csv("profile", "side,x_mm,depth_mm", 3).await;
    }

    #[tokio::test]
    async fn what_is_not_there_is_a_problem() {
        checks::missing("profile").await;
    }
}
