//! The store in a PostgreSQL database, which several processes serve.
//!
//! Rows are locked by what changes them, and transactions that change several jobs lock them in the order of their ids or leave out
//! those that others have locked. Times are those of the database's clock. No process takes the jobs or files of another one: leases
//! end by themselves.

mod batch_portions;
mod blocks;
mod checkpoint_objects;
mod claimed;
pub(in crate::store) mod claims;
mod compared;
mod demand;
mod dialect;
mod durability;
mod expansions;
mod gauges;
mod insertion;
mod leases;
mod migrations;
mod new_files;
mod notifications;
mod object_names;
mod objects;
mod open;
mod queries;
mod reclaim;
mod results_to_move;
mod revisions;
mod submissions;
mod transitions;
mod updates;
mod upkeep;
pub(in crate::store) mod verify;
mod write;
mod writer;
mod writes;

#[path = "sql/statements.rs"]
mod sql;

use std::time::{Duration, Instant};

use api::service::Demand;
use sqlx::postgres::{PgConnection, PgPool};
use sqlx::{Postgres, Transaction};
use tokio::time::timeout;
use tokio_util::task::AbortOnDropHandle;

use crate::clock::{Clock, Now};
use crate::groups::Groups;
use crate::store::postgres::claimed::Claimed;
use crate::store::postgres::compared::Compared;
use crate::store::postgres::write::Writes;
use crate::store::process_state::ProcessState;
use crate::store::{ClaimRequest, StoreError};

/// A store in a PostgreSQL database.
#[derive(Debug)]
pub(in crate::store) struct PostgresStore {
    pub(in crate::store) process: ProcessState,
    /// For claims and writes, which must not wait for reads.
    writer: PgPool,
    readers: PgPool,
    claims: Groups<ClaimRequest, Result<Claimed, StoreError>>,
    writes: Writes,
    demands: Groups<(), Option<Demand>>,
    /// The connection that asks for the lock of the process that moves results, and whether it holds it.
    mover: tokio::sync::Mutex<Option<(PgConnection, bool)>>,
    /// When the database was last written by [`PostgresStore::ready`].
    last_probe: tokio::sync::Mutex<Option<Instant>>,
    compared: tokio::sync::Mutex<Option<Compared>>,
    /// Tasks that send and receive notifications.
    tasks: [AbortOnDropHandle<()>; 2],
}

impl PostgresStore {
    /// The present time by the clock of the database.
    async fn now(&self, connection: &mut PgConnection) -> Result<Now, StoreError> {
        match self.given_now() {
            Some(now) => Ok(now),
            None => time_of(connection).await,
        }
    }

    /// The present time if a test sets it.
    fn given_now(&self) -> Option<Now> {
        let is_given = matches!(self.process.clock, Clock::Manual(_));
        is_given.then(|| self.process.clock.now())
    }
}

/// Asks the database for its time.
async fn time_of(connection: &mut PgConnection) -> Result<Now, StoreError> {
    let now: i64 = sqlx::query_scalar("SELECT fretwear_now()")
        .fetch_one(connection)
        .await?;
    Ok(now.into())
}

/// Longest time that an operation may take: a server whose machine has vanished never answers.
const LONGEST: Duration = Duration::from_mins(1);

/// Longest time that a transaction of several requests may take, for the same reason.
const LONGEST_TURN: Duration = Duration::from_secs(40);

/// Waits for an operation, up to a time limit.
pub(in crate::store) async fn answered<T>(
    operation: impl Future<Output = Result<T, StoreError>>,
) -> Result<T, StoreError> {
    let answer = timeout(LONGEST, operation).await;
    answer.unwrap_or(Err(StoreError::NoAnswer(LONGEST)))
}

/// Begins a transaction by a statement, in a task of its own: a request that is dropped before the answer to `BEGIN` would leave a
/// connection in the pool that is in a transaction and not known to be so.
async fn begin(
    pool: &PgPool,
    statement: Option<&'static str>,
) -> Result<Transaction<'static, Postgres>, StoreError> {
    let pool = pool.clone();
    let beginning = tokio::spawn(async move {
        match statement {
            None => pool.begin().await,
            Some(statement) => pool.begin_with(statement).await,
        }
    });
    let transaction = beginning.await.map_err(|_| StoreError::Unwritten)?;
    Ok(transaction?)
}
