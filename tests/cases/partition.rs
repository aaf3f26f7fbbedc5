//! Requirement: a worker whose network is cut, so that no packet arrives and nobody is told, loses no job and records nothing twice: for
//! less than a lease it continues, and for longer another worker continues the job, with the same bits.

use std::path::Path;
use std::time::Duration;

use nix::sys::signal::Signal;
use reqwest::header::{AUTHORIZATION, HeaderMap, HeaderValue};
use serde_json::{Value, json};
use tests::{Network, RemoteWorker, Server, bits, fuzz_button_with_jump};

/// A token of users.
const TOKEN: &str = "0123456789-abcdefghij";
/// Lease of a worker that is cut off for longer. It is long against what a busy machine delays: a worker that is back keeps its next job.
const SHORT: [&str; 4] = ["--lease-s", "10", "--checkpoint-every-s", "0"];

/// A service that the network reaches, and the file with a token for its workers.
struct Reached {
    server: Server,
    token: String,
}

impl Reached {
    async fn start(folder: &Path, network: &Network) -> Self {
        let users = written(folder, "token", TOKEN);
        let listen = format!("{}:0", network.address);
        let options = [
            "--listen",
            &listen,
            "--allowed-host",
            &network.address,
            "--token-file",
            &users,
        ];
        let mut server = Server::without_workers(folder, &options);
        let mut headers = HeaderMap::new();
        let bearer = HeaderValue::from_str(&format!("Bearer {TOKEN}"));
        headers.insert(AUTHORIZATION, bearer.expect("a header"));
        let client = reqwest::Client::builder().default_headers(headers);
        server.client = client.build().expect("a client");
        let request = server
            .client
            .post(format!("{}/v1/worker-tokens", server.base));
        let made = request.json(&json!({"name": "network"})).send().await;
        let made: Value = made.expect("an answer").json().await.expect("JSON");
        let token = written(folder, "workers", made["token"].as_str().expect("a token"));
        Self { server, token }
    }

    /// Starts a worker on this machine, or in a network.
    fn worker(&self, folder: &Path, network: Option<&Network>, options: &[&str]) -> RemoteWorker {
        let options = [&["--token-file", &self.token], options].concat();
        let inside = network.map_or(Vec::new(), |network| network.inside().to_vec());
        RemoteWorker::start_by(&inside, folder, &self.server.base, &options)
    }

    async fn submitted(&self) -> String {
        let (status, job) = self.server.submit(fuzz_button_with_jump(4)).await;
        assert_eq!(status, 202, "{job}");
        job["id"].as_str().expect("an id").to_owned()
    }

    async fn ended(&self, id: &str) -> Value {
        let job = self
            .server
            .job_when(id, |job| job["finished_at"].is_string());
        job.await
    }
}

fn written(folder: &Path, name: &str, content: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, content).expect("a file can be written");
    path.to_str().expect("text").to_owned()
}

fn is_under_way(job: &Value) -> bool {
    job["progress"]["cycle"].as_u64() > Some(20)
}

#[tokio::test]
#[cfg_attr(not(has_network), ignore = "needs the program ip, and to be root")]
async fn a_worker_that_is_cut_off_loses_no_job_and_records_nothing_twice() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let network = Network::start();
    let reached = Reached::start(folder.path(), &network).await;
    let server = &reached.server;
    let undisturbed = reached.submitted().await;
    let here = reached.worker(folder.path(), None, &[]);
    assert_eq!(reached.ended(&undisturbed).await["status"], "succeeded");
    let expected = bits::of(server, &undisturbed).await;
    here.signal(Signal::SIGTERM);
    here.wait();

    // For less than a lease.
    let patient = reached.worker(folder.path(), Some(&network), &[]);
    let id = reached.submitted().await;
    server.job_when(&id, is_under_way).await;
    network.cut();
    tokio::time::sleep(Duration::from_secs(2)).await;
    network.mend();
    assert_solved(&reached, &id, 1, &expected).await;
    patient.signal(Signal::SIGTERM);
    patient.wait();

    // For longer: another one continues the job.
    let away = reached.worker(folder.path(), Some(&network), &SHORT);
    let id = reached.submitted().await;
    server.job_when(&id, is_under_way).await;
    network.cut();
    let here = reached.worker(folder.path(), None, &SHORT);
    assert_solved(&reached, &id, 2, &expected).await;
    here.signal(Signal::SIGTERM);
    here.wait();
    network.mend();
    let next = reached.submitted().await;
    assert_solved(&reached, &next, 1, &expected).await;
    assert_solved(&reached, &id, 2, &expected).await;
    drop(away);
}

/// Checks that a job succeeds in so many attempts, with these bits, and ends once.
async fn assert_solved(reached: &Reached, id: &str, attempts: u32, expected: &Value) {
    let job = reached.ended(id).await;
    let found = (&job["status"], &job["attempts"]);
    assert_eq!(found, (&json!("succeeded"), &json!(attempts)), "{job}");
    assert_eq!(&bits::of(&reached.server, id).await, expected);
    let ends = bits::events(&reached.server, id, "done").await;
    assert_eq!(ends.len(), 1, "{ends:?}");
}
