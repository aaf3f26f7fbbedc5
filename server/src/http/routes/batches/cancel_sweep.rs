//! `POST /v1/sweeps/{id}/cancel`: asks for the end of all jobs of a sweep; always accepted.

use api::problem::Problem;
use api::sweep::Sweep;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

use crate::clock::now_ms;
use crate::http::App;
use crate::http::extract::SweepId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show_sweep::SweepError;

/// Asks for the end of all jobs of a sweep.
#[utoipa::path(
    post,
    path = "/v1/sweeps/{id}/cancel",
    tag = "sweeps",
    params(("id" = Uuid, Path, description = "The sweep")),
    responses(
        (status = 202, description = "Accepted; the sweep as it stands", body = Sweep),
        (status = 404, description = "No such sweep", body = Problem),
    )
)]
pub(in crate::http) async fn cancel_sweep(
    State(app): State<App>,
    SweepId(id): SweepId,
) -> Result<Response, ProblemResponse> {
    if !app.store.cancel_sweep(id, now_ms()).await? {
        return Err(SweepError::Missing(id).into());
    }
    let sweep = app.store.sweep(id).await?.ok_or(SweepError::Missing(id))?;
    Ok((StatusCode::ACCEPTED, Json(sweep)).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{SWEEP, Service};

    #[tokio::test]
    async fn waiting_jobs_end_at_once_and_running_ones_are_asked_to() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        service.app.store.claim(0, i64::MAX).await.expect("a claim");
        let path = format!("/v1/sweeps/{}/cancel", sweep["id"].as_str().expect("an id"));
        let (status, _, sweep) = service.post(&path, "").await;
        assert_eq!(status, 202);
        assert_eq!(
            (&sweep["counts"]["cancelled"], &sweep["counts"]["running"]),
            (&3.into(), &1.into())
        );
        let (status, _, again) = service.post(&path, "").await;
        assert_eq!((status.as_u16(), again), (202, sweep));
        let nobody = "/v1/sweeps/00000000-0000-7000-8000-000000000000/cancel";
        assert_eq!(service.post(nobody, "").await.0, 404);
    }
}
