//! The primary of a PostgreSQL database is killed and its synchronous standby promoted, and then a service is killed: workers continue, and
//! every job is solved once.

use std::sync::Arc;
use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use tests::{Haproxy, PostgresServer, Server};

use super::simulated::{Done, Harm, started};
use super::{ATTEMPTS, assert_once, is_long, load, submitted};

/// Time between the death of the primary and the promotion, as a supervisor needs it.
const NOTICED: Duration = Duration::from_secs(2);
/// Settings of a primary whose commits must survive.
const SETTINGS: [&str; 1] = ["max_connections=200"];

#[tokio::test(flavor = "multi_thread")]
#[cfg_attr(
    not(all(has_postgresql, has_haproxy)),
    ignore = "needs the programs of PostgreSQL and HAProxy"
)]
#[expect(clippy::print_stdout, reason = "the figures that the book quotes")]
async fn a_primary_and_a_service_that_are_killed_lose_no_job() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let primary = PostgresServer::start(&SETTINGS);
    let url = primary.new_database();
    let standby = primary.standby();
    let proxy = Haproxy::of_databases(folder.path(), &primary, &standby);
    let database = url.split_once("?host=").expect("a socket").0;
    tests::use_database(folder.path(), &format!("{database}?host={}", proxy.address));

    let (jobs, count, _) = load();
    let first = Server::without_workers(folder.path(), &ATTEMPTS);
    let second = Server::without_workers(folder.path(), &ATTEMPTS);
    let services = Haproxy::of_services(folder.path(), &[&first.base, &second.base]);
    let ids = submitted(&second, jobs).await;
    let done = Arc::new(Done::default());
    let workers = started(
        folder.path(),
        &[&services.address],
        (count, Harm::LostWorkers),
        &done,
    );

    ended(&second, &ids[ids.len() / 5]).await;
    primary.kill();
    let killed = Instant::now();
    tokio::time::sleep(NOTICED).await;
    standby.promote();
    let next = next_claim(&second, &ids, killed).await;

    first.signal(Signal::SIGKILL);
    first.wait();
    workers.join_all().await;
    assert_once(&second, &ids, &done).await;
    if is_long() {
        println!("{jobs} jobs; the next claim was {next:?} after the death of the primary");
    }
}

async fn ended(server: &Server, id: &str) {
    server
        .job_when(id, |job| job["finished_at"].is_string())
        .await;
}

/// The time after which a job is claimed again.
async fn next_claim(server: &Server, ids: &[String], since: Instant) -> Duration {
    let attempts = async || {
        let path = "/v1/jobs?status=queued&total=true&limit=1&view=short";
        let (_, list) = server.get_in_the_end(path).await;
        list["total"].as_u64()
    };
    let waiting = loop {
        if let Some(waiting) = attempts().await {
            break waiting;
        }
    };
    assert!(waiting <= u64::try_from(ids.len()).expect("small"));
    while attempts().await.is_none_or(|now| now >= waiting && now > 0) {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    since.elapsed()
}
