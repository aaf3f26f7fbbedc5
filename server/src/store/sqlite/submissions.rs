//! Submissions, several in a commit.

use sqlx::sqlite::SqlitePool;
use sqlx::{Sqlite, Transaction};
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::groups::{Groups, Pending};
use crate::store::sqlite::insertion::insert;
use crate::store::sqlite::queries::BEGIN;
use crate::store::{NewJob, RequestKey, StoreError, Submitted};

/// Submissions to be written.
pub(super) type Submissions = Groups<Submission, Result<Submitted, StoreError>>;

type Waiting = Pending<Submission, Result<Submitted, StoreError>>;

/// A job to be queued.
#[derive(Debug)]
pub(super) struct Submission {
    pub(super) job: NewJob,
    pub(super) key: Option<RequestKey>,
    pub(super) now: Now,
}

/// Writes submissions in one transaction, or each in its own if that fails, so that one that cannot be written does not
/// fail the others.
pub(super) async fn write(writer: SqlitePool, group: Vec<Waiting>) {
    let all = group.iter().map(|pending| &pending.request);
    if let Ok(submitted) = write_group(&writer, all).await {
        for (pending, submitted) in group.into_iter().zip(submitted) {
            pending.answer(Ok(submitted));
        }
        return;
    }
    for pending in group {
        let alone = write_group(&writer, std::iter::once(&pending.request)).await;
        let submitted = alone.and_then(|mut one| one.pop().ok_or(StoreError::Unwritten));
        pending.answer(submitted);
    }
}

async fn write_group(
    writer: &SqlitePool,
    group: impl Iterator<Item = &Submission>,
) -> Result<Vec<Submitted>, StoreError> {
    let mut transaction = writer.begin_with(BEGIN).await?;
    let mut submitted = Vec::new();
    for submission in group {
        submitted.push(write_one(&mut transaction, submission).await?);
    }
    transaction.commit().await?;
    Ok(submitted)
}

async fn write_one(
    transaction: &mut Transaction<'_, Sqlite>,
    submission: &Submission,
) -> Result<Submitted, StoreError> {
    if let Some(key) = &submission.key {
        let known: Option<(Vec<u8>, Hyphenated)> =
            sqlx::query_as("SELECT body_sha256, job_id FROM request_keys WHERE key = ?")
                .bind(&key.key)
                .fetch_optional(&mut **transaction)
                .await?;
        if let Some((body, job)) = known {
            return Ok(key.repeated(&body, job.into()));
        }
    }
    let id = insert(transaction, &submission.job, None, submission.now).await?;
    if let Some(key) = &submission.key {
        sqlx::query("INSERT INTO request_keys (key, body_sha256, job_id) VALUES (?, ?, ?)")
            .bind(&key.key)
            .bind(key.meaning_sha256.as_slice())
            .bind(id.to_string())
            .execute(&mut **transaction)
            .await?;
    }
    Ok(Submitted::Job(id))
}
