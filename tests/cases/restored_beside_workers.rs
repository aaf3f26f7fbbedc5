//! Requirement: a database that is restored while a worker continues with one of its jobs loses nothing of the job: what the worker writes
//! afterwards would leave a gap, so it has lost its lease, and the job is solved again from the last checkpoint of the restored database.

use std::path::Path;

use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::{
    PostgresServer, RemoteWorker, Server, bits, fretwear, fuzz_button_with_jump, use_database,
    use_postgresql,
};

/// A short lease, so that the job is soon given to the worker again; not a measure of speed.
const OPTIONS: [&str; 4] = ["--lease-s", "5", "--checkpoint-every-s", "0"];

/// A job of some seconds with files from its start to its end.
fn with_fields() -> String {
    let mut spec: Value = serde_json::from_str(&fuzz_button_with_jump(8)).expect("JSON");
    spec["output"] = json!({"fields": true, "snapshots_at_cycles": [0, 100, 400, 500, 700, 2000]});
    spec.to_string()
}

async fn submitted(server: &Server) -> String {
    let (status, job) = server.submit(with_fields()).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("an id").to_owned()
}

fn has_ended(job: &Value) -> bool {
    job["finished_at"].is_string()
}

/// Waits until more than a number of cycles is computed; returns how many.
async fn has_computed(server: &Server, id: &str, cycle: u64) -> u64 {
    let computed = |job: &Value| job["progress"]["cycle"].as_u64();
    let job = server
        .job_when(id, |job| computed(job) > Some(cycle) || has_ended(job))
        .await;
    computed(&job).expect("a cycle")
}

/// Copies the database of a job while it runs, restores it later, and compares the results with those of an undisturbed run.
async fn restored_beside_its_worker<C>(
    folder: &Path,
    copy: impl FnOnce() -> C,
    restore: impl FnOnce(C),
) {
    let undisturbed = tempfile::tempdir().expect("a folder can be made");
    let own = Server::start(undisturbed.path());
    let id = submitted(&own).await;
    own.job_when(&id, has_ended).await;
    let expected = bits::of(&own, &id).await;
    drop(own);

    let server = Server::without_workers(folder, &[]);
    let id = submitted(&server).await;
    let worker = RemoteWorker::start(folder, &server.base, &OPTIONS);
    has_computed(&server, &id, 200).await;
    // The copy takes a while, in which the job must not end.
    worker.signal(Signal::SIGSTOP);
    let copied = copy();
    let in_copy = has_computed(&server, &id, 200).await;
    worker.signal(Signal::SIGCONT);
    // Of two writes after the copy the worker knows that the first one has arrived, and does not send it again.
    let first = has_computed(&server, &id, in_copy).await;
    has_computed(&server, &id, first).await;
    let address = server.base.trim_start_matches("http://").to_owned();
    server.signal(Signal::SIGKILL);
    server.wait();
    restore(copied);
    let server = Server::without_workers(folder, &["--listen", &address]);
    let job = server.job_when(&id, has_ended).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    assert_eq!(bits::of(&server, &id).await, expected);
    let attempts = bits::events(&server, &id, "attempt").await;
    let (_, later) = attempts.split_first().expect("an attempt");
    let continues = |attempt: &Value| attempt["from_cycle"].as_u64() > Some(0);
    assert!(
        !later.is_empty() && later.iter().all(continues),
        "it continues from a checkpoint: {attempts:?}"
    );
}

#[tokio::test]
async fn a_backup_that_is_restored_beside_a_worker_loses_nothing_of_its_job() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let at = |name: &str| folder.path().join(name);
    let database = format!("sqlite://{}", at("fretwear.db").display());
    let run = |arguments: &[&str]| {
        let ran = fretwear(
            folder.path(),
            &[arguments, &["--database", &database]].concat(),
        );
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    };
    let restore = |()| {
        for name in ["fretwear.db", "fretwear.db-wal", "fretwear.db-shm"] {
            std::fs::remove_file(at(name)).expect("removed");
        }
        std::fs::remove_dir_all(at("fretwear.db.results")).expect("removed");
        run(&["restore", "copy"]);
    };
    restored_beside_its_worker(folder.path(), || run(&["backup", "copy"]), restore).await;
}

/// As after a failover to a standby that had not yet all commits: it is the same server, which has not noticed anything.
#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_database_of_a_server_that_lost_commits_loses_nothing_of_a_job() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let url = use_postgresql(folder.path());
    let server = PostgresServer::shared();
    let restore = |dump: std::path::PathBuf| {
        let restored = server.restored(&dump);
        use_database(folder.path(), &restored);
    };
    restored_beside_its_worker(folder.path(), || server.dump(&url), restore).await;
}
