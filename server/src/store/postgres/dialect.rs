//! PostgreSQL by the names that `store/sql/` uses: its types, the form of stored ids, and the fragments of SQL in which it differs.

use sqlx::pool::PoolConnection;
use sqlx::{Pool, Postgres, Transaction};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::StoreError;
pub(super) use crate::store::postgres::PostgresStore as EngineStore;
use crate::store::postgres::begin;
pub(super) use crate::store::postgres::verify::is_copy;

/// Engine, connection and row of sqlx.
pub(super) type Engine = Postgres;
pub(super) type Connection = sqlx::PgConnection;
pub(super) type Row = sqlx::postgres::PgRow;
/// An id has a type of its own.
pub(super) type StoredId = Uuid;

/// Returns an id as it is bound.
pub(super) const fn stored_id(id: Uuid) -> StoredId {
    id
}

/// Returns an id that was read.
pub(super) const fn read_id(stored: StoredId) -> Uuid {
    stored
}

/// Services on several machines have folders of their own.
pub(super) const HAS_SEVERAL_FOLDERS: bool = true;
/// No text has the character U+0000, and none can be compared with one that has.
pub(super) const STORES_NUL: bool = false;

/// Texts are compared byte by byte.
pub(super) const COLLATION: &str = " COLLATE \"C\"";
/// Functions of the largest and the smallest argument.
pub(super) const GREATEST: &str = "greatest";
pub(super) const LEAST: &str = "least";
/// The planner orders joins by itself.
pub(super) const JOIN_IN_ORDER: &str = "JOIN";
/// Locks the rows that are read; the second one leaves out those that others have locked.
pub(super) const FOR_UPDATE: &str = " FOR UPDATE";
pub(super) const SKIP_LOCKED: &str = " FOR UPDATE SKIP LOCKED";
/// The object of a row of `result_files`.
pub(super) const FILE_OBJECT: &str = "object";
/// Condition of a row of `result_blocks` whose results can be moved.
pub(super) const IS_MOVABLE: &str = "is_movable";

// The planner finds the indexes by itself.
pub(super) const BY_CLAIM: &str = "";
pub(super) const BY_DEADLINE: &str = "";
pub(super) const BY_SWEEP: &str = "";

/// Cycles after which the first criterion of life was reached.
pub(super) const LIFE_CYCLES: &str = "(SELECT min((criterion ->> 'cycles')::float8) FROM json_array_elements(summary::json -> 'life') AS criterion \
     WHERE criterion ->> 'status' = 'reached')";
/// Name of a job, in lower case.
pub(super) const NAME: &str = "lower((spec::json ->> 'name') COLLATE \"C\")";
/// Part of a job that is done.
pub(super) const PROGRESS: &str = "(progress::json ->> 'fraction')::float8";
/// Worn depth of the deeper side.
pub(super) const WEAR: &str = "GREATEST((summary::json #>> '{receptacle,max_depth_mm}')::float8, (summary::json #>> '{slider,max_depth_mm}')::float8)";
/// Condition that a text, which stands between these four parts, occurs in name, id or label. In the collation "C", `lower` knows ASCII
/// alone: other letters are compared as they are.
pub(super) const SEARCH: [&str; 4] = [
    " AND (strpos(lower(coalesce(spec::json ->> 'name', '') COLLATE \"C\"), ",
    ") > 0 OR strpos(id::text, ",
    ") > 0 OR id IN (SELECT job_id FROM labels WHERE strpos(lower(value COLLATE \"C\"), ",
    ") > 0))",
];

/// JSON text of a value of a document, whose digits are those that were stored.
pub(super) fn json(document: &str, path: &str) -> String {
    format!(
        "({document}::json #> '{{{}}}')::text",
        path.replace('.', ",")
    )
}

impl EngineStore {
    /// Begins a transaction, at a time.
    pub(super) async fn begin(&self) -> Result<(Transaction<'static, Engine>, Now), StoreError> {
        let mut transaction = begin(&self.writer, None).await?;
        let now = self.now(&mut transaction).await?;
        Ok((transaction, now))
    }

    /// A connection that reads, and the present time.
    pub(super) async fn read(&self) -> Result<(PoolConnection<Engine>, Now), StoreError> {
        let mut connection = self.readers.acquire().await?;
        let now = self.now(&mut connection).await?;
        Ok((connection, now))
    }

    /// Connections for reads of workers and submissions, which must not wait for those of users.
    pub(super) fn priority_readers(&self) -> &Pool<Engine> {
        &self.writer
    }

    /// Begins a transaction whose reads are as of one time.
    pub(super) async fn snapshot(&self) -> Result<Transaction<'static, Engine>, StoreError> {
        let statement = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
        begin(&self.readers, Some(statement)).await
    }

    /// Executes a small write. The disk is that of the server, where nothing is reserved.
    pub(super) async fn with_reserve<T, F: Future<Output = Result<T, StoreError>>>(
        &self,
        write: impl Fn() -> F,
    ) -> Result<T, StoreError> {
        write().await
    }

    pub(in crate::store) async fn present_ms(&self) -> Result<i64, StoreError> {
        Ok(self.read().await?.1.system_ms)
    }
}
