//! The problem of a full data disk, with its free space.

use axum::extract::State;
use axum::response::{IntoResponse, Response};

use crate::http::app::App;
use crate::http::problem::{DiskFull, ProblemType};
use crate::store::StoreError;

/// Middleware that adds the free space to the problem of a full disk, if the system reports it.
pub(super) async fn explain(State(app): State<App>, response: Response) -> Response {
    if response.extensions().get::<DiskFull>().is_none() {
        return response;
    }
    match app.store.disk().free_mb() {
        Some(free_mb) => ProblemType::DISK_FULL
            .with_detail(format!("{} ({free_mb} MB free)", StoreError::DiskFull))
            .into_response(),
        None => response,
    }
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;
    use crate::store::tests::fill_disk;

    const SPEC: &str = r#"{"system":{"kind":"dimm"}}"#;
    /// More jobs than the pages that a new database has left can hold.
    const JOBS: usize = 100;

    #[tokio::test]
    async fn a_job_that_the_disk_has_no_space_for_is_refused_with_the_free_space() {
        let service = Service::new().await;
        fill_disk(&service.app.store).await;
        let mut answer = service.post("/v1/jobs", SPEC).await;
        for _ in 1..JOBS {
            if answer.0 != 202 {
                break;
            }
            answer = service.post("/v1/jobs", SPEC).await;
        }
        let (status, headers, problem) = answer;
        assert_eq!(status, 503, "{problem}");
        assert_eq!(headers["retry-after"], "5");
        assert_eq!(problem["type"], "/problems/disk-full");
        let detail = problem["detail"].as_str().expect("a detail");
        let free = detail.strip_prefix("no space left on the data disk (");
        let free = free.and_then(|rest| rest.strip_suffix(" MB free)"));
        let free = free.and_then(|free| free.parse::<u64>().ok());
        assert!(free.is_some(), "{detail}");
    }
}
