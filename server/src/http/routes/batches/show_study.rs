//! `GET /v1/studies/{id}`: a study of accuracy with what its results so far come to.

use api::problem::Problem;
use api::study::{Study, StudyDocument, StudyJob};
use api::sweep::SweepJob;
use axum::Json;
use axum::extract::State;
use uuid::Uuid;

use crate::batch::accuracy;
use crate::batch::accuracy::{Asked, Found, Run, Spent};
use crate::http::App;
use crate::http::extract::StudyId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::{StoreError, StoredStudy, SweepOutcome};

/// Why there is nothing about a study.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum StudyShowError {
    /// There is none of that id.
    #[error("there is no study {0}")]
    Missing(Uuid),
    /// Nothing can be compared yet.
    #[error("no job of study {0} has a result that others can be compared with so far")]
    Empty(Uuid),
}

impl RouteError for StudyShowError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing(_) => ProblemType::NoSuchStudy,
            Self::Empty(_) => ProblemType::NoSuchResult,
        }
    }
}

/// A study of accuracy: its jobs, and their results so far with errors, Pareto front and observed orders.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}",
    tag = "studies",
    params(("id" = Uuid, Path, description = "The study")),
    responses(
        (status = 200, description = "The study", body = StudyDocument),
        (status = 404, description = "No such study", body = Problem),
        (status = 410, description = "Queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(in crate::http) async fn show_study(
    State(app): State<App>,
    StudyId(id): StudyId,
) -> Result<Json<StudyDocument>, ProblemResponse> {
    Ok(Json(document(&app, id).await?))
}

/// A study as it stands.
pub(in crate::http) async fn document(
    app: &App,
    id: Uuid,
) -> Result<StudyDocument, ProblemResponse> {
    let stored = app.store.study(id).await?;
    let stored = stored.ok_or(StudyShowError::Missing(id))?;
    // Profiles of dozens of runs are read, and compared at thousands of places.
    tokio::task::spawn_blocking(move || described(stored)).await?
}

/// What the results of a study come to so far.
pub(in crate::http) async fn evaluated(app: &App, id: Uuid) -> Result<Study, ProblemResponse> {
    let document = document(app, id).await?;
    Ok(document.study.ok_or(StudyShowError::Empty(id))?)
}

fn described(stored: StoredStudy) -> Result<StudyDocument, ProblemResponse> {
    let StoredStudy {
        sweep,
        plan,
        outcomes,
    } = stored;
    let runs = outcomes
        .into_iter()
        .filter_map(|outcome| run(outcome).transpose());
    let runs = runs.collect::<Result<Vec<Run>, _>>()?;
    // Nothing to compare yet is no failure.
    let study = accuracy::evaluate(&plan.spec, &plan.grid, &runs, plan.left_out).ok();
    let own = format!("/v1/studies/{}", sweep.id);
    let link = |name: &str, path: String| (name.to_owned(), path);
    Ok(StudyDocument {
        id: sweep.id,
        name: sweep.name,
        created_at: sweep.created_at,
        counts: sweep.counts,
        jobs: sweep.jobs.iter().map(job).collect(),
        study,
        links: [
            link("cancel", format!("{own}/cancel")),
            link("jobs", format!("/v1/jobs?sweep={}", sweep.id)),
            link("picture", format!("{own}/picture")),
            link("table", format!("{own}/table")),
            link("self", own),
        ]
        .into(),
    })
}

fn asked(job: &SweepJob) -> Option<Asked> {
    let accuracy = job.overrides.get("/accuracy")?;
    Asked::of(&serde_json::from_value(accuracy.clone()).ok()?)
}

fn job(job: &SweepJob) -> StudyJob {
    let (tolerance, settings) = match asked(job) {
        Some(Asked::Tolerance(tolerance)) => (Some(tolerance), None),
        Some(Asked::Fixed(settings)) => (None, Some(settings)),
        None => (None, None),
    };
    StudyJob {
        id: job.id,
        tolerance,
        contact_element_mm: settings.map(|settings| settings.contact_element_mm),
        increments_per_cycle: settings.map(|settings| settings.increments_per_cycle),
        cycle_jump: settings.map(|settings| settings.cycle_jump),
        status: job.status,
        outcome: job.outcome,
    }
}

/// A job that has ended, as a run of the study.
fn run((outcome, profile): (SweepOutcome, Option<String>)) -> Result<Option<Run>, StoreError> {
    let Some(asked) = asked(&outcome.job).filter(|_| outcome.job.status.is_terminal()) else {
        return Ok(None);
    };
    let profile = profile.as_deref().map(serde_json::from_str).transpose();
    let profile = profile.map_err(|cause| StoreError::Corrupt {
        id: outcome.job.id,
        what: "profile",
        cause: cause.to_string(),
    })?;
    let spent = outcome
        .summary
        .as_ref()
        .map_or_else(Spent::default, |summary| Spent {
            cpu_s: summary.cost.cpu_s,
            peak_memory_mb: summary.cost.peak_memory_mb,
        });
    let found = match (outcome.summary, profile) {
        (Some(summary), Some(profile)) => Ok(Found::new(summary, &profile)),
        _ => Err(outcome
            .status_reason
            .unwrap_or_else(|| outcome.job.status.as_str().to_owned())),
    };
    Ok(Some(Run {
        asked,
        spent,
        found,
    }))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{STUDY, Service};
    use crate::store::{NewSweep, StudyPlan, Submitted};

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
    async fn a_study_of_another_format_cannot_be_compared_any_more() {
        let service = Service::new().await;
        let store = &service.app.store;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let id = study["id"].as_str().expect("an id");
        let known = store.study(id.parse().expect("an id")).await;
        let known = known.expect("the store").expect("a study").plan;
        let other = NewSweep {
            name: None,
            jobs: Vec::new(),
            study: Some(StudyPlan {
                format: StudyPlan::FORMAT + 1,
                ..known
            }),
        };
        let submitted = store.submit_sweep(&other, None, 0).await;
        let Ok(Submitted::Job(id)) = submitted else {
            panic!("{submitted:?}");
        };
        let (status, _, problem) = service.get(&format!("/v1/studies/{id}")).await;
        assert_eq!(status, 410, "{problem}");
        assert_eq!(problem["title"], "the study cannot be compared any more");
    }

    #[tokio::test]
    async fn a_sweep_is_no_study() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", crate::http::tests::SWEEP).await;
        for id in [sweep["id"].as_str().expect("an id"), "1"] {
            let (status, _, problem) = service.get(&format!("/v1/studies/{id}")).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-study")), "{id}");
        }
    }
}
