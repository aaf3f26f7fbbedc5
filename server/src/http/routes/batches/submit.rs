//! `POST /v1/sweeps` and `POST /v1/studies`: queues the jobs of a batch.

use api::study::{StudyDocument, StudyRequest};
use api::sweep::{Sweep, SweepRequest};
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::batch::Kind;
use crate::http::app::{App, MAX_EXPANSIONS};
use crate::http::extract::{BatchId, JsonBody};
use crate::http::idempotency_key::{KeyError, idempotency_key};
use crate::http::limits;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::batches::show::document;
use crate::http::slots::MAX_WAITING;
use crate::store::Submitted;

/// Error of a study while too many others wait to be expanded.
#[derive(Debug, thiserror::Error)]
#[error(
    "{MAX_EXPANSIONS} studies are being expanded and {MAX_WAITING} wait for it, which is the limit"
)]
struct TooManyStudiesError;

impl RouteError for TooManyStudiesError {
    const TYPE: ProblemType = ProblemType::BUSY;
}

/// Queues many variations of one specification, or none if one has a fault; of more than 1 000, a sample is checked.
#[utoipa::path(
    post,
    path = "/v1/sweeps",
    tag = "sweeps",
    request_body = SweepRequest,
    params(("Idempotency-Key" = Option<String>, Header, description = "Sent twice with the same body, one sweep")),
    responses(
        (status = 202, description = "Queued", body = Sweep, headers(("Location" = String, description = "The sweep"))),
    )
)]
pub(crate) async fn submit_sweep(
    State(app): State<App>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, ProblemResponse> {
    submit(&app, Kind::Sweep, &headers, &body).await
}

/// Queues the runs of one scene at many accuracies, as ordinary jobs: all of them, or none if one has a fault. They are
/// chosen by their expected time; the first study of a service measures the machine, which takes a second or two.
#[utoipa::path(
    post,
    path = "/v1/studies",
    tag = "studies",
    request_body = StudyRequest,
    params(("Idempotency-Key" = Option<String>, Header, description = "Sent twice with the same body, one study")),
    responses(
        (status = 202, description = "Queued", body = StudyDocument, headers(("Location" = String, description = "The study"))),
    )
)]
pub(crate) async fn submit_study(
    State(app): State<App>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, ProblemResponse> {
    submit(&app, Kind::AccuracyStudy, &headers, &body).await
}

async fn submit(
    app: &App,
    kind: Kind,
    headers: &HeaderMap,
    body: &Bytes,
) -> Result<Response, ProblemResponse> {
    let key = idempotency_key(headers, "", body)?;
    let request = kind.read(body)?;
    let earlier = match &key {
        Some(key) => app.store.submitted_batch(key).await?,
        None => None,
    };
    let submitted = if let Some(earlier) = earlier {
        earlier
    } else {
        let machine = match kind {
            Kind::Sweep => app.machine.get().cloned(),
            Kind::AccuracyStudy => app.machine.get_or_measure_async().await,
        };
        let permit = match kind {
            Kind::Sweep => None,
            Kind::AccuracyStudy => {
                let slot = app.expansion_slots.take().await;
                Some(slot.ok_or(TooManyStudiesError)?)
            }
        };
        let expand = move || {
            // Held until the expansion ends, also after the client has disconnected.
            let _permit = permit;
            request.expand(machine.as_ref(), &limits::check)
        };
        let batch = tokio::task::spawn_blocking(expand).await??;
        let store = &app.store;
        store.submit_batch(&batch, key.as_ref()).await?
    };
    let Submitted::Job(id) = submitted else {
        return Err(KeyError::Reused.into());
    };
    let document = document(app, BatchId { kind, id }).await?;
    let path = format!("/v1/{}/{id}", kind.collection());
    Ok((StatusCode::ACCEPTED, [(header::LOCATION, path)], document).into_response())
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use api::plan::MachineFigures;
    use serde_json::json;

    use crate::estimate::machine::CalibrationCache;
    use crate::http::slots::Slots;
    use crate::http::tests::{STUDY, SWEEP, Service};

    #[tokio::test]
    async fn a_sweep_queues_its_jobs_in_order() {
        let service = Service::new().await;
        let (status, headers, sweep) = service.post("/v1/sweeps", SWEEP).await;
        assert_eq!(status, 202, "{sweep}");
        let id = sweep["id"].as_str().expect("an id");
        assert_eq!(headers["location"], format!("/v1/sweeps/{id}").as_str());
        assert_eq!(sweep["counts"]["queued"], 4);
        assert_eq!(
            sweep["jobs"][1]["overrides"],
            json!({"/cycles": 10, "/load/n": 0.6})
        );
        let first = sweep["jobs"][0]["id"].as_str().expect("an id");
        let (_, _, job) = service.get(&format!("/v1/jobs/{first}")).await;
        assert_eq!(
            (&job["spec"]["cycles"], &job["spec"]["load"]["n"]),
            (&json!(10), &json!(0.3))
        );
        let (_, _, list) = service.get(&format!("/v1/jobs?sweep={id}")).await;
        assert_eq!(list["jobs"].as_array().map(Vec::len), Some(4));
    }

    #[tokio::test]
    async fn one_faulty_job_queues_none() {
        let service = Service::new().await;
        let body = r#"{"base":{"system":{"kind":"dimm"}},"grid":{"/cycles":[10,0]}}"#;
        let (status, _, problem) = service.post("/v1/sweeps", body).await;
        assert_eq!(status, 422);
        assert_eq!(problem["faults"][0]["pointer"], "/grid/~1cycles");
        assert_eq!(service.get("/v1/jobs").await.2["jobs"], json!([]));
        let (status, _, problem) = service.post("/v1/sweeps", r#"{"base":{},"gird":{}}"#).await;
        assert_eq!(status, 400, "{problem}");
    }

    #[tokio::test]
    async fn arrays_of_fields_are_no_objects() {
        let service = Service::new().await;
        for (path, body, status, pointer) in [
            ("jobs", r#"[{"kind":"dimm"}]"#, 400, ""),
            ("plans", r#"{"system":["dimm"]}"#, 400, "/system"),
            ("worker-tokens", r#"["cluster"]"#, 400, ""),
            ("studies", r#"["n",{"system":{"kind":"dimm"}},9]"#, 400, ""),
            (
                "sweeps",
                r#"["n",{"system":{"kind":"dimm"}},{"/cycles":[9]},null]"#,
                400,
                "",
            ),
            (
                "sweeps",
                r#"{"base":{"system":{"kind":"dimm"}},"grid":[]}"#,
                400,
                "/grid",
            ),
            (
                "sweeps",
                r#"{"base":{"system":{"kind":"dimm"},"load":["force",1]},"list":[{}]}"#,
                422,
                "/base/load",
            ),
            (
                "sweeps",
                r#"{"base":{"system":{"kind":"dimm"}},"list":[{"/load":["force",1]}]}"#,
                422,
                "/list/0/~1load",
            ),
        ] {
            let (found, _, problem) = service.post(&format!("/v1/{path}"), body).await;
            let at = &problem["faults"][0]["pointer"];
            assert_eq!((found.as_u16(), at), (status, &json!(pointer)), "{problem}");
        }
        assert_eq!(service.get("/v1/jobs").await.2["jobs"], json!([]));
    }

    #[tokio::test]
    async fn the_same_key_and_body_make_one_sweep() {
        let service = Service::new().await;
        let keyed = [
            ("content-type", "application/json"),
            ("idempotency-key", "s"),
        ];
        let (_, _, first) = service.send("POST", "/v1/sweeps", &keyed, SWEEP).await;
        let (_, _, again) = service.send("POST", "/v1/sweeps", &keyed, SWEEP).await;
        assert_eq!(first["id"], again["id"]);
        let other = r#"{"base":{"system":{"kind":"dimm"}},"list":[{}]}"#;
        assert_eq!(
            service.send("POST", "/v1/sweeps", &keyed, other).await.0,
            422
        );
        let (_, _, list) = service.get("/v1/jobs").await;
        assert_eq!(list["jobs"].as_array().map(Vec::len), Some(4));
    }

    #[tokio::test]
    async fn a_study_queues_ordinary_jobs_that_differ_in_their_accuracy() {
        let service = Service::new().await;
        let (status, headers, study) = service.post("/v1/studies", STUDY).await;
        assert_eq!(status, 202, "{study}");
        let id = study["id"].as_str().expect("an id");
        assert_eq!(headers["location"], format!("/v1/studies/{id}").as_str());
        let jobs = study["jobs"].as_array().expect("jobs");
        let with = |what: &str| jobs.iter().filter(|job| job[what].is_number()).count();
        assert!(with("tolerance") >= 3 && with("cycle_jump") >= 9, "{study}");
        assert_eq!(with("tolerance") + with("contact_element_mm"), jobs.len());
        let first = jobs[0]["id"].as_str().expect("an id");
        let (_, _, job) = service.get(&format!("/v1/jobs/{first}")).await;
        let accuracy = json!({"tolerance": 0.1, "estimate_errors": false});
        assert_eq!(job["spec"]["accuracy"], accuracy);
        assert!(job["plan"]["estimates"]["cpu_s"].as_f64() > Some(0.0));
    }

    #[tokio::test]
    async fn faults_of_the_base_and_of_the_budget_are_reported_and_nothing_is_queued() {
        let service = Service::new().await;
        let body = r#"{"base":{"system":{"kind":"dimm"},"cycles":0},"budget_s":-1}"#;
        let (status, _, problem) = service.post("/v1/studies", body).await;
        assert_eq!(status, 422);
        let faults = problem["faults"].as_array().expect("faults");
        let pointers: Vec<_> = faults.iter().map(|fault| &fault["pointer"]).collect();
        assert_eq!(pointers, ["/budget_s", "/base/cycles"]);
        let (status, _, _) = service.post("/v1/studies", r#"{"basis":{}}"#).await;
        assert_eq!(status, 400);
        assert_eq!(service.get("/v1/jobs").await.2["jobs"], json!([]));
    }

    #[tokio::test]
    async fn a_budget_too_small_for_any_run_is_refused() {
        let mut service = Service::new().await;
        let known = service.app.machine.get().expect("figures").clone();
        service.app.machine = CalibrationCache::of(MachineFigures {
            increment_s: 1e3,
            ..known
        });
        let (status, _, problem) = service.post("/v1/studies", STUDY).await;
        assert_eq!(
            (status.as_u16(), &problem["faults"][0]["pointer"]),
            (422, &json!("/budget_s")),
            "{problem}"
        );
    }

    #[tokio::test]
    async fn the_same_key_and_body_make_one_study() {
        let mut service = Service::new().await;
        let keyed = [
            ("content-type", "application/json"),
            ("idempotency-key", "s"),
        ];
        let (_, _, first) = service.send("POST", "/v1/studies", &keyed, STUDY).await;
        // A study that is queued already is shown without choosing its runs again.
        service.app.expansion_slots = Slots::new(0);
        let again = service.send("POST", "/v1/studies", &keyed, STUDY);
        let again = tokio::time::timeout(Duration::from_mins(1), again).await;
        assert_eq!(first["id"], again.expect("an answer").2["id"]);
    }

    #[tokio::test]
    async fn a_sweep_does_not_wait_for_studies_that_are_expanded() {
        let mut service = Service::new().await;
        service.app.expansion_slots = Slots::new(0);
        let sweep = service.post("/v1/sweeps", SWEEP);
        let sweep = tokio::time::timeout(Duration::from_mins(1), sweep).await;
        assert_eq!(sweep.expect("an answer").0, 202);
    }
}
