//! `POST /v1/jobs`: queues a job.

use api::job::Job;
use api::plan::PlanDocument;
use api::spec::Spec;
use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::estimate::Estimate;
use crate::http::app::App;
use crate::http::extract::{JsonBody, Params};
use crate::http::idempotency_key::{KeyError, idempotency_key};
use crate::http::job_error::JobError;
use crate::http::limits;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::jobs::show::retry_after_s;
use crate::queue::MAX_PRIORITY;
use crate::spec;
use crate::spec::{Refused, Resolved};
use crate::store::{NewJob, SubmitOptions, Submitted};

/// Error of an option that is out of range.
#[derive(Debug, thiserror::Error)]
enum OptionError {
    /// The priority.
    #[error("priority {0} is not from -{MAX_PRIORITY} to {MAX_PRIORITY}")]
    Priority(i32),
    /// A job cannot end before it is submitted.
    #[error("deadline_s is 0; it can be 1 or more")]
    Deadline,
}

impl RouteError for OptionError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Options of a submission.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct SubmitQuery {
    /// Validates the specification and returns its plan; queues nothing.
    #[serde(default)]
    #[param(required = false)]
    validate_only: bool,
    /// Minutes that are added to the job's age in the queue.
    #[serde(default)]
    #[param(required = false, minimum = -100, maximum = 100)]
    priority: i32,
    /// The job fails if it has not ended this many seconds after its submission.
    #[param(minimum = 1)]
    deadline_s: Option<u32>,
}

impl SubmitQuery {
    fn options(&self) -> Result<SubmitOptions, OptionError> {
        // Not `abs`, which overflows for the smallest number.
        if !(-MAX_PRIORITY..=MAX_PRIORITY).contains(&self.priority) {
            return Err(OptionError::Priority(self.priority));
        }
        if self.deadline_s == Some(0) {
            return Err(OptionError::Deadline);
        }
        Ok(SubmitOptions {
            priority: self.priority,
            deadline_s: self.deadline_s,
        })
    }
}

/// Queues a job.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    tag = "jobs",
    request_body = Spec,
    params(
        SubmitQuery,
        ("Idempotency-Key" = Option<String>, Header, description = "Requests with the same key, body (its JSON value) and query queue one job"),
    ),
    responses(
        (status = 200, description = "The specification is valid; nothing was queued (`validate_only`)", body = PlanDocument),
        (status = 202, description = "Queued", body = Job, headers(
            ("Location" = String, description = "The job"),
            ("Retry-After" = u64, description = "Recommended pause before the first poll, s"),
        )),
    )
)]
pub(crate) async fn submit(
    State(app): State<App>,
    Params(query): Params<SubmitQuery>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, ProblemResponse> {
    let options = query.options()?;
    let key = idempotency_key(&headers, format_args!("{options:?}"), &body)?;
    let (resolved, estimate) = resolve(body.clone()).await?;
    limits::check(&estimate)?;
    let machine = app.machine.get();
    let plan = estimate.plan(&resolved, machine);
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
        sent: spec::text(&body),
        spec,
        plan,
        options,
    };
    let Submitted::Job(id) = app.store.submit(&new, key.as_ref()).await? else {
        return Err(KeyError::Reused.into());
    };
    let job = app.store.job(id).await?.ok_or(JobError::Deleted(id))?;
    let headers = [
        (header::LOCATION, format!("/v1/jobs/{id}")),
        (
            header::RETRY_AFTER,
            retry_after_s(&job.document).to_string(),
        ),
    ];
    Ok((StatusCode::ACCEPTED, headers, Json(job.document)).into_response())
}

/// Resolves a specification and estimates its solve, on a thread for blocking work.
pub(crate) async fn resolve(body: Bytes) -> Result<(Resolved, Estimate), ProblemResponse> {
    let resolve = move || {
        let resolved = spec::read(&body)?;
        let estimate = Estimate::of(&resolved);
        Ok::<_, Refused>((resolved, estimate))
    };
    Ok(tokio::task::spawn_blocking(resolve).await??)
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_job_is_queued_and_located() {
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
    async fn priority_and_deadline_are_stored_and_shown() {
        let service = Service::new().await;
        let body = r#"{"system":{"kind":"sd_card"}}"#;
        let (status, _, job) = service
            .post("/v1/jobs?priority=-7&deadline_s=60", body)
            .await;
        assert_eq!((status.as_u16(), &job["priority"]), (202, &(-7).into()));
        assert!(job["deadline_at"].as_str() > job["created_at"].as_str());
        for query in [
            "priority=101",
            "priority=high",
            "deadline_s=-1",
            "deadline_s=0",
        ] {
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
    async fn an_unreadable_body_is_a_400_with_line_and_pointer() {
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
                    .expect("text")
                    .contains("line 1, column"),
                "{problem}"
            );
        }
    }

    #[tokio::test]
    async fn large_and_undeclared_bodies_are_rejected() {
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
    async fn validate_only_queues_nothing() {
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
