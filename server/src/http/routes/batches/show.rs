//! `GET /v1/sweeps/{id}` and `GET /v1/studies/{id}`: a batch with its jobs; a study with the comparison of its results.

use api::problem::Problem;
use api::study::StudyDocument;
use api::sweep::Sweep;
use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::batch::Document;
use crate::http::app::App;
use crate::http::extract::{BatchId, Params};
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::error::{BatchError, MOST_JOBS};
use crate::store::BatchPart;

/// Part of the jobs of a batch.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct PartQuery {
    /// Position of the first job, from 0.
    #[serde(default)]
    #[param(value_type = Option<u64>)]
    from: u64,
    /// Largest number of jobs.
    #[serde(default = "most_jobs")]
    #[param(value_type = Option<u32>, minimum = 1, maximum = 1000)]
    limit: u32,
}

fn most_jobs() -> u32 {
    MOST_JOBS
}

impl PartQuery {
    fn part(self) -> Result<BatchPart, BatchError> {
        let Self { from, limit } = self;
        if !(1..=MOST_JOBS).contains(&limit) {
            return Err(BatchError::Limit(limit));
        }
        Ok(BatchPart { from, limit })
    }
}

/// A batch with its jobs.
type Shown = Result<Json<Document>, ProblemResponse>;

/// A sweep, with its first jobs or another part of them.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}",
    tag = "sweeps",
    params(PartQuery),
    responses(
        (status = 200, description = "The sweep", body = Sweep),
    )
)]
pub(crate) async fn show_sweep(
    app: State<App>,
    batch: BatchId,
    Params(query): Params<PartQuery>,
) -> Shown {
    part(&app, batch, query.part()?).await
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

/// Returns a batch with its jobs, of a large one the first of them.
pub(super) async fn document(app: &App, batch: BatchId) -> Shown {
    let first = BatchPart {
        from: 0,
        limit: MOST_JOBS,
    };
    part(app, batch, first).await
}

async fn part(app: &App, batch: BatchId, part: BatchPart) -> Shown {
    let kind = batch.kind;
    let evaluate = move |stored| kind.document(stored, part);
    let document = app
        .evaluate_batch(batch, part, kind.document_detail(), evaluate)
        .await?;
    Ok(Json(document))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{STUDY, SWEEP, Service};
    use crate::store::{BatchDetail, BatchPart, NewBatch, Submitted};

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
    async fn the_jobs_of_a_large_sweep_are_shown_in_parts() {
        let service = Service::new().await;
        let cycles: Vec<u32> = (1..=251).collect();
        let grid = json!({"/cycles": cycles, "/load/n": [0.3, 0.4, 0.5, 0.6]});
        let body = json!({"base": {"system": {"kind": "dimm"}}, "grid": grid});
        let (status, _, sweep) = service.post("/v1/sweeps", &body.to_string()).await;
        assert_eq!(status, 202, "{sweep}");
        assert_eq!(sweep["jobs"].as_array().map(Vec::len), Some(250));
        assert_eq!(
            (&sweep["asked"], &sweep["to_come"]),
            (&json!(1_004), &json!(754))
        );
        assert_eq!(sweep["counts"]["queued"], 250);
        assert_eq!(
            sweep["links"]["next"],
            json!(null),
            "the others have no jobs yet"
        );
        let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
        let (status, _, part) = service.get(&format!("{path}?from=5&limit=3")).await;
        assert_eq!(status, 200);
        let jobs = part["jobs"].as_array().expect("jobs");
        let positions: Vec<_> = jobs.iter().map(|job| job["position"].clone()).collect();
        assert_eq!(positions, [5, 6, 7]);
        let changes = json!({"/cycles": 2, "/load/n": 0.4});
        assert_eq!(
            jobs[0]["overrides"], changes,
            "the last pointer varies fastest"
        );
        assert_eq!(part["links"]["next"], format!("{path}?from=8&limit=3"));
        let rows = service
            .text("GET", &format!("{path}/outcomes?from=248&limit=9"), &[], "")
            .await;
        assert_eq!(rows.2.lines().count(), 1 + 2, "{}", rows.2);
        let (_, _, list) = service.get("/v1/sweeps").await;
        assert_eq!(list["sweeps"][0]["to_come"], 754);
        for query in ["limit=0", "limit=1001", "from=-1", "page=2"] {
            let (status, _, problem) = service.get(&format!("{path}?{query}")).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (400, Some("/problems/invalid-query")), "{query}");
        }
        let (_, _, ended) = service.post(&format!("{path}/cancel"), "").await;
        assert_eq!(
            (&ended["to_come"], &ended["counts"]["cancelled"]),
            (&json!(0), &json!(250))
        );
    }

    #[tokio::test]
    async fn a_value_that_a_later_job_of_a_large_sweep_would_have_is_refused_at_once() {
        let service = Service::new().await;
        let mut cycles: Vec<u32> = (1..=400).collect();
        cycles[333] = 0;
        let grid = json!({"/cycles": cycles, "/load/n": [0.3, 0.4, 0.5, 0.6]});
        let body = json!({"base": {"system": {"kind": "dimm"}}, "grid": grid});
        let (status, _, problem) = service.post("/v1/sweeps", &body.to_string()).await;
        assert_eq!(status, 422);
        assert_eq!(problem["faults"][0]["pointer"], "/grid/~1cycles");
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
        let known = store
            .batch(id, BatchPart::WHOLE, BatchDetail::Statuses)
            .await;
        let plan = known.expect("the store").expect("a study").plan;
        let plan = plan.expect("an evaluation plan");
        let other = NewBatch {
            name: None,
            base: "{}".to_owned(),
            jobs: Vec::new(),
            expansion: None,
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
