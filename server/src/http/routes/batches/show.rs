//! `GET /v1/sweeps/{id}` and `GET /v1/studies/{id}`: a batch with its jobs; a study with the comparison of its results.

use api::problem::Problem;
use api::study::StudyDocument;
use api::sweep::Sweep;
use axum::Json;
use axum::extract::State;

use crate::batch::Document;
use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;

/// A batch with its jobs.
type Shown = Result<Json<Document>, ProblemResponse>;

/// A sweep.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}",
    tag = "sweeps",
    responses(
        (status = 200, description = "The sweep", body = Sweep),
    )
)]
pub(crate) async fn show_sweep(app: State<App>, batch: BatchId) -> Shown {
    document(&app, batch).await
}

/// A study of accuracy: its jobs, and their results so far with errors, Pareto front and observed orders.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}",
    tag = "studies",
    responses(
        (status = 200, description = "The study", body = StudyDocument),
        (status = 410, description = "Queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(crate) async fn show_study(app: State<App>, batch: BatchId) -> Shown {
    document(&app, batch).await
}

/// Returns a batch with its jobs.
pub(super) async fn document(app: &App, batch: BatchId) -> Shown {
    let kind = batch.kind;
    let evaluate = move |stored| kind.document(stored);
    let document = app
        .evaluate_batch(batch, kind.document_detail(), evaluate)
        .await?;
    Ok(Json(document))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{STUDY, SWEEP, Service};
    use crate::store::{BatchDetail, NewBatch, Submitted};

    #[tokio::test]
    async fn counts_follow_the_jobs() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
        let claim = service.app.store.claim_next(i64::MAX).await;
        claim.expect("a job");
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

    #[tokio::test]
    async fn a_study_has_no_results_before_its_jobs_have() {
        let service = Service::new().await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let path = format!("/v1/studies/{}", study["id"].as_str().expect("an id"));
        let (status, _, study) = service.get(&path).await;
        assert_eq!(status, 200);
        assert!(study["study"].is_null());
        let jobs = study["jobs"].as_array().expect("jobs").len();
        assert_eq!(study["counts"]["queued"], jobs);
        for part in ["table", "picture"] {
            let (status, _, problem) = service.get(&format!("{path}/{part}")).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-result")), "{part}");
        }
    }

    #[tokio::test]
    async fn a_study_of_another_format_cannot_be_compared() {
        let service = Service::new().await;
        let store = &service.app.store;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let id = study["id"].as_str().expect("an id");
        let id = id.parse().expect("an id");
        let known = store.batch(id, BatchDetail::Statuses).await;
        let plan = known.expect("the store").expect("a study").plan;
        let plan = plan.expect("an evaluation plan");
        let other = NewBatch {
            name: None,
            jobs: Vec::new(),
            plan: Some(plan.replacen(r#""format":1"#, r#""format":2"#, 1)),
        };
        let submitted = store.submit_batch(&other, None).await;
        let Ok(Submitted::Job(id)) = submitted else {
            panic!("{submitted:?}");
        };
        let (status, _, problem) = service.get(&format!("/v1/studies/{id}")).await;
        assert_eq!(status, 410, "{problem}");
        assert_eq!(problem["title"], "the study cannot be compared any more");
    }

    #[tokio::test]
    async fn a_sweep_is_not_shown_as_a_study() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        for id in [sweep["id"].as_str().expect("an id"), "1"] {
            let (status, _, problem) = service.get(&format!("/v1/studies/{id}")).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-study")), "{id}");
        }
    }
}
