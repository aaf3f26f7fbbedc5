//! Workers with faulty solving processes.

mod failing_job_source;
mod failing_starts;

use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use api::job::{Job, Outcome, Status};
use api::spec::Spec;
use tempfile::TempDir;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

use crate::http::tests::row;
use crate::solve::ChildMessage;
use crate::spec;
use crate::store::{JobUpdate, Limits, NewJob, Store, SubmitOptions};
use crate::worker::{JobSourceError, WorkerConfig, WorkerHealth, WorkerProcess, work};

/// A worker whose solving process is a shell script, with one job and one attempt.
struct Scripted {
    store: Arc<Store>,
    id: Uuid,
    stopping: CancellationToken,
    health: Arc<WorkerHealth>,
    worker: JoinHandle<Result<(), JobSourceError>>,
    folder: TempDir,
}

/// One attempt, on any disk.
const LIMITS: Limits = Limits {
    attempts: 1,
    least_free_disk_mb: 0,
};

/// Name of the program in the folder.
const PROGRAM: &str = "program";
/// Command that writes the first line of a solving process.
const READY: &str = r#"echo '{"event":"ready"}'"#;

/// Writes a script as the program in a folder.
fn write_program(folder: &Path, script: &str) {
    // A program that is being written cannot be started.
    let (written, program) = (folder.join("written"), folder.join(PROGRAM));
    std::fs::write(&written, format!("#!/bin/sh\n{script}\n")).expect("a script");
    std::fs::set_permissions(&written, Permissions::from_mode(0o755)).expect("a program");
    std::fs::rename(written, program).expect("a program");
}

impl Scripted {
    async fn new(script: &str) -> Self {
        Self::named(script, None).await
    }

    async fn named(script: &str, name: Option<String>) -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        write_program(folder.path(), &format!("{READY}\n{script}"));
        Self::in_folder(folder, name).await
    }

    /// A worker whose program is, or will be, in the folder.
    async fn in_folder(folder: TempDir, name: Option<String>) -> Self {
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        let store = Arc::new(
            Store::open_with(&url, folder.path(), LIMITS)
                .await
                .expect("a store"),
        );
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let spec = Spec {
            name,
            ..resolved.spec.clone()
        };
        let job = NewJob {
            sent: "{}".to_owned(),
            plan: crate::estimate::Estimate::of(&resolved).plan(&resolved, None),
            spec,
            options: SubmitOptions::default(),
        };
        let id = store.queue(&job).await;
        let config = WorkerConfig::new(folder.path().join(PROGRAM));
        let stopping = CancellationToken::new();
        let process = Arc::new(WorkerProcess::new(config.memory_mb, false));
        let health = Arc::clone(process.health());
        let config = Arc::new(config);
        let worker = tokio::spawn(work(Arc::clone(&store), process, config, stopping.clone()));
        Self {
            store,
            id,
            stopping,
            health,
            worker,
            folder,
        }
    }

    /// Waits until the job satisfies a condition.
    async fn job_when(&self, condition: impl Fn(&Job) -> bool) -> Job {
        let polled = async {
            loop {
                let found = self.store.job(self.id).await.expect("the store");
                let job = found.expect("a job").document;
                if condition(&job) {
                    return job;
                }
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
        };
        tokio::time::timeout(TEST_TIMEOUT, polled)
            .await
            .expect("the condition is met in time")
    }

    async fn ended(&self) -> Job {
        self.job_when(|job| job.status.is_terminal()).await
    }

    /// Stops the worker; returns the folder of the database.
    async fn stop(self) -> TempDir {
        self.stopping.cancel();
        let ended = self.worker.await.expect("the worker ends");
        ended.expect("the store accepts it");
        self.folder
    }
}

/// Longest wait of a test; not a measure of speed.
const TEST_TIMEOUT: Duration = Duration::from_mins(1);

/// Runs a script; returns the job after its attempt.
async fn ended_job(script: &str) -> Job {
    let scripted = Scripted::new(script).await;
    let job = scripted.ended().await;
    scripted.stop().await;
    job
}

#[tokio::test]
async fn a_process_killed_while_writing_is_a_lost_worker() {
    let job = ended_job("read spec; read checkpoint; printf '{\"event\":\"cyc'; kill -9 $$").await;
    assert_eq!(job.outcome, Some(Outcome::WorkerLost), "{job:?}");
    let reason = job.status_reason.expect("a reason");
    assert!(
        reason.ends_with("its solving process was killed"),
        "{reason}"
    );
}

#[tokio::test]
async fn a_process_that_writes_nonsense_is_a_failure_of_the_solver() {
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
    scripted.store.cancel(scripted.id).await.expect("the store");
    assert_eq!(scripted.ended().await.status, Status::Cancelled);
    scripted.stop().await;
}

#[tokio::test]
async fn a_process_that_closes_its_output_and_does_not_exit_is_killed() {
    let job = ended_job("read spec; read checkpoint; exec >&-; exec sleep 100").await;
    assert_eq!(job.outcome, Some(Outcome::WorkerLost), "{job:?}");
}

#[tokio::test]
async fn a_job_whose_last_worker_is_lost_has_documents_of_its_results() {
    let row = serde_json::to_string(&ChildMessage::Cycle(Box::new(row(1)))).expect("a line");
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
async fn a_stop_before_a_restart_discards_the_rows_of_the_restarted_run() {
    let restarted = serde_json::to_string(&ChildMessage::Restarted(
        "it is of another version".to_owned(),
    ));
    let row = serde_json::to_string(&ChildMessage::Cycle(Box::new(row(1)))).expect("a line");
    // The script reports the restart only after SIGTERM.
    let script = format!(
        "trap \"echo '{}'; echo '{row}'; exit 0\" TERM; read spec; read checkpoint; while :; do sleep 0.05; done",
        restarted.expect("a line").replace('"', "\\\"")
    );
    let script = script.replace(&row, &row.replace('"', "\\\""));
    let scripted = Scripted::new(&script).await;
    scripted.job_when(|job| job.status == Status::Running).await;
    // The process has to install its signal handler first.
    tokio::time::sleep(Duration::from_millis(300)).await;
    let (store, id) = (Arc::clone(&scripted.store), scripted.id);
    let _folder = scripted.stop().await;
    let rows = store.history(id).await.expect("the store");
    assert_eq!(
        rows,
        [],
        "rows of a restarted run are mixed with those of the first one"
    );
}

#[tokio::test]
async fn a_job_with_a_cancel_request_whose_worker_is_lost_has_documents_of_its_results() {
    let folder = TempDir::new().expect("a temporary folder");
    let url = format!("sqlite://{}", folder.path().join("test.db").display());
    let store = Store::open(&url).await.expect("a store");
    let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
    let job = NewJob {
        sent: "{}".to_owned(),
        plan: crate::estimate::Estimate::of(&resolved).plan(&resolved, None),
        spec: resolved.spec,
        options: SubmitOptions::default(),
    };
    let id = store.queue(&job).await;
    let claim = store.claim_next(0).await.expect("a job");
    let update = JobUpdate {
        rows: vec![row(1)],
        ..JobUpdate::default()
    };
    let update = JobUpdate {
        number: 1,
        ..update
    };
    let recorded = store.record(&claim, &update, Duration::ZERO).await;
    recorded.expect("the store");
    store.cancel(id).await.expect("the store");
    let reclaimed = store
        .reclaim_expired(Duration::from_mins(1))
        .await
        .expect("the store");
    let config = WorkerConfig::new(PathBuf::from("none"));
    let ended =
        super::finalize_lost_job(&store, &reclaimed.ending[0], &config, reclaimed.reason).await;
    ended.expect("the store");
    let job = store.job(id).await.expect("the store").expect("a job");
    assert_eq!(job.document.status, Status::Cancelled);
    let files = store.manifest(id).await.expect("the store");
    assert!(files.iter().any(|file| file.name == "wear-history.csv"));
}
