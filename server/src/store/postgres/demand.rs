//! The demand for workers. Requests that meet share a query, which begins after each of them: an answer from before would let a worker end
//! although a job waits.

use api::service::Demand;
use sqlx::postgres::PgPool;

use crate::groups::Pending;
use crate::store::StoreError;
use crate::store::gauges::UNKNOWN_CPU_MS;
use crate::store::postgres::PostgresStore;

/// A request; no answer if the query has failed.
type Asked = Pending<(), Option<Demand>>;

impl PostgresStore {
    pub(in crate::store) async fn demand(&self) -> Result<Demand, StoreError> {
        let together = |group| answer(self.readers.clone(), group);
        match self.demands.ask((), together).await {
            Some(Some(demand)) => Ok(demand),
            Some(None) | None => read(&self.readers).await,
        }
    }
}

async fn answer(readers: PgPool, group: Vec<Asked>) {
    let demand = read(&readers).await.inspect_err(|error| {
        tracing::warn!(%error, requests = group.len(), "the demand was not read");
    });
    let demand = demand.ok();
    for pending in group {
        pending.answer(demand);
    }
}

async fn read(readers: &PgPool) -> Result<Demand, StoreError> {
    let (queued, running, running_remotely, queued_cpu_ms): (i64, i64, i64, i64) = sqlx::query_as(
        "WITH to_come AS (SELECT COALESCE(sum(jobs - next), 0)::bigint AS jobs, \
         COALESCE(sum((jobs - next) * cpu_ms), 0)::bigint AS cpu_ms FROM expansions WHERE NOT is_over) \
         SELECT (SELECT count(*) FROM jobs WHERE status = 'queued') + to_come.jobs, \
         (SELECT count(*) FROM jobs WHERE status = 'running'), \
         (SELECT count(*) FROM jobs WHERE status = 'running' AND is_remote), \
         (SELECT COALESCE(sum(CASE WHEN cpu_ms > 0 THEN cpu_ms ELSE $1 END), 0)::bigint FROM jobs \
         WHERE status = 'queued') + to_come.cpu_ms FROM to_come",
    )
    .bind(UNKNOWN_CPU_MS)
    .fetch_one(readers)
    .await?;
    let count = |count: i64| count.try_into().unwrap_or_default();
    Ok(Demand {
        queued: count(queued),
        running: count(running),
        running_remotely: count(running_remotely),
        queued_cpu_s: count((queued_cpu_ms + 999) / 1_000),
    })
}
