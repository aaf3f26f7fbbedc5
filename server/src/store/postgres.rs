//! The store in a PostgreSQL database, which several processes serve.
//!
//! Rows are locked by what changes them, and transactions that change several jobs lock them in the order of their ids or leave out
//! those that others have locked. Times are those of the database's clock. No process takes the jobs or files of another one: leases
//! end by themselves.

mod batches;
mod blocks;
mod checkpoints;
mod claimed;
mod claims;
mod events;
mod files;
mod gauges;
mod job_list;
mod job_rows;
mod jobs;
mod leases;
mod maintenance;
mod migrations;
mod notifications;
mod objects;
mod open;
mod queries;
mod reclaim;
mod results;
mod results_to_move;
mod revisions;
mod selects;
mod transitions;
mod worker_tokens;

use std::time::Instant;

use sqlx::postgres::{PgConnection, PgPool};
use sqlx::{Postgres, Transaction};
use tokio_util::task::AbortOnDropHandle;

use crate::clock::{Clock, Now};
use crate::store::groups::Groups;
use crate::store::local::Local;
use crate::store::postgres::claimed::Claimed;
use crate::store::{ClaimRequest, StoreError};

/// A store in a PostgreSQL database.
#[derive(Debug)]
pub(in crate::store) struct PostgresStore {
    pub(in crate::store) local: Local,
    pool: PgPool,
    claims: Groups<ClaimRequest, Claimed>,
    /// The connection that asks for the lock of the process that moves results, and whether it holds it.
    mover: tokio::sync::Mutex<Option<(PgConnection, bool)>>,
    /// When the database was last written by [`PostgresStore::ready`].
    last_probe: tokio::sync::Mutex<Option<Instant>>,
    /// Tells and hears changes.
    tasks: [AbortOnDropHandle<()>; 2],
}

impl PostgresStore {
    /// Begins a transaction, at a time.
    async fn begin(&self) -> Result<(Transaction<'static, Postgres>, Now), StoreError> {
        let mut transaction = self.pool.begin().await?;
        let now = self.now(&mut transaction).await?;
        Ok((transaction, now))
    }

    /// The present time by the clock of the database.
    async fn now(&self, connection: &mut PgConnection) -> Result<Now, StoreError> {
        if let Some(now) = self.given_now() {
            return Ok(now);
        }
        let now: i64 = sqlx::query_scalar("SELECT fretwear_now()")
            .fetch_one(connection)
            .await?;
        Ok(now.into())
    }

    /// The present time if a test sets it.
    fn given_now(&self) -> Option<Now> {
        let is_given = matches!(self.local.clock, Clock::Manual(_));
        is_given.then(|| self.local.clock.now())
    }
}
