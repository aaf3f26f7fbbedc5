//! `POST /v1/jobs/retry?..`: queues the failed and cancelled jobs again that pass a filter.

use std::sync::Arc;

use api::job::{RetriedJobs, Status};
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::app::App;
use crate::http::extract::Params;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::jobs::filter::{FILTERS, FilterError, FilterQuery, filter_among};
use crate::store::Filter;
use crate::text::shortened;

/// Error of the filter.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RetryError {
    /// A parameter is not valid.
    #[error(transparent)]
    Parameter(#[from] FilterError),
    /// Not a parameter.
    #[error("`{0}` is not a parameter; parameters are {FILTERS}")]
    Unknown(String),
    /// Without a filter it would be all jobs that have ever failed.
    #[error("a filter is needed, such as status=failed; parameters are {FILTERS}")]
    NoFilter,
    /// Jobs of this status are not queued again.
    #[error("jobs that are {} are not queued again; statuses are failed and cancelled", .0.as_str())]
    Status(Status),
}

impl RouteError for RetryError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Queues the failed and cancelled jobs again that pass all filters, of which there is one at least. Each continues from its last checkpoint,
/// with all its attempts.
#[utoipa::path(
    post,
    path = "/v1/jobs/retry",
    tag = "jobs",
    params(FilterQuery),
    responses(
        (status = 202, description = "Accepted; how many jobs are queued again", body = RetriedJobs),
    )
)]
pub(crate) async fn retry_filtered(
    State(app): State<App>,
    Params(pairs): Params<Vec<(String, String)>>,
) -> Result<(StatusCode, Json<RetriedJobs>), ProblemResponse> {
    let filter = parse(&pairs)?;
    // The retry continues if the client disconnects before its end.
    let store = Arc::clone(&app.store);
    let retried = tokio::spawn(async move { store.retry_all(filter).await }).await??;
    Ok((StatusCode::ACCEPTED, Json(RetriedJobs { retried })))
}

fn parse(pairs: &[(String, String)]) -> Result<Filter, RetryError> {
    let mut filter = Filter::default();
    if let Some((name, _)) = filter_among(pairs, &mut filter)?.first() {
        return Err(RetryError::Unknown(shortened(name)));
    }
    if pairs.is_empty() {
        return Err(RetryError::NoFilter);
    }
    let is_retried = |status: &Status| matches!(status, Status::Failed | Status::Cancelled);
    match filter.statuses.iter().find(|status| !is_retried(status)) {
        Some(status) => Err(RetryError::Status(*status)),
        None => Ok(filter),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::http::tests::{SWEEP, Service};
    use crate::queue::Transition;
    use crate::store::{End, JobUpdate};

    /// Ends the first waiting job.
    async fn ended(service: &Service, transition: Transition) {
        let store = &service.app.store;
        let claim = store.claim_next(i64::MAX).await.expect("a queued job");
        let end = End::without_result(transition, "as the test asked for");
        store.end_next(&claim, &JobUpdate::default(), &end).await;
    }

    async fn retried(service: &Service, query: &str) -> (u16, Value) {
        let (status, _, answer) = service.post(&format!("/v1/jobs/retry?{query}"), "").await;
        (status.as_u16(), answer)
    }

    #[tokio::test]
    async fn jobs_that_pass_the_filter_are_queued_again_once() {
        let service = Service::new().await;
        for system in ["dimm", "dimm", "zif", "zif"] {
            let spec = format!(r#"{{"system":{{"kind":"{system}"}}}}"#);
            service.queued(&spec).await;
        }
        for transition in [
            Transition::Fail,
            Transition::Succeed,
            Transition::Fail,
            Transition::Cancel,
        ] {
            ended(&service, transition).await;
        }
        let some = |retried: u64| (202, json!({ "retried": retried }));
        assert_eq!(retried(&service, "status=failed&system=zif").await, some(1));
        assert_eq!(retried(&service, "status=failed&system=zif").await, some(0));
        assert_eq!(retried(&service, "text=-").await, some(2));
        let (_, _, list) = service.get("/v1/jobs?status=queued&total=true").await;
        assert_eq!(list["total"], 3);
    }

    #[tokio::test]
    async fn all_jobs_of_a_sweep_are_queued_again_page_by_page() {
        let service = Service::new().await;
        let base = r#"{"base":{"system":{"kind":"dimm"}},"grid":{"/cycles":["#;
        let cycles: Vec<_> = (1..=250).map(|cycles| cycles.to_string()).collect();
        let body = format!("{base}{}]}}}}", cycles.join(","));
        let (status, _, sweep) = service.post("/v1/sweeps", &body).await;
        assert_eq!(status, 202, "{sweep}");
        let id = sweep["id"].as_str().expect("an id");
        service.post(&format!("/v1/sweeps/{id}/cancel"), "").await;
        service.post("/v1/sweeps", SWEEP).await;
        let query = format!("sweep={id}");
        let all = (202, json!({"retried": 250}));
        assert_eq!(retried(&service, &query).await, all);
    }

    #[tokio::test]
    async fn a_filter_that_is_none_or_not_of_jobs_that_are_retried_is_refused() {
        let service = Service::new().await;
        for (query, detail) in [
            ("", "a filter is needed"),
            ("limit=3", "`limit` is not a parameter"),
            (
                "status=failed,running",
                "jobs that are running are not queued again",
            ),
            ("status=lost", "`lost` is not a status"),
        ] {
            let (status, problem) = retried(&service, query).await;
            assert_eq!(
                (status, &problem["type"]),
                (400, &json!("/problems/invalid-query"))
            );
            let found = problem["detail"].as_str().expect("a detail");
            assert!(found.contains(detail), "{found}");
        }
    }
}
