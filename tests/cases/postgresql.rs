//! Requirement: several services on a PostgreSQL database answer as one on a file does, with the same bits; each sees what the others
//! do, and one that ends loses no job.

use std::path::Path;
use std::time::{Duration, Instant};

use futures_util::stream::BoxStream;
use futures_util::{StreamExt, TryStreamExt};
use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::{
    Log, PostgresServer, RemoteWorker, Server, bits, fuzz_button_with_jump, use_postgresql,
};

/// A short lease, so that the jobs of a service that was killed are soon taken by another; not a measure of speed.
const LEASE: [&str; 2] = ["--lease-s", "2"];

/// Longest wait; not a measure of speed.
const PATIENCE: Duration = Duration::from_mins(4);

fn with_fields() -> Value {
    json!({
        "name": "fields", "system": {"kind": "sd_card"}, "cycles": 20, "accuracy": {"preset": "draft"},
        "labels": {"lot": "7"}, "output": {"fields": true, "snapshots_at_cycles": [0, 20]}
    })
}

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

/// Without what differs between two runs: times, costs, the id.
fn comparable(mut job: Value) -> Value {
    for member in ["id", "created_at", "started_at", "finished_at", "links"] {
        job[member] = Value::Null;
    }
    job["progress"]["updated_at"] = Value::Null;
    job["progress"]["elapsed_s"] = Value::Null;
    if let Some(summary) = job["summary"].as_object_mut() {
        summary.remove("cost");
    }
    job
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_job_is_answered_as_by_a_service_on_a_file() {
    let mut found = Vec::new();
    for is_file in [true, false] {
        let folder = tempfile::tempdir().expect("a folder can be made");
        if !is_file {
            use_postgresql(folder.path());
        }
        let server = Server::start(folder.path());
        let id = submitted(&server, with_fields().to_string()).await;
        let job = ended(&server, &id).await;
        assert_eq!(job["status"], "succeeded", "{job}");
        // How many cycles share an event depends on the time that they take.
        let events = bits::events(&server, &id, "cycle").await;
        let last_cycle = events.last().expect("an event")["cycle"].clone();
        let (_, list) = server
            .get("/v1/jobs?label=lot:7&text=FIEL&sort=wear&view=short")
            .await;
        let (_, labels) = server.get("/v1/labels").await;
        assert_eq!(list["jobs"].as_array().map(Vec::len), Some(1), "{list}");
        let figures = list["jobs"][0]["key_figures"].clone();
        found.push((
            comparable(job),
            bits::of(&server, &id).await,
            (last_cycle, figures, labels),
        ));
        assert_eq!(server.get("/readyz").await.0, 200);
        assert_eq!(server.post(&format!("/v1/jobs/{id}/cancel")).await.0, 202);
        let deleted = server
            .client
            .delete(format!("{}/v1/jobs/{id}", server.base))
            .send()
            .await;
        assert_eq!(deleted.expect("an answer").status(), 204);
        assert_eq!(server.get(&format!("/v1/jobs/{id}")).await.0, 404);
    }
    assert_eq!(found[0], found[1]);
}

/// The stream of all changes of a service, as text so far.
struct Feed {
    parts: BoxStream<'static, reqwest::Result<Vec<u8>>>,
    text: String,
}

impl Feed {
    async fn of(server: &Server) -> Self {
        let url = format!("{}/v1/events", server.base);
        let answer = server.client.get(url).send().await.expect("a stream");
        let parts = answer.bytes_stream().map_ok(|part| part.to_vec()).boxed();
        let mut feed = Self {
            parts,
            text: String::new(),
        };
        feed.tells(|event| event.contains("event: start")).await;
        feed
    }

    /// Waits for an event.
    async fn tells(&mut self, is_met: impl Fn(&str) -> bool) {
        while !self.text.split("\n\n").any(&is_met) {
            let part = self.parts.next().await.expect("it goes on");
            let part = part.expect("it goes on");
            self.text.push_str(&String::from_utf8_lossy(&part));
        }
    }
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn services_see_what_the_others_do() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    use_postgresql(folder.path());
    let objects = format!("file://{}", folder.path().join("objects").display());
    let options = ["--objects", &objects];
    let asked = Server::without_workers(folder.path(), &options);
    let solving = Server::start_with(folder.path(), &options);
    let mut feed = Feed::of(&asked).await;
    let id = submitted(&asked, with_fields().to_string()).await;
    feed.tells(|event| event.contains(&id) && event.contains("\"status\":\"succeeded\""))
        .await;
    // One of the two moves the results; both read them.
    asked
        .job_when(&id, |_| {
            std::fs::read_dir(folder.path().join("objects/jobs")).is_ok()
        })
        .await;
    assert_eq!(bits::of(&asked, &id).await, bits::of(&solving, &id).await);
    bits::events(&asked, &id, "done").await;

    let long = submitted(&solving, fuzz_button_with_jump(1)).await;
    asked
        .job_when(&long, |job| job["status"] == "running")
        .await;
    assert_eq!(asked.post(&format!("/v1/jobs/{long}/cancel")).await.0, 202);
    assert_eq!(ended(&asked, &long).await["status"], "cancelled");
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_service_that_is_killed_loses_no_job() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    use_postgresql(folder.path());
    let options = [&LEASE[..], &["--checkpoint-every-s", "0"]].concat();
    let alone = tempfile::tempdir().expect("a folder can be made");
    let uninterrupted = Server::start(alone.path());
    let spec = fuzz_button_with_jump(4);
    let expected = submitted(&uninterrupted, spec.clone()).await;

    let killed = Server::start_with(folder.path(), &options);
    let id = submitted(&killed, spec).await;
    let under_way = |job: &Value| job["progress"]["cycle"].as_u64() > Some(20);
    killed.job_when(&id, under_way).await;
    killed.signal(Signal::SIGKILL);
    killed.wait();
    let other = Server::start_with(folder.path(), &options);
    let job = ended(&other, &id).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    let attempts = bits::events(&other, &id, "attempt").await;
    let from = attempts.last().expect("two")["from_cycle"].as_u64();
    assert!(attempts.len() == 2 && from > Some(0), "{attempts:?}");
    ended(&uninterrupted, &expected).await;
    assert_eq!(
        bits::of(&other, &id).await,
        bits::of(&uninterrupted, &expected).await
    );
}

/// A worker of one service, which ends, while another one serves at the same address.
#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_remote_worker_goes_on_with_another_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    use_postgresql(folder.path());
    let first = Server::without_workers(folder.path(), &[]);
    let id = submitted(&first, fuzz_button_with_jump(2)).await;
    let _worker = RemoteWorker::start(folder.path(), &first.base, &[]);
    let under_way = |job: &Value| job["progress"]["cycle"].as_u64() > Some(20);
    first.job_when(&id, under_way).await;
    let address = first.base.trim_start_matches("http://").to_owned();
    first.signal(Signal::SIGKILL);
    first.wait();
    let second = Server::without_workers(folder.path(), &["--listen", &address]);
    let job = ended(&second, &id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    bits::events(&second, &id, "done").await;
}

/// Neither the log nor an error shows the password of a database.
#[test]
fn passwords_are_not_shown() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder: &Path = folder.path();
    let url = "postgres://user:a-secret@127.0.0.1:1/none";
    let ran = tests::fretwear(folder, &["serve", "--database", url]);
    assert_ne!(ran.code, Some(0));
    for text in [&ran.stdout, &ran.stderr] {
        assert!(!text.contains("a-secret"), "{text}");
    }
    let backup = tests::fretwear(folder, &["backup", "--database", url, "copy"]);
    assert!(backup.stderr.contains("pg_dump"), "{}", backup.stderr);
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_worker_of_one_service_is_listed_and_drained_by_another() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    use_postgresql(folder.path());
    let [first, second] = [(); 2].map(|()| Server::without_workers(folder.path(), &[]));
    let worker = RemoteWorker::start(folder.path(), &first.base, &[]);
    let listed = async {
        loop {
            let (_, list) = second.get("/v1/workers").await;
            if let Some(id) = list["remote"][0]["id"].as_str() {
                return format!("/v1/workers/{id}/drain");
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    let path = tokio::time::timeout(PATIENCE, listed).await;
    let path = path.expect("it is listed in time");
    let (status, drained) = second.post(&path).await;
    assert_eq!(
        (status, &drained["is_draining"]),
        (202, &json!(true)),
        "{drained}"
    );
    assert_eq!(worker.wait(), Some(0));
    let id = submitted(&first, with_fields().to_string()).await;
    let _other = RemoteWorker::start(folder.path(), &first.base, &[]);
    assert_eq!(ended(&second, &id).await["status"], "succeeded");
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_service_warns_where_a_failover_would_lose_commits() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let primary = PostgresServer::start(&["max_connections=50"]);
    tests::use_database(folder.path(), &primary.new_database());
    let _standby = primary.standby();
    let log = folder.path().join("log");
    let warns = || {
        let options = ["--workers", "0"];
        let started = Server::start_logging(folder.path(), &options, &[], &Log::File(log.clone()));
        started.expect("it serves");
        let said = std::fs::read_to_string(&log).expect("a log");
        said.contains("can lose what it has acknowledged")
    };
    assert!(!warns(), "every commit is confirmed by the standby");
    primary.answer("ALTER SYSTEM RESET synchronous_standby_names");
    primary.answer("SELECT pg_reload_conf()");
    let began = Instant::now();
    while !primary
        .answer("SHOW synchronous_standby_names")
        .trim()
        .is_empty()
    {
        assert!(began.elapsed() < PATIENCE, "the setting is read");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    assert!(warns(), "the standby confirms none");
}
