//! Rows of the wear history and of snapshots, readable while the job is running.

use api::results::Snapshot;
use futures_util::{StreamExt, TryStreamExt};
use solver::record::CycleReport;
use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{Connection, EngineStore, stored_id};
use crate::store::rows::{integer, parsed, snapshot};
use crate::store::{SnapshotPart, StoreError};

impl EngineStore {
    pub(in crate::store) async fn history_rows(
        &self,
        id: Uuid,
    ) -> Result<Vec<CycleReport>, StoreError> {
        // As a stream: the texts of a long history together are several times as large as its rows.
        let text = sqlx::query_scalar::<_, String>(
            "SELECT data FROM history_rows WHERE job_id = $1 ORDER BY cycle",
        );
        let texts = text.bind(stored_id(id)).fetch(&self.readers);
        let rows = texts.map(|text| parsed(id, "history row", &text?));
        rows.try_collect().await
    }

    pub(in crate::store) async fn snapshot_row(
        &self,
        id: Uuid,
        part: SnapshotPart,
        cycle: Option<u64>,
    ) -> Result<Option<String>, StoreError> {
        let column = part.column();
        let sql = format!(
            "SELECT {column} FROM snapshots WHERE job_id = $1 ORDER BY abs(cycle - $2), cycle LIMIT 1"
        );
        let found = sqlx::query_scalar(AssertSqlSafe(sql))
            .bind(stored_id(id))
            .bind(cycle.map_or(i64::MAX, integer))
            .fetch_optional(&self.readers)
            .await?;
        Ok(found)
    }

    pub(in crate::store) async fn snapshot_rows(
        &self,
        id: Uuid,
    ) -> Result<Vec<Snapshot>, StoreError> {
        let rows: Vec<(String, String, String)> = sqlx::query_as(
            "SELECT profile, pressure, friction_loop FROM snapshots WHERE job_id = $1 ORDER BY cycle",
        )
        .bind(stored_id(id))
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(|texts| snapshot(id, texts)).collect()
    }
}

/// Adds snapshots, which replace those of the same cycles.
pub(in super::super) async fn insert_snapshots(
    connection: &mut Connection,
    id: Uuid,
    snapshots: &[Snapshot],
) -> Result<(), StoreError> {
    for snapshot in snapshots {
        sqlx::query(
            "INSERT INTO snapshots (job_id, cycle, profile, pressure, friction_loop) VALUES ($1, $2, $3, $4, $5) \
             ON CONFLICT (job_id, cycle) DO UPDATE SET profile = excluded.profile, pressure = excluded.pressure, \
             friction_loop = excluded.friction_loop",
        )
        .bind(stored_id(id))
        .bind(integer(snapshot.profile.cycle))
        .bind(serde_json::to_string(&snapshot.profile)?)
        .bind(serde_json::to_string(&snapshot.pressure)?)
        .bind(serde_json::to_string(&snapshot.friction_loop)?)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}
