//! `GET /v1/service`: what the service does at present, in a few figures.

use api::service::{ServiceOverview, Workers};
use axum::Json;
use axum::extract::State;

use api::job::Status;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Jobs by status, workers, age of the oldest waiting job, space.
#[utoipa::path(
    get,
    path = "/v1/service",
    tag = "operation",
    responses((status = 200, description = "The figures", body = ServiceOverview))
)]
pub(crate) async fn service(
    State(app): State<App>,
) -> Result<Json<ServiceOverview>, ProblemResponse> {
    let gauges = app.store.gauges().await?;
    let total = app.supervisor.running_workers();
    let of = |status: Status| gauges.jobs.iter().find(|(of, ..)| *of == status);
    let count = |status| of(status).map_or(0, |(_, count, _)| u64::try_from(*count).unwrap_or(0));
    let waiting = of(Status::Queued).filter(|(_, count, _)| *count > 0);
    Ok(Json(ServiceOverview {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        jobs: Status::ALL
            .into_iter()
            .map(|status| (status.as_str().to_owned(), count(status)))
            .collect(),
        workers: Workers {
            total: u64::try_from(gauges.remote_slots)
                .unwrap_or_default()
                .saturating_add(u64::try_from(total).unwrap_or(u64::MAX)),
            busy: count(Status::Running),
        },
        oldest_queued_s: waiting.map(|(.., age)| u64::try_from(*age).unwrap_or(0)),
        free_disk_mb: app.store.disk().free_mb(),
        stopping: app.stopping.is_cancelled(),
    }))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn jobs_and_workers_are_counted() {
        let service = Service::new().await;
        let (status, _, empty) = service.get("/v1/service").await;
        assert_eq!(status, 200);
        assert_eq!(empty["jobs"]["queued"], 0);
        assert!(empty["oldest_queued_s"].is_null());
        service.with_results().await;
        service.queued(r#"{"system":{"kind":"zif"}}"#).await;
        let (_, _, found) = service.get("/v1/service").await;
        assert_eq!(found["jobs"]["queued"], 1);
        assert_eq!(found["jobs"]["running"], found["workers"]["busy"]);
        assert!(found["oldest_queued_s"].is_u64() && found["version"].is_string());
    }
}
