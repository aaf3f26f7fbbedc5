//! Workers with solving processes that misbehave.

use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use api::job::{Job, Outcome, Status};
use api::spec::Spec;
use tempfile::TempDir;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use crate::http::tests::row;
use crate::solve::Line;
use crate::spec;
use crate::store::{Batch, NewJob, Store, SubmitOptions};
use crate::worker::{Rules, work};

/// A worker whose solving process is a shell script, and the one job that it has, with one attempt.
struct Scripted {
    store: Arc<Store>,
    id: Uuid,
    stopping: CancellationToken,
    worker: JoinHandle<()>,
    _folder: TempDir,
}

impl Scripted {
    async fn new(script: &str) -> Self {
        Self::named(script, None).await
    }

    async fn named(script: &str, name: Option<String>) -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let program = folder.path().join("program");
        std::fs::write(&program, format!("#!/bin/sh\n{script}\n")).expect("a script");
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755))
            .expect("a program");
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        let store = Arc::new(Store::open_with(&url, 1).await.expect("a store"));
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let spec = Spec {
            name,
            ..resolved.spec.clone()
        };
        let job = NewJob {
            plan: crate::estimate::Estimate::of(&resolved).plan(&resolved, None),
            spec,
            wishes: SubmitOptions::default(),
        };
        let id = store.submit(&job, 0).await.expect("queued");
        let rules = Rules {
            least_free_disk_mb: 0,
            ..Rules::new(program, folder.path().to_owned())
        };
        let stopping = CancellationToken::new();
        let worker = tokio::spawn(work(Arc::clone(&store), Arc::new(rules), stopping.clone()));
        Self {
            store,
            id,
            stopping,
            worker,
            _folder: folder,
        }
    }

    /// The job once it is as wanted.
    async fn job_when(&self, wanted: impl Fn(&Job) -> bool) -> Job {
        let asked = async {
            loop {
                let found = self.store.job(self.id).await.expect("the store");
                let job = found.expect("a job").document;
                if wanted(&job) {
                    return job;
                }
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
        };
        tokio::time::timeout(PATIENCE, asked)
            .await
            .expect("the job gets there")
    }

    async fn ended(&self) -> Job {
        self.job_when(|job| job.status.is_terminal()).await
    }

    async fn stop(self) {
        self.stopping.cancel();
        self.worker.await.expect("the worker ends");
    }
}

/// How long anything may take before a test gives up; it is no measure of speed.
const PATIENCE: Duration = Duration::from_mins(1);

/// The job after its one attempt.
async fn ended_job(script: &str) -> Job {
    let scripted = Scripted::new(script).await;
    let job = scripted.ended().await;
    scripted.stop().await;
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

#[tokio::test]
async fn a_job_whose_process_never_reads_its_specification_can_be_cancelled() {
    // More than a pipe holds.
    let name = "x".repeat(1 << 20);
    let scripted = Scripted::named("exec sleep 100", Some(name)).await;
    scripted.job_when(|job| job.status == Status::Running).await;
    scripted
        .store
        .cancel(scripted.id, 1)
        .await
        .expect("the store");
    assert_eq!(scripted.ended().await.status, Status::Cancelled);
    scripted.stop().await;
}

#[tokio::test]
async fn a_process_that_closes_its_output_and_stays_is_killed() {
    let job = ended_job("read spec; read checkpoint; exec >&-; exec sleep 100").await;
    assert_eq!(job.outcome, Some(Outcome::WorkerLost), "{job:?}");
}

#[tokio::test]
async fn a_job_whose_last_worker_is_lost_keeps_documents_of_what_was_computed() {
    let row = serde_json::to_string(&Line::Cycle(row(1))).expect("a line");
    let script = format!("read spec; read checkpoint; echo '{row}'; sleep 0.1; kill -9 $$");
    let scripted = Scripted::new(&script).await;
    let job = scripted.ended().await;
    assert_eq!(job.outcome, Some(Outcome::WorkerLost), "{job:?}");
    let files = scripted.store.manifest(scripted.id).await;
    let names: Vec<String> = files
        .expect("the store")
        .into_iter()
        .map(|file| file.name)
        .collect();
    assert!(names.contains(&"wear-history.csv".to_owned()), "{names:?}");
    scripted.stop().await;
}

#[tokio::test]
async fn a_stop_before_a_job_has_begun_anew_leaves_what_earlier_attempts_computed() {
    let anew = serde_json::to_string(&Line::Anew("it is of another version".to_owned()));
    let row = serde_json::to_string(&Line::Cycle(row(1))).expect("a line");
    // Tells that it begins anew only when it is asked to end.
    let script = format!(
        "trap \"echo '{}'; echo '{row}'; exit 0\" TERM; read spec; read checkpoint; while :; do sleep 0.05; done",
        anew.expect("a line").replace('"', "\\\"")
    );
    let script = script.replace(&row, &row.replace('"', "\\\""));
    let scripted = Scripted::new(&script).await;
    scripted.job_when(|job| job.status == Status::Running).await;
    // The process has to set its trap first.
    tokio::time::sleep(Duration::from_millis(300)).await;
    let (store, id) = (Arc::clone(&scripted.store), scripted.id);
    scripted.stop().await;
    let rows = store.history(id).await.expect("the store");
    assert_eq!(
        rows,
        [],
        "rows of a run that begins anew are mixed with others"
    );
}

#[tokio::test]
async fn an_unwanted_job_whose_worker_is_lost_keeps_documents_of_what_was_computed() {
    let folder = TempDir::new().expect("a temporary folder");
    let url = format!("sqlite://{}", folder.path().join("test.db").display());
    let store = Store::open(&url).await.expect("a store");
    let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
    let job = NewJob {
        plan: crate::estimate::Estimate::of(&resolved).plan(&resolved, None),
        spec: resolved.spec,
        wishes: SubmitOptions::default(),
    };
    let id = store.submit(&job, 0).await.expect("queued");
    let claim = store.claim(0, 10).await.expect("the store");
    let batch = Batch {
        rows: vec![row(1)],
        ..Batch::default()
    };
    let recorded = store.record(&claim.expect("a job"), &batch, 10).await;
    recorded.expect("the store");
    store.cancel(id, 1).await.expect("the store");
    let rescued = store.rescue_expired(10, i64::MAX).await.expect("the store");
    let rules = Rules::new(PathBuf::from("none"), folder.path().to_owned());
    let buried = super::bury(&store, &rescued.ending[0], &rules, rescued.reason).await;
    buried.expect("the store");
    let job = store.job(id).await.expect("the store").expect("a job");
    assert_eq!(job.document.status, Status::Cancelled);
    let files = store.manifest(id).await.expect("the store");
    assert!(files.iter().any(|file| file.name == "wear-history.csv"));
}
