//! Workers with solving processes that misbehave.

use std::os::unix::fs::PermissionsExt;
use std::sync::Arc;
use std::time::Duration;

use api::job::{Job, Outcome};
use tempfile::TempDir;
use tokio_util::sync::CancellationToken;

use super::{Rules, work};
use crate::store::{NewJob, Store, Wishes};
use crate::translate;

/// A job whose solving process is this shell script, after the one attempt that it gets.
async fn ended_job(script: &str) -> Job {
    let folder = TempDir::new().expect("a temporary folder");
    let program = folder.path().join("program");
    std::fs::write(&program, format!("#!/bin/sh\n{script}\n")).expect("a script");
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).expect("a program");
    let url = format!("sqlite://{}", folder.path().join("test.db").display());
    let store = Arc::new(Store::open_with(&url, 1).await.expect("a store"));
    let resolved = translate::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
    let job = NewJob {
        plan: translate::plan(&resolved),
        spec: resolved.spec,
        wishes: Wishes::default(),
    };
    let id = store.submit(&job, 0).await.expect("queued");
    let rules = Rules {
        least_free_disk_mb: 0,
        ..Rules::new(program, folder.path().to_owned())
    };
    let stopping = CancellationToken::new();
    let worker = tokio::spawn(work(Arc::clone(&store), Arc::new(rules), stopping.clone()));
    let job = loop {
        let found = store.job(id).await.expect("the store").expect("a job");
        if found.document.status.is_terminal() {
            break found.document;
        }
        tokio::time::sleep(Duration::from_millis(20)).await;
    };
    stopping.cancel();
    worker.await.expect("the worker ends");
    job
}

#[tokio::test]
async fn a_process_that_is_killed_while_it_writes_is_a_lost_worker() {
    let job = ended_job("read spec; read checkpoint; printf '{\"event\":\"cyc'; kill -9 $$").await;
    assert_eq!(job.outcome, Some(Outcome::WorkerLost), "{job:?}");
    let reason = job.status_reason.expect("a reason");
    assert!(
        reason.ends_with("its solving process was killed"),
        "{reason}"
    );
}

#[tokio::test]
async fn a_process_that_writes_nonsense_is_a_fault_of_the_solver() {
    let job = ended_job("read spec; read checkpoint; echo nonsense; exec sleep 60").await;
    assert_eq!(job.outcome, Some(Outcome::NotConverged), "{job:?}");
    let reason = job.status_reason.expect("a reason");
    assert!(reason.contains("cannot be read"), "{reason}");
}
