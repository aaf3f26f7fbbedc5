//! `GET /v1/jobs/{id}/results/pressure`: contact pressure and shear.

use api::problem::Problem;
use api::results::Pressure;
use axum::extract::State;
use axum::response::Response;

use crate::export::{csv, thin};
use crate::http::App;
use crate::http::extract::{JobId, Params};
use crate::http::routes::results::stored_part::{Forms, ResultError, SnapshotQuery, respond};
use crate::store::SnapshotPart;

/// Contact pressure and shear, at the stored cycle nearest to the named one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/pressure",
    tag = "results",
    params(("id" = Uuid, Path, description = "The job"), SnapshotQuery),
    responses(
        (status = 200, description = "The document", content((Pressure = "application/json"), (String = "text/csv"))),
        (status = 400, description = "A query parameter cannot be read", body = Problem),
        (status = 404, description = "No such job, or nothing stored so far", body = Problem),
    )
)]
pub(in crate::http) async fn pressure(
    state: State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ResultError> {
    let forms = Forms {
        csv: csv::pressure,
        thin: thin::pressure,
    };
    respond::<Pressure>(state, id, query, SnapshotPart::Pressure, forms).await
}

#[cfg(test)]
mod tests {
    use crate::http::routes::results::stored_part::checks;

    #[tokio::test]
    async fn the_nearest_stored_cycle_answers() {
        checks::nearest("pressure").await;
    }

    #[tokio::test]
    async fn csv_names_units_in_its_header() {
        checks::csv(
            "pressure",
            "phase,slider_x_mm,x_mm,pressure_mpa,shear_mpa",
            3,
        )
        .await;
    }

    #[tokio::test]
    async fn what_is_not_there_is_a_problem() {
        checks::missing("pressure").await;
    }
}
