//! Gauges for `/metrics`.

use api::service::Demand;

use crate::metrics::Gauges;
use crate::store::StoreError;
use crate::store::gauges::{StatusRow, UNKNOWN_CPU_MS, by_status, progress_age_s, seconds};
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::workers::present_from;

impl SqliteStore {
    pub(in crate::store) async fn demand(&self) -> Result<Demand, StoreError> {
        let (queued, running, running_remotely, queued_cpu_s) = sqlx::query_as(
            "WITH to_come AS (SELECT COALESCE(sum(jobs - next), 0) AS jobs, COALESCE(sum((jobs - next) * cpu_ms), 0) AS cpu_ms \
             FROM expansions WHERE NOT is_over) \
             SELECT (SELECT count(*) FROM jobs INDEXED BY jobs_waiting WHERE status = 'queued') + to_come.jobs, \
             (SELECT count(*) FROM jobs INDEXED BY jobs_running WHERE status = 'running'), \
             (SELECT count(*) FROM jobs INDEXED BY jobs_running WHERE status = 'running' AND is_remote), \
             ((SELECT COALESCE(sum(iif(cpu_ms > 0, cpu_ms, ?)), 0) FROM jobs INDEXED BY jobs_waiting \
             WHERE status = 'queued') + to_come.cpu_ms + 999) / 1000 FROM to_come",
        )
        .bind(UNKNOWN_CPU_MS)
        .fetch_one(&self.readers)
        .await?;
        Ok(Demand {
            queued,
            running,
            running_remotely,
            queued_cpu_s,
        })
    }

    pub(in crate::store) async fn gauges(&self) -> Result<Gauges, StoreError> {
        let now = self.process.clock.now().system_ms;
        let rows: Vec<StatusRow> = sqlx::query_as(
            "SELECT status, jobs, (SELECT min(created_at) FROM jobs WHERE jobs.status = job_counts.status) FROM job_counts",
        )
        .fetch_all(&self.readers)
        .await?;
        let oldest: Option<i64> = sqlx::query_scalar(
            "SELECT min(written_at) FROM checkpoints JOIN jobs ON id = job_id WHERE status = 'running'",
        )
        .fetch_one(&self.readers)
        .await?;
        // Times in one format, whose order is that of their texts to the second.
        let progress: Option<String> = sqlx::query_scalar(
            "SELECT min(progress ->> '$.updated_at') FROM jobs WHERE status = 'running'",
        )
        .fetch_one(&self.readers)
        .await?;
        let (wal, database) = (
            tokio::fs::metadata(&self.wal).await,
            tokio::fs::metadata(&self.path).await,
        );
        let results_to_move: i64 = sqlx::query_scalar(
            "SELECT count(*) FROM result_blocks WHERE is_movable = 1 AND object IS NULL AND ?",
        )
        .bind(self.process.objects.is_some())
        .fetch_one(&self.readers)
        .await?;
        let (remote_slots, workers_failing) = sqlx::query_as(
            "SELECT COALESCE(sum(slots) FILTER (WHERE NOT is_draining), 0), count(failing) FROM workers WHERE last_contact_at >= ?",
        )
        .bind(present_from(self.process.clock.now().monotonic_ms))
        .fetch_one(&self.readers)
        .await?;
        Ok(Gauges {
            jobs: by_status(&rows, now),
            results_to_move,
            oldest_checkpoint_s: oldest.map_or(0, |written| seconds(now, written)),
            // The file does not exist before the first write.
            wal_bytes: wal.map_or(0, |file| integer(file.len())),
            oldest_progress_s: progress_age_s(progress, now),
            database_bytes: database.map_or(0, |file| integer(file.len())),
            disk_free_bytes: self
                .process
                .disk
                .usable_mb()
                .map_or(0, |mb| integer(mb << 20)),
            workers_alive: 0,
            remote_slots,
            workers_failing,
            demand_cpu_s: 0,
        })
    }
}
