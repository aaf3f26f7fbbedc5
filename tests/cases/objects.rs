//! Requirement: with `--objects`, the results of each succeeded job are moved into one object, and everything is answered as before;
//! the database keeps less than 15 kB of a job. While the store of objects does not answer, jobs are solved and their results are read all the
//! same.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use serde_json::Value;
use tests::{
    RemoteWorker, S3, Server, bits, database, fretwear, fretwear_with, fuzz_button_with_jump,
};

const SPEC: &str = r#"{
  "name": "kept elsewhere", "labels": {"lot": "7"},
  "system": {"kind": "cylinder_on_flat"},
  "cycles": 20,
  "output": {"fields": true, "snapshots_at_cycles": [20]}
}"#;
/// Largest part of the database that belongs to a job, bytes.
const MOST_BYTES: i64 = 15_000;

/// Timeout of a wait; no measure of speed.
const PATIENCE: Duration = Duration::from_mins(4);

/// Submits a job and waits for its end; returns its id.
async fn solved(server: &Server, spec: &str) -> String {
    let (status, job) = server.submit(spec.to_owned()).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("an id").to_owned();
    let ended = |job: &Value| job["finished_at"].is_string();
    let job = server.job_when(&id, ended).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    id
}

/// Waits until no results are to be moved, and so many were.
async fn moved(server: &Server, jobs: u32) {
    let lines = [
        format!("fretwear_results_moved_total {jobs}"),
        "fretwear_results_to_move 0".to_owned(),
    ];
    let start = Instant::now();
    loop {
        let metrics = server.bytes_in_the_end("/metrics").await;
        let metrics = String::from_utf8(metrics).expect("text");
        if lines
            .iter()
            .all(|line| metrics.lines().any(|found| found == line))
        {
            return;
        }
        assert!(start.elapsed() < PATIENCE, "results are moved: {metrics}");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

/// Everything that can be read of a job, by its path.
async fn everything(server: &Server, id: &str) -> Vec<(String, Vec<u8>)> {
    let job = format!("/v1/jobs/{id}");
    let (_, manifest) = server.get(&format!("{job}/results")).await;
    let files = manifest["files"].as_array().expect("files");
    let names = files.iter().filter_map(|file| file["name"].as_str());
    let mut paths: Vec<String> = names
        .map(|name| format!("{job}/results/files/{name}"))
        .collect();
    paths.extend([
        job.clone(),
        format!("{job}/events"),
        format!("{job}/results"),
        format!("/v1/histories?jobs={id}&columns=cycle,receptacle_max_depth_mm"),
        "/v1/jobs?label=lot:7".to_owned(),
    ]);
    for part in ["wear-history", "profile?cycle=20", "pressure", "loop"] {
        paths.push(format!("{job}/results/{part}"));
    }
    let mut read = Vec::new();
    for path in paths {
        let bytes = server.bytes_in_the_end(&path).await;
        read.push((path, bytes));
    }
    read
}

#[tokio::test]
async fn results_are_read_from_their_objects_as_from_the_database() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let id = solved(&server, SPEC).await;
    let before = everything(&server, &id).await;
    drop(server);

    let objects = format!("file://{}", folder.path().join("objects").display());
    let options = ["--objects", &objects];
    let server = Server::start_with(folder.path(), &options);
    moved(&server, 1).await;
    for ((path, before), (_, now)) in before.iter().zip(everything(&server, &id).await) {
        assert!(*before == now, "{path}: {}", String::from_utf8_lossy(&now));
    }
    let fields = format!("{}/v1/jobs/{id}/results/files/fields-20.vtu", server.base);
    let part = server.client.get(fields).header("Range", "bytes=10-19");
    let part = part.send().await.expect("an answer");
    assert_eq!(part.status(), 206);
    let whole = before
        .iter()
        .find(|(path, _)| path.ends_with("/fields-20.vtu"));
    let whole = &whole.expect("fields").1;
    assert_eq!(part.bytes().await.expect("a part"), whole[10..20]);
    let archive = format!("/v1/jobs/{id}/results/archive");
    assert!(server.bytes_in_the_end(&archive).await.len() > whole.len() / 10);
    let verified = fretwear(folder.path(), &["verify", "--objects", &objects]);
    assert_eq!(verified.code, Some(0), "{}", verified.stderr);
    let copied = fretwear(folder.path(), &["backup", "copy"]);
    assert_eq!(copied.code, Some(0), "{}", copied.stderr);
    drop(server);

    // A copy reads the objects, and removes none with its jobs: the original names them, too.
    let copy = Server::start_with(&folder.path().join("copy"), &options);
    let url = format!("{}/v1/jobs/{id}", copy.base);
    let document = format!("/v1/jobs/{id}");
    let before = before.iter().find(|(path, _)| *path == document);
    let before = &before.expect("the job").1;
    assert_eq!(copy.bytes_in_the_end(&document).await, *before);
    let deleted = copy.client.delete(url).send().await.expect("an answer");
    assert_eq!(deleted.status(), 204);
    solved(&copy, SPEC).await;
    moved(&copy, 1).await;
    drop(copy);
    let verified = fretwear(folder.path(), &["verify", "--objects", &objects]);
    assert_eq!(verified.code, Some(0), "{}", verified.stderr);

    let refused = fretwear(folder.path(), &["serve", "--listen", "127.0.0.1:0"]);
    assert_eq!(refused.code, Some(1));
    assert!(refused.stderr.contains("--objects"), "{}", refused.stderr);
}

#[tokio::test]
async fn the_database_keeps_little_of_a_job_whose_results_were_moved() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let objects = format!("file://{}", folder.path().join("objects").display());
    let server = Server::start_with(folder.path(), &["--objects", &objects]);
    let empty = pages(folder.path()).await;
    // So many that one page more is a small part of the limit.
    let jobs = 20;
    for _ in 0..jobs {
        solved(&server, r#"{"system":{"kind":"sd_card"}}"#).await;
    }
    moved(&server, jobs).await;
    let bytes = (pages(folder.path()).await - empty) / i64::from(jobs);
    println!("{bytes} bytes of the database a job");
    assert!(bytes < MOST_BYTES, "{bytes} bytes a job");
}

/// Bytes of the pages in use.
async fn pages(folder: &std::path::Path) -> i64 {
    database::number(
        folder,
        "SELECT (page_count - freelist_count) * page_size FROM pragma_page_count, pragma_freelist_count, pragma_page_size",
    )
    .await
}

#[tokio::test]
#[cfg_attr(
    not(has_moto),
    ignore = "needs the Python package moto with its server"
)]
async fn jobs_are_solved_and_read_while_the_bucket_does_not_answer() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut bucket = S3::start().await;
    let absent = [
        "serve",
        "--listen",
        "127.0.0.1:0",
        "--objects",
        "s3://absent/fretwear",
    ];
    let refused = fretwear_with(folder.path(), &absent, &bucket.environment());
    assert!(
        refused.code == Some(1) && refused.stderr.contains("s3://absent/fretwear: "),
        "{}",
        refused.stderr
    );
    let address = bucket.address();
    let options = ["--objects", &address];
    let server = Server::start_in(folder.path(), &options, &bucket.environment());
    let first = solved(&server, SPEC).await;
    moved(&server, 1).await;
    assert_eq!(bucket.objects().await, 1);
    let history = |id: &str| format!("/v1/jobs/{id}/results/wear-history");
    assert_eq!(server.get(&history(&first)).await.0, 200);

    bucket.end();
    let second = solved(&server, SPEC).await;
    assert_eq!(server.get(&history(&second)).await.0, 200);
    let (status, problem) = server.get(&history(&first)).await;
    assert_eq!(status, 503, "{problem}");
    assert_eq!(problem["type"], "/problems/results-unreachable");
    assert_eq!(server.get(&format!("/v1/jobs/{first}")).await.0, 200);

    let bucket = bucket.restart().await;
    moved(&server, 2).await;
    assert_eq!(bucket.objects().await, 1, "the new one is empty at first");
    assert_eq!(server.get(&history(&second)).await.0, 200);
    // An object is not known to be missing in a bucket without the mark.
    let (status, problem) = server.get(&history(&first)).await;
    assert_eq!(status, 503, "{problem}");
    bucket.mark().await;
    let (status, problem) = server.get(&history(&first)).await;
    assert_eq!(status, 500, "{problem}");
    assert_eq!(problem["type"], "/problems/result-damaged");
    for id in [&first, &second] {
        let url = format!("{}/v1/jobs/{id}", server.base);
        let deleted = server.client.delete(url).send().await.expect("an answer");
        assert_eq!(deleted.status(), 204);
    }
    let start = Instant::now();
    while bucket.objects().await > 0 {
        assert!(start.elapsed() < PATIENCE, "objects are removed");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

/// Objects with checkpoints.
fn checkpoints(objects: &Path) -> Vec<PathBuf> {
    let jobs = std::fs::read_dir(objects.join("checkpoints"));
    let jobs = jobs.into_iter().flatten().flatten();
    let of_jobs = jobs.flat_map(|job| std::fs::read_dir(job.path()));
    of_jobs
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .collect()
}

#[tokio::test]
async fn a_job_resumes_from_its_checkpoint_once_the_store_of_objects_answers() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let spec = fuzz_button_with_jump(4);
    let own = Server::start(folder.path());
    let expected = bits::of(&own, &solved(&own, &spec).await).await;
    drop(own);

    let folder = tempfile::tempdir().expect("a folder can be made");
    let (objects, away) = (folder.path().join("objects"), folder.path().join("away"));
    let address = format!("file://{}", objects.display());
    let server = Server::without_workers(folder.path(), &["--objects", &address]);
    let (status, job) = server.submit(spec).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("an id");
    let options = ["--lease-s", "2", "--checkpoint-every-s", "0"];
    let killed = RemoteWorker::start(folder.path(), &server.base, &options);
    let is_under_way = |job: &Value| job["progress"]["cycle"].as_u64() > Some(20);
    server.job_when(id, is_under_way).await;
    // A checkpoint arrives after the progress that it belongs to.
    let start = Instant::now();
    while checkpoints(&objects).is_empty() {
        assert!(start.elapsed() < PATIENCE, "one is sent");
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    killed.signal(Signal::SIGKILL);
    killed.wait();
    server.job_when(id, |job| job["status"] == "queued").await;
    assert!(!checkpoints(&objects).is_empty());

    std::fs::rename(&objects, &away).expect("renamed");
    std::fs::write(&objects, "").expect("a file in its place");
    let _other = RemoteWorker::start(folder.path(), &server.base, &options);
    let waiting = server
        .job_when(id, |job| job["attempts"].as_u64() >= Some(2))
        .await;
    assert!(waiting["finished_at"].is_null(), "{waiting}");
    std::fs::remove_file(&objects).expect("removed");
    std::fs::rename(&away, &objects).expect("renamed back");
    let job = server
        .job_when(id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["status"], "succeeded", "{job}");
    let attempts = bits::events(&server, id, "attempt").await;
    let from: Vec<_> = attempts.iter().map(|event| &event["from_cycle"]).collect();
    assert!(
        from.len() >= 2 && from[1].as_u64() > Some(0),
        "{attempts:?}"
    );
    assert_eq!(bits::of(&server, id).await, expected);
    // The service may have written one that no update has named, because its worker was killed meanwhile: that one is noted.
    database::age_unnamed_objects(folder.path()).await;
    let start = Instant::now();
    while !checkpoints(&objects).is_empty() {
        assert!(
            start.elapsed() < PATIENCE,
            "they are removed: {:?}",
            checkpoints(&objects)
        );
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}
