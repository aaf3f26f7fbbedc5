//! Order of claims, and ends of queued jobs.

use sqlx::{Connection, Executor, PgConnection};

use super::*;
use crate::store::postgres::claims::{FIRST_QUEUED, LET_SORT};

on_both_engines! { Fixture:
    the_oldest_job_is_claimed_first,
    a_higher_priority_is_claimed_first_and_a_large_job_says_that_it_waits_for_memory,
    a_deadline_ends_a_queued_job,
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn concurrent_workers_never_claim_the_same_job() {
    const JOBS: usize = 40;
    const WORKERS: usize = 8;
    let fixture = Fixture::new().await;
    for _ in 0..JOBS {
        fixture.queued().await;
    }
    let barrier = Arc::new(Barrier::new(WORKERS));
    let workers = (0..WORKERS).map(|_| {
        let (store, barrier) = (Arc::clone(&fixture.store), Arc::clone(&barrier));
        tokio::spawn(async move {
            barrier.wait().await;
            let mut claimed = Vec::new();
            while let Some(claim) = store.claim_next(i64::MAX).await {
                store.record_next(&claim, &update(1)).await;
                claimed.push(claim.id);
            }
            claimed
        })
    });
    let mut claimed = Vec::new();
    for worker in workers.collect::<Vec<_>>() {
        claimed.extend(worker.await.expect("a worker"));
    }
    claimed.sort();
    claimed.dedup();
    assert_eq!(claimed.len(), JOBS);
}

async fn the_oldest_job_is_claimed_first(fixture: Fixture) {
    let first = fixture.queued().await;
    let second = fixture.queued().await;
    assert_eq!(fixture.claimed(10).await.id, first);
    assert_eq!(fixture.claimed(10).await.id, second);
    assert_eq!(fixture.store.claim_next(10).await, None);
}

async fn a_higher_priority_is_claimed_first_and_a_large_job_says_that_it_waits_for_memory(
    fixture: Fixture,
) {
    let plain = fixture.queued().await;
    let urgent = fixture
        .queued_with(SubmitOptions {
            priority: 1,
            deadline_s: None,
        })
        .await;
    assert_eq!(fixture.claimed(10).await.id, urgent);
    assert_eq!(fixture.store.claim_within(1, 10).await, None);
    let reason = fixture.job(plain).await.status_reason.expect("a reason");
    assert!(
        reason.starts_with("waiting for memory: it needs about ")
            && reason.ends_with(", 1 of 1 MB are left"),
        "{reason}"
    );
    assert_eq!(fixture.claimed(10).await.id, plain);
}

async fn a_deadline_ends_a_queued_job(fixture: Fixture) {
    let options = SubmitOptions {
        priority: 0,
        deadline_s: Some(5),
    };
    let late = fixture.queued_with(options).await;
    fixture.store.set_clock(4_999);
    assert_eq!(fixture.store.expire().await.expect("the store"), 0);
    fixture.store.set_clock(5_000);
    assert_eq!(fixture.store.expire().await.expect("the store"), 1);
    let job = fixture.job(late).await;
    assert_eq!(
        (job.status, job.outcome),
        (Status::Failed, Some(Outcome::DeadlineExceeded))
    );
}

/// Jobs are claimed in the order of an index and no further than asked for, also by statistics of a time when one job waited.
#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_claim_does_not_read_all_jobs_that_wait() {
    let fixture = Fixture::at(Place::postgres()).await;
    fixture.queued().await;
    let mut connection = PgConnection::connect(&fixture.url).await.expect("a server");
    for statement in [
        "ANALYZE jobs",
        "INSERT INTO jobs SELECT (jsonb_populate_record(first, jsonb_build_object('id', gen_random_uuid(), 'place', n))).* \
         FROM jobs AS first, generate_series(1, 5000) AS n",
        "BEGIN",
    ] {
        connection.execute(statement).await.expect(statement);
    }
    sqlx::query(LET_SORT)
        .bind("off")
        .execute(&mut connection)
        .await
        .expect("a setting");
    let explained = format!("EXPLAIN {}", FIRST_QUEUED.replace("$1", "80"));
    let plan: Vec<String> = sqlx::query_scalar(sqlx::AssertSqlSafe(explained))
        .fetch_all(&mut connection)
        .await
        .expect("a plan");
    let plan = plan.join("\n");
    assert!(
        plan.contains("using jobs_waiting") && !plan.contains("Sort"),
        "{plan}"
    );
}
