//! The row of a job that is queued.

use api::job::Progress;
use api::plan::Plan;
use api::spec::SystemKind;
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::store::rows::timestamp;
use crate::store::{NewJob, StoreError};

/// Columns of a new job that are derived from its submission.
pub(in crate::store) struct NewRow {
    pub(in crate::store) id: Uuid,
    pub(in crate::store) system: &'static str,
    /// Resolved specification, JSON as the plan and the progress.
    pub(in crate::store) spec: String,
    pub(in crate::store) plan: String,
    pub(in crate::store) progress: String,
    pub(in crate::store) place: i64,
    pub(in crate::store) deadline_at: Option<i64>,
    pub(in crate::store) memory_mb: i64,
    pub(in crate::store) cpu_ms: i64,
}

impl NewRow {
    /// Row of a job that is queued now, under an id.
    pub(in crate::store) fn of(job: &NewJob, id: Uuid, now: Now) -> Result<Self, StoreError> {
        let Now {
            system_ms,
            monotonic_ms,
        } = now;
        let options = job.options;
        let progress = Progress {
            cycles: crate::spec::cycles(&job.spec),
            updated_at: Some(timestamp(system_ms)),
            ..Progress::default()
        };
        let deadline_ms = options.deadline_s.map(|s| 1_000 * i64::from(s));
        Ok(Self {
            id,
            system: job.spec.system.kind.known().map_or("", SystemKind::as_str),
            spec: serde_json::to_string(&job.spec)?,
            plan: serde_json::to_string(&job.plan)?,
            progress: serde_json::to_string(&progress)?,
            place: queue::sort_key(monotonic_ms, options.priority),
            deadline_at: deadline_ms.map(|ms| monotonic_ms.saturating_add(ms)),
            memory_mb: planned(&job.plan, "memory_mb", 1.0),
            cpu_ms: planned(&job.plan, "cpu_s", 1e3),
        })
    }
}

/// Returns an estimate of the plan, rounded up; 0 where it is not known.
fn planned(plan: &Plan, name: &str, per_unit: f64) -> i64 {
    estimated(
        plan.estimates.get(name).copied().unwrap_or_default(),
        per_unit,
    )
}

/// Returns an estimate in a smaller unit, rounded up.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the value is clamped to a range that fits"
)]
pub(in crate::store) fn estimated(estimate: f64, per_unit: f64) -> i64 {
    (per_unit * estimate).ceil().clamp(0.0, 1e12) as i64
}
