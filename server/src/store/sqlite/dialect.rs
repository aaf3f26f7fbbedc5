//! SQLite by the names that `store/sql/` uses: its types, the form of stored ids, and the fragments of SQL in which it differs.

use sqlx::pool::PoolConnection;
use sqlx::{Pool, Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::store::StoreError;
pub(super) use crate::store::sqlite::SqliteStore as EngineStore;
use crate::store::sqlite::queries::BEGIN;

/// Engine, connection and row of sqlx.
pub(super) type Engine = Sqlite;
pub(super) type Connection = sqlx::SqliteConnection;
pub(super) type Row = sqlx::sqlite::SqliteRow;
/// An id is stored as text with hyphens.
pub(super) type StoredId = Hyphenated;

/// Returns an id as it is bound.
pub(super) const fn stored_id(id: Uuid) -> StoredId {
    id.hyphenated()
}

/// Returns an id that was read.
pub(super) const fn read_id(stored: StoredId) -> Uuid {
    stored.into_uuid()
}

/// Every service of a file has the folder beside it.
pub(super) const HAS_SEVERAL_FOLDERS: bool = false;
/// Texts may have the character U+0000.
pub(super) const STORES_NUL: bool = true;

/// Texts are compared byte by byte.
pub(super) const COLLATION: &str = "";
/// Functions of the largest and the smallest argument.
pub(super) const GREATEST: &str = "max";
pub(super) const LEAST: &str = "min";
/// Joins so that the left table is read first.
pub(super) const JOIN_IN_ORDER: &str = "CROSS JOIN";
/// A transaction that writes excludes all others: no rows are locked.
pub(super) const FOR_UPDATE: &str = "";
pub(super) const SKIP_LOCKED: &str = "";
/// The object of a row of `result_files`: files are in the folder.
pub(super) const FILE_OBJECT: &str = "NULL";
/// Condition of a row of `result_blocks` whose results can be moved, as in their index.
pub(super) const IS_MOVABLE: &str = "is_movable = 1";

// Named, because the planner may take others.
pub(super) const BY_CLAIM: &str = " INDEXED BY jobs_by_claim";
pub(super) const BY_DEADLINE: &str = " INDEXED BY jobs_by_deadline";
pub(super) const BY_SWEEP: &str = " INDEXED BY jobs_by_sweep";

/// Cycles after which the first criterion of life was reached.
pub(super) const LIFE_CYCLES: &str = "(SELECT min(value ->> '$.cycles') FROM json_each(summary, '$.life') WHERE value ->> '$.status' = 'reached')";
/// Name of a job, in lower case.
pub(super) const NAME: &str = "lower(spec ->> '$.name')";
/// Part of a job that is done.
pub(super) const PROGRESS: &str = "progress ->> '$.fraction'";
/// Worn depth of the deeper side.
pub(super) const WEAR: &str =
    "max(summary ->> '$.receptacle.max_depth_mm', summary ->> '$.slider.max_depth_mm')";
/// Condition that a text, which stands between these four parts, occurs in name, id or label. `lower` knows ASCII alone: other letters
/// are compared as they are. The index has name and id of all jobs; their rows are many times as long.
pub(super) const SEARCH: [&str; 4] = [
    " AND id IN (SELECT id FROM jobs INDEXED BY jobs_by_name WHERE instr(lower(spec ->> '$.name'), ",
    ") OR instr(id, ",
    ") UNION ALL SELECT job_id FROM labels WHERE instr(lower(value), ",
    "))",
];

/// JSON text of a value of a document, whose digits are those that were stored.
pub(super) fn json(document: &str, path: &str) -> String {
    format!("{document} -> '$.{path}'")
}

/// Returns `true` if the objects of a database are those of its original.
pub(super) async fn is_copy(connection: &mut Connection) -> Result<bool, StoreError> {
    let copy = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM object_store WHERE NOT removes)");
    Ok(copy.fetch_one(connection).await?)
}

impl EngineStore {
    /// Begins a transaction that writes, at a time.
    pub(super) async fn begin(&self) -> Result<(Transaction<'static, Engine>, Now), StoreError> {
        let transaction = self.writer.begin_with(BEGIN).await?;
        Ok((transaction, self.process.clock.now()))
    }

    /// A connection that reads, and the present time.
    pub(super) async fn read(&self) -> Result<(PoolConnection<Engine>, Now), StoreError> {
        Ok((self.readers.acquire().await?, self.process.clock.now()))
    }

    /// Connections for reads of workers: those of users, because reads of a file wait for no writes.
    pub(super) fn priority_readers(&self) -> &Pool<Engine> {
        &self.readers
    }

    /// Begins a transaction whose reads are as of one time.
    pub(super) async fn snapshot(&self) -> Result<Transaction<'static, Engine>, StoreError> {
        Ok(self.readers.begin().await?)
    }

    /// Executes a small write that must not fail because the disk is full.
    pub(super) async fn with_reserve<T, F: Future<Output = Result<T, StoreError>>>(
        &self,
        write: impl Fn() -> F,
    ) -> Result<T, StoreError> {
        self.process.disk.with_reserve(write).await
    }

    #[expect(
        clippy::unused_async,
        reason = "other engines ask their database for the time"
    )]
    pub(in crate::store) async fn present_ms(&self) -> Result<i64, StoreError> {
        Ok(self.process.clock.now().system_ms)
    }
}
