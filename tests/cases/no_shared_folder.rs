//! Requirement: services on several machines need no folder in common, if they have a store of objects: what one of them has taken from a
//! worker is read from the others, and a machine that is lost with its disk costs no file.

use std::path::Path;

use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::{RemoteWorker, Server, bits, fuzz_button_with_jump, use_database, use_postgresql};

/// A short lease, so that the job of a lost machine is soon taken by another; not a measure of speed.
const OPTIONS: [&str; 4] = ["--lease-s", "2", "--checkpoint-every-s", "0"];
/// The file of a snapshot in the middle of the run.
const FIELDS: &str = "fields-20.vtu";

/// A job of some seconds that writes files meanwhile.
fn with_fields() -> String {
    let mut spec: Value = serde_json::from_str(&fuzz_button_with_jump(4)).expect("JSON");
    spec["output"] = json!({"fields": true, "snapshots_at_cycles": [0, 20]});
    spec.to_string()
}

async fn submitted(server: &Server) -> String {
    let (status, job) = server.submit(with_fields()).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("an id").to_owned()
}

async fn succeeded(server: &Server, id: &str) -> Value {
    let ended = |job: &Value| job["finished_at"].is_string();
    let job = server.job_when(id, ended).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    job
}

/// Waits until the file of the snapshot is in the manifest; its bytes, as they are read from another service.
async fn read_while_it_runs(id: &str, [at, from]: [&Server; 2]) -> Vec<u8> {
    let results = format!("/v1/jobs/{id}/results");
    loop {
        let (_, manifest) = at.get(&results).await;
        let files = manifest["files"].as_array().expect("files");
        if files.iter().any(|file| file["name"] == FIELDS) {
            break;
        }
        tokio::time::sleep(std::time::Duration::from_millis(20)).await;
    }
    from.bytes_in_the_end(&format!("{results}/files/{FIELDS}"))
        .await
}

/// Number of files below a folder.
fn files_below(folder: &Path) -> usize {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return 0;
    };
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .map(|path| if path.is_dir() { files_below(&path) } else { 1 })
        .sum()
}

/// `is_remote`: whether the worker that is lost with its service is in a process of its own.
async fn lost_machine_costs_no_file(is_remote: bool) {
    let [lost, left, alone] = [(); 3].map(|()| tempfile::tempdir().expect("a folder can be made"));
    let uninterrupted = Server::start(alone.path());
    let expected = submitted(&uninterrupted).await;

    use_database(left.path(), &use_postgresql(lost.path()));
    let objects = format!("file://{}", left.path().join("objects").display());
    let options = [&OPTIONS[..], &["--objects", &objects]].concat();
    let workers = if is_remote { "0" } else { "1" };
    let first = Server::start_with(
        lost.path(),
        &[&options[..], &["--workers", workers]].concat(),
    );
    let second = Server::without_workers(left.path(), &options);
    let worker = is_remote.then(|| RemoteWorker::start(lost.path(), &first.base, &[]));
    let id = submitted(&second).await;
    let fields = read_while_it_runs(&id, [&first, &second]).await;
    first.signal(Signal::SIGKILL);
    first.wait();
    drop(worker);
    drop(lost);

    let _other = RemoteWorker::start(left.path(), &second.base, &[]);
    let job = succeeded(&second, &id).await;
    assert_eq!(job["attempts"], 2, "{job}");
    succeeded(&uninterrupted, &expected).await;
    let whole = bits::of(&uninterrupted, &expected).await;
    assert_eq!(bits::of(&second, &id).await, whole);
    let path = format!("/v1/jobs/{id}/results/files/{FIELDS}");
    assert!(second.bytes_in_the_end(&path).await == fields);
    // The same once all results are in one object.
    let jobs = left.path().join("objects/jobs");
    second.job_when(&id, |_| files_below(&jobs) == 1).await;
    assert!(second.bytes_in_the_end(&path).await == fields);
    let archive = format!("/v1/jobs/{id}/results/archive");
    assert!(second.bytes_in_the_end(&archive).await.len() > fields.len() / 10);
    let results = left.path().join("fretwear.results");
    assert_eq!(files_below(&results), 0, "nothing is in a folder");
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_service_that_is_lost_with_its_workers_and_its_disk_costs_no_file() {
    lost_machine_costs_no_file(false).await;
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_service_that_is_lost_with_what_remote_workers_have_sent_costs_no_file() {
    lost_machine_costs_no_file(true).await;
}
