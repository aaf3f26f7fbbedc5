//! `GET /v1/jobs/{id}/results`: manifest of the files of a job.

use std::collections::BTreeMap;

use api::results::Manifest;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::extract::JobId;
use crate::http::problem::ProblemResponse;

/// Files that a job has written so far; complete once the job has ended.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results",
    tag = "results",
    responses(
        (status = 200, description = "The manifest", body = Manifest),
    )
)]
pub(crate) async fn manifest(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<Json<Manifest>, ProblemResponse> {
    let job = app.job(id).await?;
    let status = job.document.status;
    let files = app.store.manifest(id).await?;
    let own = format!("/v1/jobs/{id}/results");
    let mut links: BTreeMap<String, String> = files
        .iter()
        .map(|file| (file.name.clone(), format!("{own}/files/{}", file.name)))
        .collect();
    links.insert("archive".to_owned(), format!("{own}/archive"));
    Ok(Json(Manifest {
        job: id,
        status,
        complete: status.is_terminal(),
        files,
        links,
    }))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{FIELDS, Service};

    #[tokio::test]
    async fn files_are_listed_with_length_and_digest() {
        let service = Service::new().await;
        let id = service.with_files().await;
        let (status, _, manifest) = service.get(&format!("/v1/jobs/{id}/results")).await;
        assert_eq!(status, 200);
        assert_eq!(
            (&manifest["complete"], &manifest["status"]),
            (&json!(true), &json!("succeeded"))
        );
        let names: Vec<_> = manifest["files"]
            .as_array()
            .expect("files")
            .iter()
            .map(|file| file["name"].as_str().expect("a name"))
            .collect();
        assert_eq!(names, ["fields-20.vtu", "profile-20.csv", "summary.json"]);
        let fields = &manifest["files"][0];
        assert_eq!(
            (&fields["bytes"], &fields["cycle"], &fields["media_type"]),
            (&json!(FIELDS.len()), &json!(20), &json!("application/xml"))
        );
        assert_eq!(fields["sha256"].as_str().map(str::len), Some(64));
        let link = format!("/v1/jobs/{id}/results/files/summary.json");
        assert_eq!(manifest["links"]["summary.json"], link);
    }

    #[tokio::test]
    async fn before_the_first_file_the_manifest_is_empty() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (_, _, manifest) = service.get(&format!("/v1/jobs/{id}/results")).await;
        assert_eq!(
            (&manifest["complete"], &manifest["files"]),
            (&json!(false), &json!([]))
        );
    }

    #[tokio::test]
    async fn an_unknown_job_is_a_404() {
        let service = Service::new().await;
        let path = "/v1/jobs/00000000-0000-7000-8000-000000000000/results";
        assert_eq!(service.get(path).await.0, 404);
    }
}
