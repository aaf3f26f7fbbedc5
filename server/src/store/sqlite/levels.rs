//! Gauges for `/metrics`, and whether the database can be written.

use std::time::{Duration, Instant};

use api::job::Status;

use crate::metrics::Gauges;
use crate::store::{Store, StoreError};

/// How long a write proves that the database can be written.
const PROOF: Duration = Duration::from_secs(1);

impl Store {
    /// Jobs by status, checkpoint age and the size of the write-ahead log.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn levels(&self, now: i64) -> Result<Gauges, StoreError> {
        let found: Vec<(String, i64, i64)> =
            sqlx::query_as("SELECT status, count(*), min(created_at) FROM jobs GROUP BY status")
                .fetch_all(&self.readers)
                .await?;
        let jobs = Status::ALL
            .into_iter()
            .map(|status| {
                let row = found.iter().find(|(name, ..)| name == status.as_str());
                row.map_or((status, 0, 0), |(_, count, oldest)| {
                    (status, *count, seconds(now, *oldest))
                })
            })
            .collect();
        let oldest: Option<i64> = sqlx::query_scalar(
            "SELECT min(written_at) FROM checkpoints JOIN jobs ON id = job_id WHERE status = 'running'",
        )
        .fetch_one(&self.readers)
        .await?;
        let wal = tokio::fs::metadata(&self.wal).await;
        Ok(Gauges {
            jobs,
            oldest_checkpoint_s: oldest.map_or(0, |written| seconds(now, written)),
            // There is none before the first write.
            wal_bytes: wal.map_or(0, |file| i64::try_from(file.len()).unwrap_or(i64::MAX)),
        })
    }

    /// Writes to the database for the sake of it, unless that has succeeded just now: everyone may ask, and those who ask
    /// often must not keep workers from writing.
    ///
    /// # Errors
    /// [`StoreError`] if it cannot be written.
    pub async fn ready(&self, now: i64) -> Result<(), StoreError> {
        let mut proved = self.proved_ready.lock().await;
        if proved.is_some_and(|at| at.elapsed() < PROOF) {
            return Ok(());
        }
        sqlx::query("INSERT OR REPLACE INTO probes (name, written_at) VALUES ('ready', ?)")
            .bind(now)
            .execute(&self.writer)
            .await?;
        *proved = Some(Instant::now());
        Ok(())
    }
}

fn seconds(now: i64, since: i64) -> i64 {
    now.saturating_sub(since).max(0) / 1_000
}
