//! `GET /v1/jobs/{id}/results/profile`: worn depth along both surfaces.

use api::problem::Problem;
use api::results::Profile;
use axum::extract::State;
use axum::response::Response;

use super::App;
use super::extract::{JobId, Params};
use super::stored_part::{ResultError, SnapshotQuery, respond};
use crate::store::SnapshotPart;
use crate::translate::csv;

/// Worn depth along both surfaces, at the stored cycle nearest to the named one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/profile",
    tag = "results",
    params(("id" = Uuid, Path, description = "The job"), SnapshotQuery),
    responses(
        (status = 200, description = "The document", body = Profile),
        (status = 400, description = "A query parameter cannot be read", body = Problem),
        (status = 404, description = "No such job, or nothing stored so far", body = Problem),
    )
)]
pub(super) async fn profile(
    state: State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ResultError> {
    respond::<Profile>(state, id, query, SnapshotPart::Profile, csv::profile).await
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_nearest_stored_cycle_answers() {
        let service = Service::new().await;
        let id = service.with_results().await;
        let path = format!("/v1/jobs/{id}/results/profile");
        for (query, cycle) in [
            ("", 20),
            ("?cycle=0", 10),
            ("?cycle=14", 10),
            ("?cycle=16", 20),
            ("?cycle=999", 20),
        ] {
            let (status, _, document) = service.get(&format!("{path}{query}")).await;
            assert_eq!(
                (status.as_u16(), document["cycle"].as_u64()),
                (200, Some(cycle)),
                "{query}"
            );
        }
    }

    #[tokio::test]
    async fn csv_names_units_in_its_header() {
        let service = Service::new().await;
        let id = service.with_results().await;
        let (status, headers, text) = service
            .text(
                "GET",
                &format!("/v1/jobs/{id}/results/profile?format=csv"),
                &[],
                "",
            )
            .await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "text/csv; charset=utf-8");
        assert_eq!(text.lines().next(), Some("side,x_mm,depth_mm"));
        assert_eq!(text.lines().count(), 3);
    }

    #[tokio::test]
    async fn what_is_not_there_is_a_problem() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, _, problem) = service.get(&format!("/v1/jobs/{id}/results/profile")).await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (404, Some("/problems/no-such-result"))
        );
        let missing = "/v1/jobs/00000000-0000-7000-8000-000000000000/results/profile";
        assert_eq!(
            service.get(missing).await.2["type"],
            "/problems/no-such-job"
        );
        assert_eq!(
            service
                .get(&format!("/v1/jobs/{id}/results/profile?cycle=-1"))
                .await
                .0,
            400
        );
    }
}
