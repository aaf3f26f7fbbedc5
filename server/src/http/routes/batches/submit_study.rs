//! `POST /v1/studies`: queues the runs that show what accuracy costs.

use std::sync::Arc;

use api::plan::MachineFigures;
use api::problem::Fault;
use api::study::{StudyDocument, StudyRequest};
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::batch::accuracy;
use crate::batch::accuracy::{BUDGET_S, RunPlan, RunPlanError};
use crate::clock::now_ms;
use crate::estimate::machine;
use crate::http::App;
use crate::http::body_problems::BodyProblems;
use crate::http::extract::JsonBody;
use crate::http::limits;
use crate::http::problem::Refusal;
use crate::http::request_key::{KeyError, request_key};
use crate::http::routes::batches::show_study::{StudyShowError, document};
use crate::http::routes::jobs::submit::SubmitError;
use crate::queue;
use crate::spec::{Refused, Resolved};
use crate::store::{NewJob, NewSweep, StoreError, StudyPlan, SubmitOptions, Submitted};

/// Studies whose runs are chosen at once: each keeps a processor busy for seconds.
pub(in crate::http) const AT_ONCE: usize = 2;

/// Why a study was not queued.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum SubmitStudyError {
    /// For a reason that a single job has, too.
    #[error(transparent)]
    Submit(#[from] SubmitError),
    /// What was queued cannot be shown.
    #[error(transparent)]
    Show(#[from] StudyShowError),
    /// The machine could not be measured.
    #[error("the machine that the runs are chosen for could not be measured")]
    Unmeasured,
    /// The choice of its runs was broken off.
    #[error("the runs were not chosen: {0}")]
    Choose(#[from] tokio::task::JoinError),
}

impl From<Refused> for SubmitStudyError {
    fn from(refused: Refused) -> Self {
        Self::Submit(refused.into())
    }
}

impl From<RunPlanError> for SubmitStudyError {
    fn from(error: RunPlanError) -> Self {
        Self::from(match error {
            RunPlanError::Refused(refused) => accuracy::request::of_base(refused),
            RunPlanError::TooExpensive { .. } => {
                Refused::Faults(vec![Fault::new("/budget_s", error.to_string())])
            }
        })
    }
}

impl From<StoreError> for SubmitStudyError {
    fn from(error: StoreError) -> Self {
        Self::Submit(error.into())
    }
}

impl IntoResponse for SubmitStudyError {
    fn into_response(self) -> Response {
        match self {
            Self::Submit(error) => error.into_response(),
            Self::Show(error) => error.into_response(),
            Self::Unmeasured | Self::Choose(_) => Refusal::internal(&self).into_response(),
        }
    }
}

/// Queues the runs of one scene at many accuracies, as ordinary jobs: all of them, or none if one has a fault. They are
/// chosen from what each is expected to take; the first study of a service measures the machine, which takes a second or
/// two.
#[utoipa::path(
    post,
    path = "/v1/studies",
    tag = "studies",
    request_body = StudyRequest,
    params(("Idempotency-Key" = Option<String>, Header, description = "Sent twice with the same body, one study")),
    responses(
        (status = 202, description = "Queued", body = StudyDocument, headers(("Location" = String, description = "The study"))),
        BodyProblems,
    )
)]
pub(in crate::http) async fn submit_study(
    State(app): State<App>,
    headers: HeaderMap,
    JsonBody(body): JsonBody,
) -> Result<Response, SubmitStudyError> {
    let key = request_key(&headers, &body).map_err(SubmitError::from)?;
    let request = accuracy::request::read(&body)?;
    if let Some(key) = &key {
        match app.store.sweep_of(key).await? {
            Some(Submitted::Job(id)) => return queued(&app, id).await,
            Some(Submitted::KeyTaken) => return Err(SubmitError::from(KeyError::Taken).into()),
            None => {}
        }
    }
    let machine = app.machine.wait().await;
    let machine = machine.ok_or(SubmitStudyError::Unmeasured)?;
    let turn = Arc::clone(&app.programmes).acquire_owned().await;
    let choose = {
        let (request, machine) = (request.clone(), machine.clone());
        move || {
            // Held until the choice is made, whether or not anybody still waits for it.
            let _turn = turn;
            choose(&request, &machine)
        }
    };
    let (scene, programme) = tokio::task::spawn_blocking(choose).await??;
    let runs = programme.runs.into_iter().enumerate();
    let jobs = runs.map(|(position, run)| {
        let overrides = serde_json::to_value(run.asked.accuracy());
        let changes = overrides.map(|accuracy| [("/accuracy".to_owned(), accuracy)].into());
        let job = NewJob {
            plan: machine::plan(&run.resolved, Some(&machine)),
            spec: run.resolved.spec,
            options: SubmitOptions {
                priority: queue::sweep_priority(position),
                deadline_s: None,
            },
        };
        changes.map(|changes| (job, changes))
    });
    let new = NewSweep {
        name: request.name,
        jobs: jobs.collect::<Result<_, _>>().map_err(StoreError::from)?,
        study: Some(StudyPlan {
            format: StudyPlan::FORMAT,
            spec: scene.spec,
            grid: programme.grid,
            left_out: programme.left_out,
        }),
    };
    let id = match app.store.submit_sweep(&new, key.as_ref(), now_ms()).await? {
        Submitted::Job(id) => id,
        Submitted::KeyTaken => return Err(SubmitError::from(KeyError::Taken).into()),
    };
    queued(&app, id).await
}

/// The scene and the runs: up to some forty meshes and forecasts, which take seconds.
fn choose(
    request: &StudyRequest,
    machine: &MachineFigures,
) -> Result<(Resolved, RunPlan), SubmitStudyError> {
    let scene = accuracy::request::scene(request)?;
    let budget_s = request.budget_s.unwrap_or(BUDGET_S);
    let programme = RunPlan::within(&scene, machine, budget_s, &limits::check)?;
    Ok((scene, programme))
}

async fn queued(app: &App, id: Uuid) -> Result<Response, SubmitStudyError> {
    let study = document(app, id).await?;
    let location = [(header::LOCATION, format!("/v1/studies/{id}"))];
    Ok((StatusCode::ACCEPTED, location, Json(study)).into_response())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use api::plan::MachineFigures;
    use serde_json::json;
    use tokio::sync::Semaphore;

    use crate::estimate::machine::CalibrationCache;
    use crate::http::tests::{STUDY, Service};

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
        assert_eq!(job["spec"]["accuracy"], json!({"tolerance": 0.1}));
        assert!(job["plan"]["estimates"]["cpu_s"].as_f64() > Some(0.0));
    }

    #[tokio::test]
    async fn faults_of_the_base_and_of_the_budget_are_told_and_nothing_is_queued() {
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
    async fn a_budget_that_not_even_one_run_fits_into_is_refused() {
        let mut service = Service::new().await;
        let known = service.app.machine.known().expect("figures").clone();
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
        // What is queued already is told without choosing its runs again.
        service.app.programmes = Arc::new(Semaphore::new(0));
        let again = service.send("POST", "/v1/studies", &keyed, STUDY);
        let again = tokio::time::timeout(Duration::from_mins(1), again).await;
        assert_eq!(first["id"], again.expect("an answer").2["id"]);
    }
}
