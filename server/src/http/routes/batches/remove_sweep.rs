//! `DELETE /v1/sweeps/{id}`: deletes a sweep whose jobs have ended.

use api::problem::Problem;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::App;
use crate::http::extract::SweepId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show_sweep::SweepError;
use crate::store::Deleted;

/// Deletes a sweep whose jobs have all ended, with the jobs, their events and results.
#[utoipa::path(
    delete,
    path = "/v1/sweeps/{id}",
    tag = "sweeps",
    params(("id" = Uuid, Path, description = "The sweep")),
    responses(
        (status = 204, description = "Deleted"),
        (status = 404, description = "No such sweep", body = Problem),
        (status = 409, description = "A job of it has not ended", body = Problem),
    )
)]
pub(in crate::http) async fn remove_sweep(
    State(app): State<App>,
    SweepId(id): SweepId,
) -> Result<StatusCode, ProblemResponse> {
    match app.store.delete_sweep(id).await? {
        Deleted::Done => Ok(StatusCode::NO_CONTENT),
        Deleted::Active => Err(SweepError::Active(id).into()),
        Deleted::Missing => Err(SweepError::Missing(id).into()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{SWEEP, Service};

    #[tokio::test]
    async fn only_ended_sweeps_can_be_deleted_and_their_jobs_go_with_them() {
        let service = Service::new().await;
        let other = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
        let (status, _, problem) = service.send("DELETE", &path, &[], "").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/sweep-active"))
        );
        service.post(&format!("{path}/cancel"), "").await;
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 204);
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 404);
        assert_eq!(service.get(&path).await.0, 404);
        let (_, _, list) = service.get("/v1/jobs").await;
        let left: Vec<_> = list["jobs"].as_array().expect("jobs").iter().collect();
        assert_eq!(left.len(), 1);
        assert_eq!(left[0]["id"], json!(other));
    }
}
