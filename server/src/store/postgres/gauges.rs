//! Gauges for `/metrics`.

use crate::clock::Now;
use crate::metrics::Gauges;
use crate::store::StoreError;
use crate::store::gauges::{StatusRow, by_status, progress_age_s, seconds};
use crate::store::postgres::PostgresStore;
use crate::store::rows::integer;
use crate::store::workers::present_from;

impl PostgresStore {
    pub(in crate::store) async fn gauges(&self) -> Result<Gauges, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let Now {
            system_ms: now,
            monotonic_ms,
        } = self.now(&mut connection).await?;
        // An index has both.
        let rows: Vec<StatusRow> =
            sqlx::query_as("SELECT status, count(*), min(created_at) FROM jobs GROUP BY status")
                .fetch_all(&mut *connection)
                .await?;
        let (checkpoint, progress, database_bytes, results_to_move, remote_slots, workers_failing): (
            Option<i64>,
            Option<String>,
            i64,
            i64,
            i64,
            i64,
        ) = sqlx::query_as(
            "SELECT (SELECT min(written_at) FROM checkpoints JOIN jobs ON id = job_id WHERE status = 'running'), \
             (SELECT min(progress::json ->> 'updated_at') FROM jobs WHERE status = 'running'), \
             pg_database_size(current_database()), \
             (SELECT count(*) FROM result_blocks WHERE is_movable AND object IS NULL AND $1), \
             (SELECT COALESCE(sum(slots), 0)::bigint FROM workers WHERE last_contact_at >= $2 AND NOT is_draining), \
             (SELECT count(failing) FROM workers WHERE last_contact_at >= $2)",
        )
        .bind(self.process.objects.is_some())
        .bind(present_from(monotonic_ms))
        .fetch_one(&mut *connection)
        .await?;
        Ok(Gauges {
            jobs: by_status(&rows, now),
            results_to_move,
            oldest_checkpoint_s: checkpoint.map_or(0, |written| seconds(now, written)),
            // The server has its own metrics.
            wal_bytes: 0,
            oldest_progress_s: progress_age_s(progress, now),
            database_bytes,
            disk_free_bytes: self
                .process
                .disk
                .free_mb()
                .map_or(0, |mb| integer(mb << 20)),
            workers_alive: 0,
            remote_slots,
            workers_failing,
            demand_cpu_s: 0,
        })
    }
}
