//! Stored rows to job documents.

use std::collections::BTreeMap;

use api::job::{Job, Outcome, Status};
use jiff::Timestamp;
use serde::de::DeserializeOwned;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::sqlite::queries::job_id;

/// A row of `jobs`.
#[derive(Debug, sqlx::FromRow)]
pub(in crate::store) struct JobRow {
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
    pub(in crate::store) last_event: i64,
    pub(in crate::store) version: i64,
}

impl JobRow {
    /// The document.
    pub(in crate::store) fn document(&self) -> Result<Job, StoreError> {
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
            attempts: u32::try_from(self.attempts).unwrap_or(u32::MAX),
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

/// Parses a stored document.
pub(in crate::store) fn parsed<T: DeserializeOwned>(
    id: Uuid,
    what: &'static str,
    text: &str,
) -> Result<T, StoreError> {
    serde_json::from_str(text).map_err(|cause| corrupt(id, what, &cause))
}

fn corrupt(id: Uuid, what: &'static str, cause: &impl ToString) -> StoreError {
    StoreError::Corrupt {
        id,
        what,
        cause: cause.to_string(),
    }
}

/// Milliseconds since 1970 as RFC 3339.
pub(in crate::store) fn timestamp(milliseconds: i64) -> String {
    Timestamp::from_millisecond(milliseconds)
        .map_or_else(|_| milliseconds.to_string(), |time| time.to_string())
}
