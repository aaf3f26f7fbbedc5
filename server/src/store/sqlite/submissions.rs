//! Group commit of submissions. A commit waits some milliseconds for the disk; submissions that arrive meanwhile are
//! written together by the next commit, and each is answered only after its own.

use std::sync::{Mutex, MutexGuard, PoisonError};

use sqlx::sqlite::SqlitePool;
use sqlx::{Sqlite, Transaction};
use tokio::sync::oneshot;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::store::sqlite::job_rows::insert;
use crate::store::sqlite::queries::BEGIN;
use crate::store::{NewJob, RequestKey, StoreError, Submitted};

/// Largest number of submissions in a commit; bounds how long other writes wait.
const GROUP_LIMIT: usize = 64;

/// Submissions to be written.
#[derive(Debug, Default)]
pub(super) struct Submissions {
    pending: Mutex<Vec<Pending>>,
    commit: tokio::sync::Mutex<()>,
}

#[derive(Debug)]
struct Pending {
    job: NewJob,
    key: Option<RequestKey>,
    now: Now,
    answer: oneshot::Sender<Result<Submitted, StoreError>>,
}

impl Submissions {
    /// Queues a job, together with others that are submitted at the same time.
    pub(super) async fn submit(
        &self,
        writer: &SqlitePool,
        job: &NewJob,
        key: Option<&RequestKey>,
        now: Now,
    ) -> Result<Submitted, StoreError> {
        let (answer, mut answered) = oneshot::channel();
        self.pending().push(Pending {
            job: job.clone(),
            key: key.cloned(),
            now,
            answer,
        });
        loop {
            let commit = self.commit.lock().await;
            match answered.try_recv() {
                Ok(answer) => return answer,
                Err(oneshot::error::TryRecvError::Closed) => return Err(StoreError::Unwritten),
                Err(oneshot::error::TryRecvError::Empty) => {}
            }
            let group = self.take();
            // In a task of its own: a client that disconnects must not cancel the submissions of others.
            let writing = tokio::spawn(write(writer.clone(), group));
            writing.await.map_err(|_| StoreError::Unwritten)?;
            drop(commit);
        }
    }

    fn pending(&self) -> MutexGuard<'_, Vec<Pending>> {
        let pending = self.pending.lock();
        pending.unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> Vec<Pending> {
        let mut pending = self.pending();
        // A client that has disconnected got no answer, so its job must not be queued later.
        pending.retain(|submission| !submission.answer.is_closed());
        let count = pending.len().min(GROUP_LIMIT);
        pending.drain(..count).collect()
    }
}

/// Writes submissions in one transaction, or each in its own if that fails, so that one that cannot be written does not
/// fail the others.
async fn write(writer: SqlitePool, group: Vec<Pending>) {
    if let Ok(submitted) = write_group(&writer, &group).await {
        for (pending, submitted) in group.into_iter().zip(submitted) {
            // The client may have disconnected: the job is queued all the same.
            let _ = pending.answer.send(Ok(submitted));
        }
        return;
    }
    for pending in group {
        let alone = write_group(&writer, std::slice::from_ref(&pending)).await;
        let submitted = alone.and_then(|mut one| one.pop().ok_or(StoreError::Unwritten));
        let _ = pending.answer.send(submitted);
    }
}

async fn write_group(writer: &SqlitePool, group: &[Pending]) -> Result<Vec<Submitted>, StoreError> {
    let mut transaction = writer.begin_with(BEGIN).await?;
    let mut submitted = Vec::with_capacity(group.len());
    for pending in group {
        submitted.push(write_one(&mut transaction, pending).await?);
    }
    transaction.commit().await?;
    Ok(submitted)
}

async fn write_one(
    transaction: &mut Transaction<'_, Sqlite>,
    pending: &Pending,
) -> Result<Submitted, StoreError> {
    if let Some(key) = &pending.key {
        let known: Option<(Vec<u8>, Hyphenated)> =
            sqlx::query_as("SELECT body_sha256, job_id FROM request_keys WHERE key = ?")
                .bind(&key.key)
                .fetch_optional(&mut **transaction)
                .await?;
        if let Some((body, job)) = known {
            return Ok(key.repeated(&body, job.into()));
        }
    }
    let id = insert(transaction, &pending.job, pending.now).await?;
    if let Some(key) = &pending.key {
        sqlx::query("INSERT INTO request_keys (key, body_sha256, job_id) VALUES (?, ?, ?)")
            .bind(&key.key)
            .bind(key.meaning_sha256.as_slice())
            .bind(id.to_string())
            .execute(&mut **transaction)
            .await?;
    }
    Ok(Submitted::Job(id))
}
