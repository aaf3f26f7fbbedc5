//! `GET /metrics`: counters and gauges for Prometheus.

use api::problem::Problem;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Media type of the OpenMetrics text format.
const MEDIA_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Counters and gauges.
#[utoipa::path(
    get,
    path = "/metrics",
    tag = "operation",
    responses(
        (status = 200, description = "OpenMetrics text", body = String, content_type = "application/openmetrics-text"),
        (status = 500, description = "The service failed", body = Problem),
    )
)]
pub(crate) async fn metrics(State(app): State<App>) -> Result<Response, ProblemResponse> {
    let mut gauges = app.store.gauges().await?;
    let workers = app.supervisor.running_workers();
    gauges.workers_alive = i64::try_from(workers).unwrap_or(i64::MAX);
    gauges.workers_failing += i64::from(app.health.failing().is_some());
    // Only here: it is a sum over all waiting jobs, and other gauges are polled.
    gauges.demand_cpu_s = i64::try_from(app.store.demand().await?.queued_cpu_s).unwrap_or(i64::MAX);
    let text = app.store.metrics().text(&gauges)?;
    Ok(([(header::CONTENT_TYPE, MEDIA_TYPE)], text).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn jobs_are_counted_by_status() {
        let service = Service::new().await;
        service.with_results().await;
        service.queued(r#"{"system":{"kind":"zif"}}"#).await;
        let (status, headers, text) = service.text("GET", "/metrics", &[], "").await;
        assert_eq!(status, 200);
        let media_type = headers["content-type"].to_str().expect("text");
        assert!(media_type.starts_with("application/openmetrics-text"));
        for line in [
            "fretwear_jobs{status=\"queued\"} 1",
            "fretwear_jobs{status=\"running\"} 1",
            "fretwear_jobs{status=\"failed\"} 0",
            "fretwear_stale_writes_refused_total 0",
        ] {
            assert!(text.lines().any(|found| found == line), "{line} in\n{text}");
        }
    }
}
