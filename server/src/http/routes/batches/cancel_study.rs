//! `POST /v1/studies/{id}/cancel`: asks for the end of all jobs of a study; always accepted.

use api::problem::Problem;
use api::study::StudyDocument;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

use crate::clock::now_ms;
use crate::http::App;
use crate::http::extract::StudyId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show_study::{StudyShowError, document};

/// Asks for the end of all jobs of a study.
#[utoipa::path(
    post,
    path = "/v1/studies/{id}/cancel",
    tag = "studies",
    params(("id" = Uuid, Path, description = "The study")),
    responses(
        (status = 202, description = "Accepted; the study as it stands", body = StudyDocument),
        (status = 404, description = "No such study", body = Problem),
        (status = 410, description = "Accepted, but queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(in crate::http) async fn cancel_study(
    State(app): State<App>,
    StudyId(id): StudyId,
) -> Result<Response, ProblemResponse> {
    // A sweep that is no study is not cancelled here.
    if !app.store.is_study(id).await? {
        return Err(StudyShowError::Missing(id).into());
    }
    app.store.cancel_sweep(id, now_ms()).await?;
    let study = document(&app, id).await?;
    Ok((StatusCode::ACCEPTED, Json(study)).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{STUDY, SWEEP, Service};

    #[tokio::test]
    async fn all_jobs_of_a_study_are_cancelled_and_a_sweep_is_left_alone() {
        let service = Service::new().await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let path = format!(
            "/v1/studies/{}/cancel",
            study["id"].as_str().expect("an id")
        );
        let (status, _, study) = service.post(&path, "").await;
        assert_eq!(status, 202);
        let jobs = study["jobs"].as_array().expect("jobs").len();
        assert_eq!(study["counts"]["cancelled"], jobs);
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let id = sweep["id"].as_str().expect("an id");
        let (status, _, _) = service.post(&format!("/v1/studies/{id}/cancel"), "").await;
        assert_eq!(status, 404);
        let (_, _, sweep) = service.get(&format!("/v1/sweeps/{id}")).await;
        assert_eq!(sweep["counts"]["cancelled"], 0);
    }
}
