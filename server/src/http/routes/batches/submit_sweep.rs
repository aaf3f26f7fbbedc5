//! `POST /v1/sweeps`: queues many variations of one study.

use api::sweep::{Sweep, SweepRequest};
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::batch::sweep;
use crate::clock::now_ms;
use crate::estimate::machine;
use crate::http::App;
use crate::http::body_problems::BodyProblems;
use crate::http::extract::JsonBody;
use crate::http::limits;
use crate::http::problem::Refusal;
use crate::http::request_key::{KeyError, request_key};
use crate::http::routes::jobs::submit::SubmitError;
use crate::queue;
use crate::spec::Refused;
use crate::store::{NewJob, NewSweep, StoreError, SubmitOptions, Submitted};

/// Why a sweep was not queued.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum SubmitSweepError {
    /// For a reason that a single study has, too.
    #[error(transparent)]
    Submit(#[from] SubmitError),
    /// Its expansion was broken off.
    #[error("the sweep was not expanded: {0}")]
    Expand(#[from] tokio::task::JoinError),
}

impl From<Refused> for SubmitSweepError {
    fn from(refused: Refused) -> Self {
        Self::Submit(refused.into())
    }
}

impl From<KeyError> for SubmitSweepError {
    fn from(error: KeyError) -> Self {
        Self::Submit(error.into())
    }
}

impl From<StoreError> for SubmitSweepError {
    fn from(error: StoreError) -> Self {
        Self::Submit(error.into())
    }
}

impl IntoResponse for SubmitSweepError {
    fn into_response(self) -> Response {
        match self {
            Self::Submit(error) => error.into_response(),
            Self::Expand(_) => Refusal::internal(&self).into_response(),
        }
    }
}

/// Queues many variations of one study: all of them, or none if one has a fault.
#[utoipa::path(
    post,
    path = "/v1/sweeps",
    tag = "sweeps",
    request_body = SweepRequest,
    params(("Idempotency-Key" = Option<String>, Header, description = "Sent twice with the same body, one sweep")),
    responses(
        (status = 202, description = "Queued", body = Sweep, headers(("Location" = String, description = "The sweep"))),
        BodyProblems,
    )
)]
pub(in crate::http) async fn submit_sweep(
    State(app): State<App>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, SubmitSweepError> {
    let key = request_key(&headers, &body)?;
    let request = sweep::read(&body)?;
    let name = request.name.clone();
    let variations = tokio::task::spawn_blocking(move || sweep::expand(&request)).await??;
    for variation in &variations {
        limits::check(&variation.resolved)?;
    }
    let jobs = variations
        .into_iter()
        .enumerate()
        .map(|(position, variation)| {
            let plan = machine::plan(&variation.resolved, app.machine.known());
            let spec = variation.resolved.spec;
            let wishes = SubmitOptions {
                priority: queue::sweep_priority(position),
                deadline_s: None,
            };
            (
                NewJob {
                    spec,
                    plan,
                    options: wishes,
                },
                variation.overrides,
            )
        })
        .collect();
    let new = NewSweep {
        name,
        jobs,
        study: None,
    };
    let id = match app.store.submit_sweep(&new, key.as_ref(), now_ms()).await? {
        Submitted::Job(id) => id,
        Submitted::KeyTaken => return Err(KeyError::Taken.into()),
    };
    let sweep = app.store.sweep(id).await?.ok_or(SubmitError::Gone)?;
    let location = [(header::LOCATION, format!("/v1/sweeps/{id}"))];
    Ok((StatusCode::ACCEPTED, location, Json(sweep)).into_response())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{SWEEP, Service};

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
}
