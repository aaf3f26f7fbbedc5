//! `GET /v1/sweeps/{id}`: a sweep with the number of its jobs by status.

use api::problem::Problem;
use api::sweep::Sweep;
use axum::Json;
use axum::extract::State;
use uuid::Uuid;

use crate::http::App;
use crate::http::extract::SweepId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

/// Why there is nothing about a sweep.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum SweepError {
    /// There is none of that id.
    #[error("there is no sweep {0}")]
    Missing(Uuid),
    /// A job of it has not ended.
    #[error("sweep {0} has jobs that have not ended; cancel it first")]
    Active(Uuid),
}

impl RouteError for SweepError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing(_) => ProblemType::NoSuchSweep,
            Self::Active(_) => ProblemType::SweepActive,
        }
    }
}

/// A sweep.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}",
    tag = "sweeps",
    params(("id" = Uuid, Path, description = "The sweep")),
    responses(
        (status = 200, description = "The sweep", body = Sweep),
        (status = 404, description = "No such sweep", body = Problem),
    )
)]
pub(in crate::http) async fn show_sweep(
    State(app): State<App>,
    SweepId(id): SweepId,
) -> Result<Json<Sweep>, ProblemResponse> {
    let sweep = app.store.sweep(id).await?;
    Ok(Json(sweep.ok_or(SweepError::Missing(id))?))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{SWEEP, Service};

    #[tokio::test]
    async fn counts_follow_the_jobs() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
        service.app.store.claim(0, i64::MAX).await.expect("a claim");
        let last = sweep["jobs"][3]["id"].as_str().expect("an id");
        service.post(&format!("/v1/jobs/{last}/cancel"), "").await;
        let (status, _, sweep) = service.get(&path).await;
        assert_eq!(status, 200);
        for (name, count) in [
            ("queued", 2),
            ("running", 1),
            ("cancelled", 1),
            ("failed", 0),
        ] {
            assert_eq!(sweep["counts"][name], count, "{name}");
        }
        service
            .send("DELETE", &format!("/v1/jobs/{last}"), &[], "")
            .await;
        let (_, _, sweep) = service.get(&path).await;
        assert_eq!(sweep["jobs"].as_array().map(Vec::len), Some(3));
    }

    #[tokio::test]
    async fn an_unknown_sweep_is_a_404() {
        let service = Service::new().await;
        for id in ["00000000-0000-7000-8000-000000000000", "..%2Fjobs", "1"] {
            let (status, _, problem) = service.get(&format!("/v1/sweeps/{id}")).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-sweep")), "{id}");
        }
    }
}
