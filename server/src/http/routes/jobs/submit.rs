//! `POST /v1/jobs`: queues a study.

use api::job::Job;
use api::plan::PlanDocument;
use api::problem::Fault;
use api::spec::Spec;
use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::clock::now_ms;
use crate::estimate::machine;
use crate::http::App;
use crate::http::body_problems::BodyProblems;
use crate::http::extract::{JsonBody, Params};
use crate::http::limits;
use crate::http::problem::{Kind, Refusal};
use crate::http::request_key::{KeyError, request_key};
use crate::http::routes::jobs::show::retry_after_s;
use crate::queue::MAX_PRIORITY;
use crate::spec;
use crate::spec::{Refused, Resolved};
use crate::store::{NewJob, StoreError, SubmitOptions, Submitted};

/// Why a study was not queued.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum SubmitError {
    /// It is not a study.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The key cannot be taken.
    #[error(transparent)]
    Key(#[from] KeyError),
    /// The priority is out of range.
    #[error("priority {0} is not from -{MAX_PRIORITY} to {MAX_PRIORITY}")]
    Priority(i32),
    /// Its resolution was broken off.
    #[error("the specification was not resolved: {0}")]
    Broken(#[from] tokio::task::JoinError),
    /// The job is gone again.
    #[error("the job was deleted at once")]
    Gone,
}

impl IntoResponse for SubmitError {
    fn into_response(self) -> Response {
        match self {
            Self::Refused(refused) => refusal(refused).into_response(),
            Self::Store(error) => Refusal::from(&error).into_response(),
            Self::Key(error) => error.into_response(),
            Self::Priority(_) => Kind::InvalidQuery.because(self.to_string()).into_response(),
            Self::Broken(error) => Refusal::internal(&error).into_response(),
            Self::Gone => Kind::NoJob
                .because("the job was deleted at once")
                .into_response(),
        }
    }
}

/// A refused document as a problem.
fn refusal(refused: Refused) -> Refusal {
    match refused {
        Refused::Broken(broken) => {
            let fault = Fault::new(broken.pointer.clone(), broken.detail.clone());
            Kind::Unreadable
                .because(broken.to_string())
                .with_faults(vec![fault])
        }
        Refused::Faults(faults) => Kind::InvalidSpecification
            .because(format!("{} fault(s) in the specification", faults.len()))
            .with_faults(faults),
    }
}

/// Resolves a specification. A large mesh takes a while to make, in which other requests are answered.
pub(in crate::http) async fn resolved(body: Bytes) -> Result<Resolved, SubmitError> {
    Ok(tokio::task::spawn_blocking(move || spec::read(&body)).await??)
}

/// How to submit.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(in crate::http) struct SubmitQuery {
    /// Check the specification and answer with its plan; queue nothing.
    #[serde(default)]
    #[param(required = false)]
    validate_only: bool,
    /// How many minutes older the job counts in the queue than it is.
    #[serde(default)]
    #[param(required = false, minimum = -100, maximum = 100)]
    priority: i32,
    /// The job fails unless it has ended so many seconds after its submission.
    deadline_s: Option<u32>,
}

impl SubmitQuery {
    fn wishes(&self) -> Result<SubmitOptions, SubmitError> {
        // Without `abs`, which the smallest number does not have.
        if !(-MAX_PRIORITY..=MAX_PRIORITY).contains(&self.priority) {
            return Err(SubmitError::Priority(self.priority));
        }
        Ok(SubmitOptions {
            priority: self.priority,
            deadline_s: self.deadline_s,
        })
    }
}

/// Queues a study.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    tag = "jobs",
    request_body = Spec,
    params(
        SubmitQuery,
        ("Idempotency-Key" = Option<String>, Header, description = "Sent twice with the same body, one job"),
    ),
    responses(
        (status = 200, description = "Valid, and nothing queued (`validate_only`)", body = PlanDocument),
        (status = 202, description = "Queued", body = Job, headers(
            ("Location" = String, description = "The job"),
            ("Retry-After" = u64, description = "When a poll is likely to find something new, s"),
        )),
        BodyProblems,
    )
)]
pub(in crate::http) async fn submit(
    State(app): State<App>,
    Params(query): Params<SubmitQuery>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, SubmitError> {
    let wishes = query.wishes()?;
    let key = request_key(&headers, &body)?;
    let resolved = resolved(body).await?;
    limits::check(&resolved)?;
    let machine = app.machine.known();
    let plan = machine::plan(&resolved, machine);
    let Resolved { spec, .. } = resolved;
    if query.validate_only {
        let machine = machine.cloned();
        let document = PlanDocument {
            spec,
            plan,
            machine,
        };
        return Ok(Json(document).into_response());
    }
    let new = NewJob {
        spec,
        plan,
        options: wishes,
    };
    let id = match key {
        None => app.store.submit(&new, now_ms()).await?,
        Some(key) => match app.store.submit_once(&new, &key, now_ms()).await? {
            Submitted::Job(id) => id,
            Submitted::KeyTaken => return Err(KeyError::Taken.into()),
        },
    };
    let job = app.store.job(id).await?.ok_or(SubmitError::Gone)?;
    let headers = [
        (header::LOCATION, format!("/v1/jobs/{id}")),
        (
            header::RETRY_AFTER,
            retry_after_s(&job.document).to_string(),
        ),
    ];
    Ok((StatusCode::ACCEPTED, headers, Json(job.document)).into_response())
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_study_is_queued_and_located() {
        let service = Service::new().await;
        let (status, headers, job) = service
            .post("/v1/jobs", r#"{"system":{"kind":"sd_card"}}"#)
            .await;
        assert_eq!(status, 202);
        let location = headers["location"].to_str().expect("text").to_owned();
        assert_eq!(
            location,
            format!("/v1/jobs/{}", job["id"].as_str().expect("an id"))
        );
        assert_eq!(job["status"], "queued");
        assert_eq!(job["status_reason"], "waiting for a worker");
        assert_eq!(job["spec"]["provenance"]["/load/n"], "assumed");
    }

    #[tokio::test]
    async fn priority_and_deadline_are_kept_and_shown() {
        let service = Service::new().await;
        let body = r#"{"system":{"kind":"sd_card"}}"#;
        let (status, _, job) = service
            .post("/v1/jobs?priority=-7&deadline_s=60", body)
            .await;
        assert_eq!((status.as_u16(), &job["priority"]), (202, &(-7).into()));
        assert!(job["deadline_at"].as_str() > job["created_at"].as_str());
        for query in ["priority=101", "priority=high", "deadline_s=-1"] {
            let (status, _, problem) = service.post(&format!("/v1/jobs?{query}"), body).await;
            assert_eq!(
                (status.as_u16(), problem["type"].as_str()),
                (400, Some("/problems/invalid-query")),
                "{query}"
            );
        }
    }

    #[tokio::test]
    async fn all_faults_come_at_once_and_nothing_is_queued() {
        let service = Service::new().await;
        let text = r#"{"frobnicate":1,"system":{"kind":"cylinder_on_flat","radius_mm":-6},"materials":{"slider":"cheese"}}"#;
        let (status, headers, problem) = service.post("/v1/jobs", text).await;
        assert_eq!(status, 422);
        assert_eq!(headers["content-type"], "application/problem+json");
        assert_eq!(problem["type"], "/problems/invalid-specification");
        let mut pointers: Vec<_> = problem["faults"]
            .as_array()
            .expect("faults")
            .iter()
            .map(|fault| fault["pointer"].as_str().expect("a pointer").to_owned())
            .collect();
        pointers.sort();
        assert_eq!(
            pointers,
            ["/frobnicate", "/materials/slider", "/system/radius_mm"]
        );
        let (_, _, list) = service.get("/v1/jobs").await;
        assert_eq!(list["jobs"], Value::Array(Vec::new()));
    }

    #[tokio::test]
    async fn what_cannot_be_read_is_a_400_with_its_place() {
        let service = Service::new().await;
        let cases = [
            ("{\"system\":{\"kind\":\"dimm\"},\"cycles\":NaN}", ""),
            ("{\"system\":", ""),
            ("", ""),
            (r#"{"system":{"kind":"dimm"},"cycles":"many"}"#, "/cycles"),
            (
                r#"{"system":{"kind":"dimm","contact_radius_mm":1e400}}"#,
                "",
            ),
        ];
        for (text, pointer) in cases {
            let (status, _, problem) = service.post("/v1/jobs", text).await;
            assert_eq!(status, 400, "{text}");
            assert_eq!(problem["faults"][0]["pointer"], pointer, "{text}");
            assert!(
                problem["detail"]
                    .as_str()
                    .expect("words")
                    .contains("line 1, column"),
                "{problem}"
            );
        }
    }

    #[tokio::test]
    async fn large_and_undeclared_bodies_are_refused() {
        let service = Service::new().await;
        let large = format!(r#"{{"name":"{}"}}"#, "x".repeat(2 << 20));
        let (status, _, problem) = service.post("/v1/jobs", &large).await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (413, Some("/problems/body-too-large"))
        );
        let (status, _, problem) = service
            .send("POST", "/v1/jobs", &[("content-type", "text/plain")], "{}")
            .await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (415, Some("/problems/media-type"))
        );
    }

    #[tokio::test]
    async fn validating_only_queues_nothing() {
        let service = Service::new().await;
        let path = "/v1/jobs?validate_only=true";
        let (status, _, document) = service.post(path, r#"{"system":{"kind":"dimm"}}"#).await;
        assert_eq!(status, 200);
        assert!(document["plan"]["estimates"].is_object());
        assert_eq!(
            service.post(path, r#"{"system":{"kind":"x"}}"#).await.0,
            422
        );
        for query in ["validate_only=maybe", "validate=true"] {
            let path = format!("/v1/jobs?{query}");
            let (status, _, problem) = service.post(&path, r#"{"system":{"kind":"dimm"}}"#).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (400, Some("/problems/invalid-query")), "{query}");
        }
        assert_eq!(
            service.get("/v1/jobs").await.2["jobs"],
            Value::Array(Vec::new())
        );
    }
}
