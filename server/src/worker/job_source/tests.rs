//! One suite for every job source: the store itself, and a service over HTTP.

mod stored_checkpoint;

use std::sync::Arc;
use std::time::Duration;

use api::job::Status;
use tempfile::TempDir;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use super::*;
use crate::client::Client;
use crate::export::documents::{CSV, VTU};
use crate::export::files;
use crate::http::tests::{Service, row};
use crate::queue::Transition;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::block::Block;
use crate::store::tests::{Place, request};
use crate::store::{ClaimedCheckpoint, EventName, NewContent, NewFile};

/// Length of a lease.
const LENGTH: Duration = Duration::from_secs(30);
/// Longest wait of a test; not a measure of speed.
const TEST_TIMEOUT: Duration = Duration::from_mins(1);

/// Runs a suite with the store of a service as job source, and with the service over HTTP; also where files and checkpoints are objects.
macro_rules! with_both {
    ($($name:ident => $suite:ident;)+) => {
        mod the_store {
            $(
                #[tokio::test]
                async fn $name() {
                    let service = super::Service::new().await;
                    super::$suite(&*service.app.store, &service).await;
                }
            )+
        }

        mod a_service {
            $(
                #[tokio::test]
                async fn $name() {
                    let service = super::Service::new().await;
                    let (remote, _scratch, _stop) = super::remote(&service).await;
                    super::$suite(&remote, &service).await;
                }
            )+
        }

        mod the_store_with_objects {
            $(
                #[tokio::test]
                #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
                async fn $name() {
                    let place = super::Place::postgres();
                    let (service, _place) = super::stored_checkpoint::service_with_objects(place).await;
                    super::$suite(&*service.app.store, &service).await;
                }
            )+
        }

        mod a_service_with_objects {
            $(
                #[tokio::test]
                #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
                async fn $name() {
                    let place = super::Place::postgres();
                    let (service, _place) = super::stored_checkpoint::service_with_objects(place).await;
                    let (remote, _scratch, _stop) = super::remote(&service).await;
                    super::$suite(&remote, &service).await;
                }
            )+
        }
    };
}

with_both! {
    a_repeated_claim_gets_the_same_job_and_costs_no_attempt => repeated_claim;
    a_repeated_update_is_recorded_once => repeated_update;
    results_of_a_finished_job_are_those_that_its_worker_has_sent => finished;
    documents_that_a_worker_has_made_are_those_of_its_job => documented;
    a_worker_learns_of_a_cancel_request => cancelled;
    a_worker_that_has_lost_its_lease_changes_nothing => lost;
    a_restarted_run_has_no_earlier_results => restarted;
    nothing_waits_or_runs_at_the_end => idle;
}

/// The service as a job source over HTTP, until the guard is dropped.
async fn remote(service: &Service) -> (Remote, TempDir, impl Drop) {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let address = listener.local_addr().expect("an address");
    let stopping = CancellationToken::new();
    let router = crate::http::router(service.app.clone());
    tokio::spawn(crate::http::serve(listener, None, router, stopping.clone()));
    let client = Client::new(&format!("http://{address}"), None, None).expect("a client");
    let scratch = TempDir::new().expect("a folder");
    let remote = Remote::new(RemoteOptions {
        client,
        worker: Uuid::now_v7(),
        health: Arc::default(),
        slots: 1,
        scratch: scratch.path().to_owned(),
        lease: LENGTH,
        wait: LENGTH,
    });
    (remote, scratch, stopping.drop_guard())
}

async fn queued(service: &Service) -> Uuid {
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    id.parse().expect("an id")
}

async fn claimed(job_source: &impl JobSource) -> Claim {
    let claims = job_source.claim(&request(i64::MAX, LENGTH)).await;
    claims.expect("an answer").pop().expect("a job")
}

fn update(number: i64, cycle: u64) -> JobUpdate {
    JobUpdate {
        number,
        rows: vec![row(cycle)],
        events: vec![(EventName::Cycle, format!("{{\"cycle\":{cycle}}}"))],
        checkpoint: Some(EncodedCheckpoint {
            cycle,
            state: vec![0, 255, 7],
        }),
        ..JobUpdate::default()
    }
}

fn end(transition: Transition) -> End {
    End::without_result(transition, "as the test asked for")
}

const HELD: LeaseState = LeaseState::Held {
    cancel_requested: false,
};

async fn repeated_claim(job_source: &impl JobSource, service: &Service) {
    let (first, second) = (queued(service).await, queued(service).await);
    let asked = request(i64::MAX, LENGTH);
    let once = job_source.claim(&asked).await.expect("an answer");
    let again = job_source.claim(&asked).await.expect("an answer");
    let ids = |claims: &[Claim]| claims.iter().map(|c| (c.id, c.attempt)).collect::<Vec<_>>();
    assert_eq!(ids(&once), [(first, 1)]);
    assert_eq!(ids(&again), ids(&once));
    assert_eq!(again[0].lease, once[0].lease);
    let next = ClaimRequest {
        request: crate::store::RequestNumber {
            number: 2,
            ..asked.request
        },
        ..asked
    };
    let next = job_source.claim(&next).await.expect("an answer");
    assert_eq!(ids(&next), [(second, 1)]);
}

async fn repeated_update(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lease = Lease::from(&claimed(job_source).await);
    for _ in 0..2 {
        let recorded = job_source.record(lease, &update(1, 4), LENGTH).await;
        assert_eq!(recorded.expect("an answer"), HELD);
    }
    let recorded = job_source.record(lease, &update(2, 5), LENGTH).await;
    assert_eq!(recorded.expect("an answer"), HELD);
    let events = store.events(id, 2).await.expect("the store");
    let data: Vec<_> = events.iter().map(|event| event.data.as_str()).collect();
    assert_eq!(data, [r#"{"cycle":4}"#, r#"{"cycle":5}"#]);
    // The next attempt resumes from the checkpoint, bit for bit.
    let release = JobUpdate {
        number: 3,
        ..JobUpdate::default()
    };
    let ended = job_source
        .finish(lease, &release, &end(Transition::Release))
        .await;
    assert_eq!(ended.expect("an answer"), Some(Status::Queued));
    let given = ClaimedCheckpoint::Given(EncodedCheckpoint {
        cycle: 5,
        state: vec![0, 255, 7],
    });
    assert_eq!(claimed(job_source).await.checkpoint, Some(given));
}

async fn finished(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lease = Lease::from(&claimed(job_source).await);
    let content = b"fields".to_vec();
    let file = files::manifest_entry("fields-5.vtu", Some(5), VTU, &content);
    files::write_atomically(&job_source.folder(lease), &file.name, &content).expect("written");
    let with_file = JobUpdate {
        files: vec![NewFile {
            file: file.clone(),
            content: NewContent::Folder,
        }],
        ..update(1, 5)
    };
    let recorded = job_source.record(lease, &with_file, LENGTH).await;
    assert_eq!(recorded.expect("an answer"), HELD);
    let last = JobUpdate {
        number: 2,
        ..JobUpdate::default()
    };
    for _ in 0..2 {
        let ended = job_source
            .finish(lease, &last, &end(Transition::Succeed))
            .await;
        assert_eq!(ended.expect("an answer"), Some(Status::Succeeded));
    }
    let manifest = store.manifest(id).await.expect("the store");
    assert!(manifest.contains(&file), "{manifest:?}");
    assert!(manifest.iter().any(|file| file.name == "wear-history.csv"));
    let (entry, stored) = store
        .result_file(id, &file.name)
        .await
        .expect("the store")
        .expect("a file");
    let bytes = stored.read().await.expect("read");
    crate::store::checksum::check_bytes(&entry, &bytes).expect("as it was sent");
}

async fn documented(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lease = Lease::from(&claimed(job_source).await);
    let recorded = job_source.record(lease, &update(1, 5), LENGTH).await;
    assert_eq!(recorded.expect("an answer"), HELD);
    let large = files::manifest_entry("large.csv", None, CSV, b"many rows");
    files::write_atomically(&job_source.folder(lease), &large.name, b"many rows").expect("written");
    let small = files::manifest_entry("small.csv", None, CSV, b"a row");
    let mut block = Block::default();
    assert!(block.push_history(&[row(5)], &[]).expect("written"));
    assert!(block.push_document(&small, b"a row"));
    let last = JobUpdate {
        number: 2,
        files: vec![NewFile {
            file: large.clone(),
            content: NewContent::Folder,
        }],
        block: Some(block.encode().expect("encoded")),
        ..JobUpdate::default()
    };
    let ended = job_source
        .finish(lease, &last, &end(Transition::Succeed))
        .await;
    assert_eq!(ended.expect("an answer"), Some(Status::Succeeded));
    let manifest = store.manifest(id).await.expect("the store");
    assert_eq!(manifest, [large.clone(), small]);
    let found = store.result_file(id, &large.name).await.expect("the store");
    let (_, content) = found.expect("a file");
    assert_eq!(content.read().await.expect("read"), b"many rows");
    assert_eq!(store.history(id).await.expect("the store"), [row(5)]);
}

async fn cancelled(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lease = Lease::from(&claimed(job_source).await);
    store.cancel(id).await.expect("the store");
    let learned = async {
        let asked = LeaseState::Held {
            cancel_requested: true,
        };
        while job_source.lease_state(lease).await.expect("an answer") != asked {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(TEST_TIMEOUT, learned)
        .await
        .expect("it learns of it");
}

async fn lost(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lost = Lease::from(&claimed(job_source).await);
    store.renew(lost, Duration::ZERO).await.expect("the store");
    // A lease that ends while the database lets a call wait is left to the next call.
    let reclaimed = async || store.reclaim_expired(LENGTH).await.expect("the store");
    while reclaimed().await.queued == 0 {
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    let fresh = Lease::from(&claimed(job_source).await);
    assert!(fresh.number > lost.number);
    let recorded = job_source.record(lost, &update(1, 5), LENGTH).await;
    assert_eq!(recorded.expect("an answer"), LeaseState::Lost);
    assert_eq!(
        job_source.lease_state(lost).await.expect("an answer"),
        LeaseState::Lost
    );
    let ended = job_source
        .finish(lost, &update(2, 6), &end(Transition::Succeed))
        .await;
    assert_eq!(ended.expect("an answer"), None);
    let job = store.job(id).await.expect("the store").expect("a job");
    assert_eq!(job.document.status, Status::Running);
    assert!(store.history(id).await.expect("the store").is_empty());
}

async fn restarted(job_source: &impl JobSource, service: &Service) {
    let (id, store) = (queued(service).await, &service.app.store);
    let lease = Lease::from(&claimed(job_source).await);
    job_source
        .record(lease, &update(1, 5), LENGTH)
        .await
        .expect("an answer");
    for _ in 0..2 {
        let restarted = job_source.restart(lease, 2).await;
        assert_eq!(restarted.expect("an answer"), HELD);
    }
    assert!(store.history(id).await.expect("the store").is_empty());
    let events = store.events(id, 3).await.expect("the store");
    assert_eq!(events.len(), 1, "{events:?}");
}

async fn idle(job_source: &impl JobSource, service: &Service) {
    assert!(job_source.is_idle().await.expect("an answer"));
    queued(service).await;
    assert!(!job_source.is_idle().await.expect("an answer"));
    let lease = Lease::from(&claimed(job_source).await);
    assert!(!job_source.is_idle().await.expect("an answer"));
    job_source
        .finish(lease, &update(1, 5), &end(Transition::Fail))
        .await
        .expect("an answer");
    assert!(job_source.is_idle().await.expect("an answer"));
}

/// A claim that waits is answered as soon as there is a job.
#[tokio::test]
async fn a_waiting_claim_gets_a_job_that_is_submitted_later() {
    let service = Service::new().await;
    let (remote, _scratch, _stop) = remote(&service).await;
    let remote = Arc::new(remote);
    let waiting = tokio::spawn({
        let remote = Arc::clone(&remote);
        async move { claimed(&*remote).await }
    });
    tokio::time::sleep(Duration::from_millis(100)).await;
    let id = queued(&service).await;
    let claim = tokio::time::timeout(TEST_TIMEOUT, waiting)
        .await
        .expect("in time");
    assert_eq!(claim.expect("a claim").id, id);
}
