//! Requirement: remote workers solve the jobs of a service with the same bits as its own workers, and neither a worker nor a
//! service that ends loses a job, an attempt of a job that was given back, or work since the last checkpoint.

use std::path::Path;

use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::{RemoteWorker, Server, bits, fretwear, fuzz_button_with_jump};

/// A token of users.
const TOKEN: &str = "0123456789-abcdefghij";
/// A short lease, so that the job of a worker that was killed is soon given to another; not a measure of speed.
const LEASE: [&str; 2] = ["--lease-s", "2"];

async fn submitted(server: &Server, spec: impl Into<reqwest::Body>) -> String {
    let (status, job) = server.submit(spec).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("an id").to_owned()
}

async fn ended(server: &Server, id: &str) -> Value {
    server
        .job_when(id, |job| job["finished_at"].is_string())
        .await
}

fn is_under_way(job: &Value) -> bool {
    job["progress"]["cycle"].as_u64() > Some(20)
}

fn with_fields() -> String {
    json!({
        "system": {"kind": "sd_card"}, "cycles": 40, "accuracy": {"preset": "draft"},
        "output": {"fields": true, "snapshots_at_cycles": [0, 20, 40]}
    })
    .to_string()
}

#[tokio::test]
async fn jobs_have_the_bits_of_the_services_own_workers_also_if_a_worker_is_killed() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let own = Server::start(folder.path());
    let specs = [with_fields(), fuzz_button_with_jump(4)];
    let mut expected = Vec::new();
    for spec in &specs {
        let id = submitted(&own, spec.clone()).await;
        ended(&own, &id).await;
        expected.push(bits::of(&own, &id).await);
    }
    drop(own);

    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let [fields, long] = [&specs[0], &specs[1]];
    let ids = [
        submitted(&server, fields.clone()).await,
        submitted(&server, long.clone()).await,
    ];
    let options = [&LEASE[..], &["--checkpoint-every-s", "0"]].concat();
    let killed = RemoteWorker::start(folder.path(), &server.base, &options);
    server.job_when(&ids[1], is_under_way).await;
    killed.signal(Signal::SIGKILL);
    killed.wait();
    let _other = RemoteWorker::start(folder.path(), &server.base, &options);
    let job = ended(&server, &ids[1]).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    // More than two where the machine is so busy that a worker does not renew its lease in time.
    assert!(job["attempts"].as_u64() >= Some(2), "{job}");
    for (id, expected) in ids.iter().zip(&expected) {
        assert_eq!(&bits::of(&server, id).await, expected);
        bits::events(&server, id, "done").await;
    }
    let attempts = bits::events(&server, &ids[1], "attempt").await;
    let from = attempts.last().expect("two")["from_cycle"].as_u64();
    assert!(
        from > Some(0),
        "it continues from a checkpoint: {attempts:?}"
    );
}

#[tokio::test]
async fn a_worker_that_is_terminated_gives_its_job_back_without_an_attempt_lost() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let id = submitted(&server, fuzz_button_with_jump(1)).await;
    let worker = RemoteWorker::start(folder.path(), &server.base, &[]);
    server.job_when(&id, is_under_way).await;
    worker.signal(Signal::SIGTERM);
    assert_eq!(worker.wait(), Some(0));
    let job = server.job_when(&id, |job| job["status"] == "queued").await;
    assert_eq!(job["attempts"], 0, "{job}");
    let left = std::fs::read_dir(folder.path())
        .expect("a folder")
        .flatten();
    let left: Vec<_> = left
        .flat_map(|entry| entry.file_name().into_string())
        .collect();
    assert!(!left.iter().any(|name| name.contains("work")), "{left:?}");
}

#[tokio::test]
async fn a_solve_continues_while_its_service_is_restarted() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let id = submitted(&server, fuzz_button_with_jump(2)).await;
    let _worker = RemoteWorker::start(folder.path(), &server.base, &[]);
    server.job_when(&id, is_under_way).await;
    let address = server.base.trim_start_matches("http://").to_owned();
    server.signal(Signal::SIGKILL);
    assert_eq!(server.wait(), None);
    let server = Server::without_workers(folder.path(), &["--listen", &address]);
    let job = ended(&server, &id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    bits::events(&server, &id, "done").await;
}

#[tokio::test]
async fn a_cancel_request_reaches_a_remote_solve() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let id = submitted(&server, fuzz_button_with_jump(1)).await;
    let _worker = RemoteWorker::start(folder.path(), &server.base, &[]);
    server.job_when(&id, is_under_way).await;
    server.post(&format!("/v1/jobs/{id}/cancel")).await;
    assert_eq!(ended(&server, &id).await["status"], "cancelled");
}

#[tokio::test]
async fn a_worker_that_is_drained_solves_what_it_has_and_ends() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let id = submitted(&server, fuzz_button_with_jump(4)).await;
    let worker = RemoteWorker::start(folder.path(), &server.base, &[]);
    server.job_when(&id, is_under_way).await;
    let waiting = submitted(&server, with_fields()).await;
    let (_, list) = server.get("/v1/workers").await;
    let process = list["remote"][0]["id"].as_str().expect("a worker");
    let path = format!("/v1/workers/{process}/drain");
    let (status, drained) = server.post(&path).await;
    assert_eq!(status, 202, "{drained}");
    assert_eq!(worker.wait(), Some(0));
    let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    let (_, job) = server.get(&format!("/v1/jobs/{waiting}")).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("queued"), &json!(0)),
        "{job}"
    );
}

#[tokio::test]
async fn a_worker_that_is_to_end_when_nothing_waits_solves_what_waits_first() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let mut ids = Vec::new();
    for _ in 0..3 {
        ids.push(submitted(&server, with_fields()).await);
    }
    let worker = RemoteWorker::start(folder.path(), &server.base, &["--until-idle"]);
    assert_eq!(worker.wait(), Some(0));
    for id in ids {
        let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
        assert_eq!(job["status"], "succeeded", "{job}");
    }
}

/// Writes a file; returns its path.
fn written(folder: &Path, name: &str, content: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, content).expect("a file can be written");
    path.to_str().expect("text").to_owned()
}

#[tokio::test]
async fn a_token_of_workers_reaches_their_paths_only_until_it_is_revoked() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let users = written(folder.path(), "token", TOKEN);
    let server = Server::without_workers(folder.path(), &["--token-file", &users]);
    let url = ["--server", &server.base];
    let as_user = |arguments: &[&str]| {
        let arguments = [arguments, &url, &["--token-file", &users]].concat();
        fretwear(folder.path(), &arguments)
    };
    let made = as_user(&["worker-token", "create", "cluster", "--out", "workers"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let token = std::fs::read_to_string(folder.path().join("workers")).expect("a token");
    let status = async |method: &str, path: &str, token: &str| {
        let method = reqwest::Method::from_bytes(method.as_bytes()).expect("a method");
        let request = server
            .client
            .request(method, format!("{}{path}", server.base));
        let answer = request.bearer_auth(token.trim()).send().await;
        answer.expect("the service answers").status().as_u16()
    };
    assert_eq!(status("GET", "/v1/worker/demand", &token).await, 200);
    assert_eq!(
        status("GET", "/v1/worker/demand", TOKEN).await,
        401,
        "not for users"
    );
    for path in ["/v1/jobs", "/v1/worker-tokens", "/metrics", "/v1/worker"] {
        assert_eq!(status("GET", path, &token).await, 401, "{path}");
    }
    let spec = written(folder.path(), "spec.json", &with_fields());
    assert_eq!(as_user(&["submit", &spec]).code, Some(0));
    let token_file = folder.path().join("workers");
    let token_file = token_file.to_str().expect("text");
    let options = ["--until-idle", "--token-file", token_file];
    let worker = RemoteWorker::start(folder.path(), &server.base, &options);
    assert_eq!(worker.wait(), Some(0));
    let without = RemoteWorker::start(folder.path(), &server.base, &["--until-idle"]);
    assert_eq!(without.wait(), Some(1));

    let list = as_user(&["worker-token", "list"]);
    let id = made.stdout.split_whitespace().next().expect("an id");
    assert!(
        list.stdout.contains(id) && list.stdout.contains("cluster"),
        "{}",
        list.stdout
    );
    assert_eq!(as_user(&["worker-token", "revoke", id]).code, Some(0));
    assert_eq!(status("GET", "/v1/worker/demand", &token).await, 401);
    let refused = RemoteWorker::start(folder.path(), &server.base, &options);
    assert_eq!(refused.wait(), Some(1));
}
