//! Submitting jobs. A commit waits for the disk, some milliseconds; so submissions that arrive while one is on its way
//! are written together by the next one, and each is answered only when it is on the disk.

use std::sync::{Mutex, PoisonError};

use sqlx::sqlite::SqlitePool;
use sqlx::{Sqlite, Transaction};
use tokio::sync::oneshot;
use uuid::Uuid;

use crate::store::sqlite::jobs::{NewJob, RequestKey, Submitted, insert};
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::{Store, StoreError};

/// Submissions written together at most; bounds how long other writes wait.
const TOGETHER: usize = 64;

/// Submissions that wait to be written.
#[derive(Debug, Default)]
pub(in crate::store) struct Submissions {
    waiting: Mutex<Vec<Pending>>,
    turn: tokio::sync::Mutex<()>,
}

#[derive(Debug)]
struct Pending {
    job: NewJob,
    key: Option<RequestKey>,
    now: i64,
    answer: oneshot::Sender<Result<Submitted, StoreError>>,
}

impl Submissions {
    fn push(&self, pending: Pending) {
        let waiting = self.waiting.lock();
        waiting
            .unwrap_or_else(PoisonError::into_inner)
            .push(pending);
    }

    fn take(&self) -> Vec<Pending> {
        let waiting = self.waiting.lock();
        let mut waiting = waiting.unwrap_or_else(PoisonError::into_inner);
        // Whoever has gone was promised nothing, and must not find a job later.
        waiting.retain(|pending| !pending.answer.is_closed());
        let count = waiting.len().min(TOGETHER);
        waiting.drain(..count).collect()
    }
}

impl Store {
    /// Queues a job, unless a request with the same key has done so already. `now` in milliseconds since 1970.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit_once(
        &self,
        job: &NewJob,
        key: &RequestKey,
        now: i64,
    ) -> Result<Submitted, StoreError> {
        self.submit_any(job, Some(key), now).await
    }

    /// Queues a job. `now` in milliseconds since 1970.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit(&self, job: &NewJob, now: i64) -> Result<Uuid, StoreError> {
        match self.submit_any(job, None, now).await? {
            Submitted::Job(id) => Ok(id),
            Submitted::KeyTaken => Err(StoreError::Unwritten),
        }
    }

    async fn submit_any(
        &self,
        job: &NewJob,
        key: Option<&RequestKey>,
        now: i64,
    ) -> Result<Submitted, StoreError> {
        let (answer, mut told) = oneshot::channel();
        self.submissions.push(Pending {
            job: job.clone(),
            key: key.cloned(),
            now,
            answer,
        });
        let submitted = loop {
            let turn = self.submissions.turn.lock().await;
            match told.try_recv() {
                Ok(answer) => break answer?,
                Err(oneshot::error::TryRecvError::Closed) => return Err(StoreError::Unwritten),
                Err(oneshot::error::TryRecvError::Empty) => {}
            }
            let together = self.submissions.take();
            // In a task of its own: a client that goes away must not take the others' submissions with it.
            let writing = tokio::spawn(write(self.writer.clone(), together));
            writing.await.map_err(|_| StoreError::Unwritten)?;
            drop(turn);
        };
        if let Submitted::Job(id) = submitted {
            self.changed(id);
            self.waiting.notify_one();
        }
        Ok(submitted)
    }
}

/// Writes submissions together, or one by one if that fails, so that one that cannot be written harms no other.
async fn write(writer: SqlitePool, together: Vec<Pending>) {
    if let Ok(submitted) = written(&writer, &together).await {
        for (pending, submitted) in together.into_iter().zip(submitted) {
            // Nobody waits for it any more: the job is queued all the same.
            let _ = pending.answer.send(Ok(submitted));
        }
        return;
    }
    for pending in together {
        let alone = written(&writer, std::slice::from_ref(&pending)).await;
        let submitted = alone.and_then(|mut one| one.pop().ok_or(StoreError::Unwritten));
        let _ = pending.answer.send(submitted);
    }
}

async fn written(writer: &SqlitePool, together: &[Pending]) -> Result<Vec<Submitted>, StoreError> {
    let mut transaction = writer.begin_with(BEGIN).await?;
    let mut submitted = Vec::with_capacity(together.len());
    for pending in together {
        submitted.push(one(&mut transaction, pending).await?);
    }
    transaction.commit().await?;
    Ok(submitted)
}

async fn one(
    transaction: &mut Transaction<'_, Sqlite>,
    pending: &Pending,
) -> Result<Submitted, StoreError> {
    let Some(key) = &pending.key else {
        return Ok(Submitted::Job(
            insert(transaction, &pending.job, pending.now).await?,
        ));
    };
    let known: Option<(Vec<u8>, String)> =
        sqlx::query_as("SELECT body_sha256, job_id FROM request_keys WHERE key = ?")
            .bind(&key.key)
            .fetch_optional(&mut **transaction)
            .await?;
    if let Some((body, job)) = known {
        return Ok(if body == key.body_sha256 {
            Submitted::Job(job_id(&job)?)
        } else {
            Submitted::KeyTaken
        });
    }
    let id = insert(transaction, &pending.job, pending.now).await?;
    sqlx::query("INSERT INTO request_keys (key, body_sha256, job_id) VALUES (?, ?, ?)")
        .bind(&key.key)
        .bind(key.body_sha256.as_slice())
        .bind(id.to_string())
        .execute(&mut **transaction)
        .await?;
    Ok(Submitted::Job(id))
}
