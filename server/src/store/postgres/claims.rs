//! Claims: the first waiting jobs that fit into the free memory of a worker, under new leases. Claims that meet share a transaction, and
//! those of all processes take turns: each would ask for the same jobs.

use std::collections::HashMap;

use sqlx::postgres::{PgConnection, PgPool};
use tokio::time::timeout;
use uuid::Uuid;

use crate::clock::Now;
use crate::groups::Pending;
use crate::queue::admit;
use crate::store::candidates::{CANDIDATES, Candidate};
use crate::store::postgres::claimed::Claimed;
use crate::store::postgres::sql::checkpoints;
use crate::store::postgres::sql::workers::able_workers;
use crate::store::postgres::{LONGEST_TURN, PostgresStore, begin, time_of};
use crate::store::rows::{StoredRow, attempt_event, claim, integer};
use crate::store::{Claim, ClaimRequest, ClaimedCheckpoint, Lease, StoreError};

/// Key of the lock of the process that claims: `frtc` in ASCII.
const TURN: i64 = 0x6672_7463;
/// Allows or forbids PostgreSQL to sort all jobs instead of reading the first ones from an index. With statistics of a time when few jobs
/// waited, it would sort them for each claim.
pub(in crate::store) const LET_SORT: &str = "SELECT set_config('enable_bitmapscan', $1, true), \
    set_config('enable_seqscan', $1, true), set_config('enable_sort', $1, true)";
/// The first queued jobs. They are not locked: most are not claimed.
pub(in crate::store) const FIRST_QUEUED: &str = "SELECT id, memory_mb, queued_at, cpu_ms, avoided_worker, avoided_until FROM jobs WHERE status = 'queued' \
    ORDER BY place, id LIMIT $1";

type Waiting = Pending<ClaimRequest, Result<Claimed, StoreError>>;

impl PostgresStore {
    pub(in crate::store) async fn claim(
        &self,
        request: &ClaimRequest,
    ) -> Result<Vec<Claim>, StoreError> {
        self.process.disk.check()?;
        let given = self.given_now();
        let write = |group| write(self.writer.clone(), given, group);
        let claimed = self.claims.ask(*request, write).await;
        let Claimed { claims, reasoned } = claimed.unwrap_or(Err(StoreError::Unwritten))?;
        for id in claims.iter().map(|claim| claim.id).chain(reasoned) {
            self.process.changed(id);
        }
        Ok(claims)
    }
}

/// Claims jobs for requests in one transaction. If it fails, all fail: a request is repeated, and gets the same jobs if its
/// transaction was committed.
async fn write(pool: PgPool, given: Option<Now>, mut group: Vec<Waiting>) {
    match timeout(LONGEST_TURN, claim_for(&pool, given, &mut group)).await {
        Ok(Ok((requests, claims, mut reasoned))) => {
            for pending in group {
                let index = position(&requests, &pending.request);
                let claims = index.map(|index| claims[index].clone());
                pending.answer(Ok(Claimed {
                    claims: claims.unwrap_or_default(),
                    reasoned: std::mem::take(&mut reasoned),
                }));
            }
        }
        failed => {
            let error = match failed {
                Ok(Err(error)) => error.to_string(),
                _ => format!("no answer within {LONGEST_TURN:?}"),
            };
            tracing::warn!(error, requests = group.len(), "claims failed");
            for pending in group {
                pending.answer(Err(StoreError::Unwritten));
            }
        }
    }
}

fn position(requests: &[ClaimRequest], request: &ClaimRequest) -> Option<usize> {
    requests
        .iter()
        .position(|other| other.request == request.request && other.token == request.token)
}

/// Requests, the claims of each, and the jobs that were given another reason to wait.
type Answers = (Vec<ClaimRequest>, Vec<Vec<Claim>>, Vec<Uuid>);

/// Claims jobs for each request that is still waited for.
async fn claim_for(
    pool: &PgPool,
    given: Option<Now>,
    group: &mut Vec<Waiting>,
) -> Result<Answers, StoreError> {
    let mut transaction = begin(pool, None).await?;
    let now = turn(&mut transaction).await?;
    let now = given.unwrap_or(now);
    // A job claimed for a worker that has disconnected would wait for the end of its lease.
    group.retain(|pending| !pending.is_given_up());
    // A request may be repeated before the first one is answered.
    let mut requests: Vec<ClaimRequest> = Vec::with_capacity(group.len());
    for pending in &*group {
        if position(&requests, &pending.request).is_none() {
            requests.push(pending.request);
        }
    }
    let mut claims = claimed_before(&mut transaction, &requests, now).await?;
    let fresh: Vec<_> = (0..requests.len())
        .filter(|index| claims[*index].is_empty())
        .collect();
    let slots: usize = fresh
        .iter()
        .map(|index| requests[*index].capacity.slots)
        .sum();
    let mut waiting = candidates(&mut transaction, CANDIDATES.saturating_add(slots)).await?;
    let there = if waiting.iter().any(|one| one.avoided(now).is_some()) {
        able_workers(&mut transaction, now).await?
    } else {
        Vec::new()
    };
    let (mut admitted, mut reasons) = (Vec::new(), HashMap::new());
    for index in fresh {
        for id in admit_for(&requests[index], &mut waiting, &there, &mut reasons, now) {
            admitted.push((id, index));
        }
    }
    let reasons: Vec<_> = waiting
        .iter()
        .filter_map(|one| Some((one.id, reasons.remove(&one.id)?)))
        .collect();
    let reasoned = set_reasons(&mut transaction, reasons).await?;
    for (index, claim) in claim_admitted(&mut transaction, &requests, &admitted, now).await? {
        claims[index].push(claim);
    }
    transaction.commit().await?;
    Ok((requests, claims, reasoned))
}

/// Waits until it is the turn of this transaction to claim, and returns the time. A process that was paused in its turn loses it.
async fn turn(connection: &mut PgConnection) -> Result<Now, StoreError> {
    sqlx::query(
        "SELECT pg_advisory_xact_lock($1), set_config('idle_in_transaction_session_timeout', '3s', true)",
    )
    .bind(TURN)
    .execute(&mut *connection)
    .await?;
    time_of(connection).await
}

/// The first queued jobs.
async fn candidates(
    connection: &mut PgConnection,
    limit: usize,
) -> Result<Vec<Candidate>, StoreError> {
    let let_sort = |is_let: &'static str| sqlx::query(LET_SORT).bind(is_let);
    let_sort("off").execute(&mut *connection).await?;
    let rows = sqlx::query(FIRST_QUEUED)
        .bind(integer(limit))
        .fetch_all(&mut *connection)
        .await?;
    let_sort("on").execute(connection).await?;
    rows.iter().map(Candidate::read).collect()
}

/// Takes the jobs out of those that wait which a worker can take, and which are not left to others that are there; notes why it does not
/// take others.
fn admit_for(
    request: &ClaimRequest,
    waiting: &mut Vec<Candidate>,
    there: &[Uuid],
    reasons: &mut HashMap<Uuid, String>,
    now: Now,
) -> Vec<Uuid> {
    let worker = request.request.worker;
    let (ids, jobs): (Vec<_>, Vec<_>) = waiting
        .iter()
        .filter(|one| !one.is_left(worker, there, now))
        .map(|one| (one.id, one.job))
        .unzip();
    let admission = admit(&jobs, &request.capacity, now.monotonic_ms);
    let memory = &request.capacity.memory;
    for index in admission.too_large {
        reasons.insert(ids[index], memory.reason_to_wait(&jobs[index]));
    }
    let admitted: Vec<_> = admission.admitted.iter().map(|index| ids[*index]).collect();
    waiting.retain(|one| !admitted.contains(&one.id));
    admitted
}

/// Sets the status reasons of jobs that do not fit into the memory; returns those that had another one.
async fn set_reasons(
    connection: &mut PgConnection,
    reasons: Vec<(Uuid, String)>,
) -> Result<Vec<Uuid>, StoreError> {
    if reasons.is_empty() {
        return Ok(Vec::new());
    }
    let (ids, reasons): (Vec<_>, Vec<_>) = reasons.into_iter().unzip();
    let changed = sqlx::query_scalar(
        "WITH late AS (SELECT jobs.id, reason FROM jobs JOIN unnest($1::uuid[], $2::text[]) AS given (id, reason) ON jobs.id = given.id \
         WHERE status = 'queued' AND status_reason IS DISTINCT FROM reason FOR UPDATE OF jobs SKIP LOCKED) \
         UPDATE jobs SET status_reason = late.reason, version = version + 1 FROM late WHERE jobs.id = late.id RETURNING jobs.id",
    )
    .bind(ids)
    .bind(reasons)
    .fetch_all(connection)
    .await?;
    Ok(changed)
}

/// The jobs that the same requests have claimed before and that are still held, with renewed leases.
async fn claimed_before(
    connection: &mut PgConnection,
    requests: &[ClaimRequest],
    now: Now,
) -> Result<Vec<Vec<Claim>>, StoreError> {
    let workers: Vec<_> = requests
        .iter()
        .map(|request| request.request.worker)
        .collect();
    let numbers: Vec<_> = requests
        .iter()
        .map(|request| request.request.number)
        .collect();
    let ends: Vec<_> = requests
        .iter()
        .map(|request| now.end_of(request.lease))
        .collect();
    let rows = sqlx::query(
        "WITH held AS (SELECT id, ends, n FROM jobs JOIN unnest($1::uuid[], $2::bigint[], $3::bigint[], $4::uuid[]) WITH ORDINALITY \
         AS given (worker, number, ends, token, n) ON jobs.worker = given.worker AND claim_number = number \
         WHERE status = 'running' AND lease_token IS NOT DISTINCT FROM token ORDER BY id FOR UPDATE OF jobs) \
         UPDATE jobs SET lease_expires_at = ends FROM held WHERE jobs.id = held.id \
         RETURNING n, jobs.id, lease, spec, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
    )
    .bind(workers)
    .bind(numbers)
    .bind(ends)
    .bind(requests.iter().map(|request| request.token).collect::<Vec<_>>())
    .fetch_all(&mut *connection)
    .await?;
    let mut claims = vec![Vec::new(); requests.len()];
    for row in rows {
        let id = row.id("id")?;
        let checkpoint = checkpoints::restore(connection, id).await?;
        let index = usize::try_from(row.value::<i64>("n")? - 1).unwrap_or(usize::MAX);
        if let Some(claims) = claims.get_mut(index) {
            claims.push(claim(id, &row, now, checkpoint)?);
        }
    }
    Ok(claims)
}

/// A value of each request.
fn each<T>(requests: &[ClaimRequest], value: impl Fn(&ClaimRequest) -> T) -> Vec<T> {
    requests.iter().map(value).collect()
}

/// Claims admitted jobs, each for the request of an index; those that another transaction has locked or changed are left out.
async fn claim_admitted(
    connection: &mut PgConnection,
    requests: &[ClaimRequest],
    admitted: &[(Uuid, usize)],
    now: Now,
) -> Result<Vec<(usize, Claim)>, StoreError> {
    if admitted.is_empty() {
        return Ok(Vec::new());
    }
    let ids: Vec<_> = admitted.iter().map(|(id, _)| *id).collect();
    let given: Vec<_> = admitted.iter().map(|(_, index)| requests[*index]).collect();
    let step = Lease::step();
    let rows = sqlx::query(
        "WITH free AS (SELECT id FROM jobs WHERE id = ANY($1) AND status = 'queued' FOR UPDATE SKIP LOCKED) \
         UPDATE jobs SET status = 'running', lease = lease + $8, lease_expires_at = given.ends, last_write = 0, worker = given.worker, \
         claim_number = given.number, is_remote = given.remote, lease_token = given.token, attempts = attempts + 1, fruitless = fruitless + 1, \
         started_at = COALESCE(started_at, $6), status_reason = NULL, last_event = last_event + 1, version = version + 1 \
         FROM free JOIN unnest($1::uuid[], $2::uuid[], $3::bigint[], $4::bigint[], $5::boolean[], $7::uuid[]) WITH ORDINALITY \
         AS given (id, worker, number, ends, remote, token, n) ON free.id = given.id WHERE jobs.id = free.id \
         RETURNING n, jobs.id, lease, spec, last_event, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
    )
    .bind(ids)
    .bind(each(&given, |request| request.request.worker))
    .bind(each(&given, |request| request.request.number))
    .bind(each(&given, |request| now.end_of(request.lease)))
    .bind(each(&given, |request| request.is_remote))
    .bind(now.system_ms)
    .bind(each(&given, |request| request.token))
    .bind(step)
    .fetch_all(&mut *connection)
    .await?;
    let mut claimed = Vec::with_capacity(rows.len());
    let (mut ids, mut seqs, mut events) = (Vec::new(), Vec::new(), Vec::new());
    for row in rows {
        let id = row.id("id")?;
        // Under its first lease a job has no results.
        let checkpoint = if row.value::<i64>("lease")? == step {
            None
        } else {
            checkpoints::restore(connection, id).await?
        };
        let from_cycle = checkpoint.as_ref().map_or(0, ClaimedCheckpoint::cycle);
        let claim = claim(id, &row, now, checkpoint)?;
        ids.push(id);
        seqs.push(row.value::<i64>("last_event")?);
        events.push(attempt_event(claim.attempt, from_cycle)?);
        claimed.push((row.value::<i64>("n")?, claim));
    }
    sqlx::query(
        "INSERT INTO events (job_id, seq, name, data) \
         SELECT id, seq, 'attempt', data FROM unnest($1::uuid[], $2::bigint[], $3::text[]) AS new (id, seq, data)",
    )
    .bind(ids)
    .bind(seqs)
    .bind(events)
    .execute(connection)
    .await?;
    // In the order of the queue.
    claimed.sort_by_key(|(n, _)| *n);
    let index = |n: i64| usize::try_from(n - 1).ok().and_then(|n| admitted.get(n));
    let claims = claimed.into_iter();
    Ok(claims
        .filter_map(|(n, claim)| Some((index(n)?.1, claim)))
        .collect())
}
