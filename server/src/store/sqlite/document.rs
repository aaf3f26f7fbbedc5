//! Rows of `jobs` as job documents.

use std::collections::BTreeMap;

use api::job::{Job, Outcome, Status};
use jiff::Timestamp;
use sqlx::{QueryBuilder, Sqlite};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::sqlite::queries::{attempt_count, corrupt, job_id, parsed};

/// A row of `jobs`.
#[derive(Debug, sqlx::FromRow)]
pub(super) struct JobRow {
    id: String,
    spec: String,
    plan: String,
    status: String,
    status_reason: Option<String>,
    outcome: Option<String>,
    priority: i32,
    deadline_at: Option<i64>,
    created_at: i64,
    started_at: Option<i64>,
    finished_at: Option<i64>,
    progress: String,
    summary: Option<String>,
    attempts: i64,
    pub(super) last_event: i64,
    pub(super) version: i64,
}

impl JobRow {
    /// Starts a query of rows.
    pub(super) fn select() -> QueryBuilder<Sqlite> {
        QueryBuilder::new(
            "SELECT id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
             priority, deadline_at, progress, summary, attempts, last_event, version FROM jobs",
        )
    }

    /// Returns the document.
    pub(super) fn document(&self) -> Result<Job, StoreError> {
        let id = job_id(&self.id)?;
        let status =
            Status::from_name(&self.status).ok_or_else(|| corrupt(id, "status", &self.status))?;
        Ok(Job {
            id,
            status,
            status_reason: self.status_reason.clone(),
            outcome: self.outcome.as_deref().and_then(Outcome::from_name),
            priority: self.priority,
            deadline_at: self.deadline_at.map(timestamp),
            created_at: timestamp(self.created_at),
            started_at: self.started_at.map(timestamp),
            finished_at: self.finished_at.map(timestamp),
            progress: parsed(id, "progress", &self.progress)?,
            attempts: attempt_count(self.attempts),
            spec: parsed(id, "specification", &self.spec)?,
            plan: Some(parsed(id, "plan", &self.plan)?),
            summary: self
                .summary
                .as_deref()
                .map(|text| parsed(id, "summary", text))
                .transpose()?,
            links: links(id),
        })
    }
}

fn links(id: Uuid) -> BTreeMap<String, String> {
    let own = format!("/v1/jobs/{id}");
    let relations = [
        ("events", "/events"),
        ("cancel", "/cancel"),
        ("results", "/results"),
        ("wear_history", "/results/wear-history"),
        ("profile", "/results/profile"),
        ("pressure", "/results/pressure"),
        ("loop", "/results/loop"),
    ];
    let mut links: BTreeMap<_, _> = relations
        .into_iter()
        .map(|(relation, path)| (relation.to_owned(), format!("{own}{path}")))
        .collect();
    links.insert("self".to_owned(), own);
    links
}

/// Formats milliseconds since 1970 as RFC 3339.
pub(super) fn timestamp(milliseconds: i64) -> String {
    Timestamp::from_millisecond(milliseconds)
        .map_or_else(|_| milliseconds.to_string(), |time| time.to_string())
}
