//! Requirement: a job is submitted, watched, fetched, cancelled and queued again by the client commands of the same binary, with
//! the exit codes of its help; a stream that breaks off is resumed, and Ctrl-C leaves the job running.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU16, Ordering};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;
use tests::{Ran, Server, binary, fretwear};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;

const SHORT: &str =
    r#"{"system":{"kind":"cylinder_on_flat"},"cycles":20,"accuracy":{"preset":"draft"}}"#;
const LONG: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":1000000,
    "accuracy":{"preset":"draft","overrides":{"cycle_jump":1}}}"#;

/// Runs a client command against a service.
async fn client(folder: &Path, server: &str, arguments: &[&str]) -> Ran {
    let (folder, server) = (folder.to_owned(), server.to_owned());
    let arguments: Vec<String> = arguments
        .iter()
        .map(|&argument| argument.to_owned())
        .collect();
    let run = move || {
        let mut all: Vec<&str> = arguments.iter().map(String::as_str).collect();
        all.extend(["--server", &server]);
        fretwear(&folder, &all)
    };
    tokio::task::spawn_blocking(run).await.expect("it ran")
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("an entry").file_name();
    entries
        .map(|entry| name(entry).into_string().expect("text"))
        .collect()
}

#[tokio::test]
async fn a_job_is_submitted_followed_and_fetched() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let server = Server::start(folder);
    std::fs::write(folder.join("spec.json"), SHORT).expect("written");
    let submitted = client(folder, &server.base, &["submit", "spec.json", "--key", "a"]).await;
    assert_eq!(submitted.code, Some(0), "{}", submitted.stderr);
    let again = client(folder, &server.base, &["submit", "spec.json", "--key", "a"]).await;
    assert_eq!(
        again.stdout, submitted.stdout,
        "the same key is the same job"
    );
    let id = submitted.stdout.trim();
    let watched = client(folder, &server.base, &["watch", id, "--json"]).await;
    assert_eq!(watched.code, Some(0), "{}", watched.stderr);
    let summary: Value = serde_json::from_str(&watched.stdout).expect("the summary");
    assert_eq!(summary["cycles_done"], 20);

    let sent = client(folder, &server.base, &["spec", id]).await;
    assert_eq!((sent.code, sent.stdout.trim_end()), (Some(0), SHORT));

    let fetched = client(folder, &server.base, &["fetch", id, "--out", "fetched"]).await;
    assert_eq!(fetched.code, Some(0), "{}", fetched.stderr);
    let solved = fretwear(folder, &["solve", "spec.json", "--out", "solved"]);
    assert_eq!(solved.code, Some(0));
    let (fetched, solved) = (folder.join("fetched"), folder.join("solved"));
    for name in names(&fetched)
        .into_iter()
        .filter(|name| name != "summary.json")
    {
        let same =
            std::fs::read(fetched.join(&name)).ok() == std::fs::read(solved.join(&name)).ok();
        assert!(same, "{name}");
    }
    // Only what differs is received again.
    let history = fetched.join("wear-history.csv");
    std::fs::write(&history, "cycle\n").expect("written");
    let again = client(folder, &server.base, &["fetch", id, "--out", "fetched"]).await;
    assert!(
        again.stderr.contains("received files: 1 "),
        "{}",
        again.stderr
    );
    assert!(std::fs::read(&history).expect("a file").len() > 100);

    let listed = client(
        folder,
        &server.base,
        &["list", "--status", "succeeded", "--json"],
    )
    .await;
    let listed: Value = serde_json::from_str(&listed.stdout).expect("JSON");
    assert_eq!(
        (listed.as_array().map(Vec::len), &listed[0]["id"]),
        (Some(1), &id.into())
    );
}

#[tokio::test]
async fn exit_codes_tell_how_it_ended() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let server = Server::start(folder);
    std::fs::write(folder.join("long.json"), LONG).expect("written");
    std::fs::write(folder.join("wrong.json"), LONG.replace("1000000", "0")).expect("written");
    let run = async |arguments: &[&str]| client(folder, &server.base, arguments).await;
    let wrong = run(&["submit", "wrong.json"]).await;
    assert_eq!(wrong.code, Some(2));
    assert!(
        wrong
            .stderr
            .contains("/cycles: 0 is outside 1 to 1000000000"),
        "{}",
        wrong.stderr
    );
    let unknown = "00000000-0000-7000-8000-000000000000";
    assert_eq!(run(&["watch", unknown]).await.code, Some(1));
    let id = run(&["submit", "long.json"]).await.stdout.trim().to_owned();
    server.job_when(&id, |job| job["status"] == "running").await;
    let some = run(&["cancel", unknown, &id]).await;
    assert_eq!(some.code, Some(1), "one of them is unknown");
    assert!(some.stdout.starts_with(&id), "{}", some.stdout);
    assert_eq!(run(&["watch", &id]).await.code, Some(3));
    assert_eq!(run(&["retry", &id]).await.code, Some(0));
    server.job_when(&id, |job| job["status"] == "running").await;
    assert_eq!(run(&["cancel", &id]).await.code, Some(0));
    let nowhere = client(folder, "http://127.0.0.1:1", &["list"]).await;
    assert_eq!(nowhere.code, Some(4), "{}", nowhere.stderr);
    let no_address = client(folder, "localhost", &["list"]).await;
    assert_eq!(no_address.code, Some(1), "{}", no_address.stderr);
    let completions = fretwear(folder, &["completions", "bash"]);
    assert!(
        completions.stdout.contains("retry"),
        "{}",
        completions.stdout
    );
}

#[tokio::test]
async fn an_interrupted_watch_leaves_the_job_running() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (_, job) = server.submit(LONG).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let watch = Command::new(binary())
        .args(["watch", &id, "--server", &server.base])
        .stderr(Stdio::piped())
        .spawn();
    let mut watch = watch.expect("it can be started");
    let process = Pid::from_raw(i32::try_from(watch.id()).expect("small"));
    let running = |job: &Value| job["status"] == "running";
    server.job_when(&id, running).await;
    // An open stream shows that the process follows the job.
    while !has_open_stream(&server).await {
        assert!(matches!(watch.try_wait(), Ok(None)), "it has ended early");
    }
    kill(process, Signal::SIGINT).expect("it is there");
    let ended = tokio::task::spawn_blocking(|| watch.wait_with_output()).await;
    let ended = ended.expect("it ran").expect("it ended");
    assert_eq!(ended.status.code(), Some(130));
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(said.contains(&format!("fretwear watch {id}")), "{said}");
    let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
    assert_eq!(job["status"], "running", "{job}");
}

async fn has_open_stream(server: &Server) -> bool {
    let (_, metrics) = server.get("/metrics").await;
    let metrics = metrics.as_str().expect("text");
    metrics
        .lines()
        .any(|line| line == "fretwear_streams_open 1")
}

/// Forwards connections at an address that stays to the port of the present service; all break when the service changes.
struct Proxy {
    base: String,
    port: Arc<AtomicU16>,
}

impl Proxy {
    async fn to(server: &Server) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let base = format!("http://{}", listener.local_addr().expect("an address"));
        let port = Arc::new(AtomicU16::new(port(server)));
        let target = Arc::clone(&port);
        tokio::spawn(async move {
            let mut forwarded = JoinSet::new();
            while let Ok((mut client, _)) = listener.accept().await {
                let port = target.load(Ordering::Relaxed);
                forwarded.spawn(async move {
                    if let Ok(mut server) = TcpStream::connect(("127.0.0.1", port)).await {
                        // The connection ends with either side.
                        let _ = tokio::io::copy_bidirectional(&mut client, &mut server).await;
                    }
                });
            }
        });
        Self { base, port }
    }
}

fn port(server: &Server) -> u16 {
    let (_, port) = server.base.rsplit_once(':').expect("an address");
    port.parse().expect("a port")
}

#[tokio::test]
async fn a_watch_survives_a_crash_of_the_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let options = ["--checkpoint-every-s", "0"];
    let server = Server::start_with(folder.path(), &options);
    let proxy = Proxy::to(&server).await;
    let (_, job) = server.submit(LONG.replace("1000000", "400")).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let (watched, base, watched_id) = (folder.path().to_owned(), proxy.base.clone(), id.clone());
    let watch =
        tokio::spawn(
            async move { client(&watched, &base, &["watch", &watched_id, "--json"]).await },
        );
    let cycle = |job: &Value| job["progress"]["cycle"].as_u64();
    server.job_when(&id, |job| cycle(job) >= Some(20)).await;
    server.signal(Signal::SIGKILL);
    server.wait();
    let server = Server::start_with(folder.path(), &options);
    proxy.port.store(port(&server), Ordering::Relaxed);
    let watched = watch.await.expect("it ran");
    assert_eq!(watched.code, Some(0), "{}", watched.stderr);
    let summary: Value = serde_json::from_str(&watched.stdout).expect("the summary");
    assert_eq!(summary["cycles_done"], 400);
    assert!(
        watched.stderr.contains("trying again"),
        "{}",
        watched.stderr
    );
    let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
    assert_eq!(job["summary"], summary);
}

#[tokio::test]
async fn a_service_with_a_token_is_used_with_it() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let token = folder.path().join("token");
    std::fs::write(&token, "a-token-of-16-characters\n").expect("written");
    let token = token.to_str().expect("text");
    let server = Server::start_with(folder.path(), &["--token-file", token]);
    let without = client(folder.path(), &server.base, &["list"]).await;
    assert_eq!(without.code, Some(1));
    assert!(
        without
            .stderr
            .contains("the access token is missing or wrong"),
        "{}",
        without.stderr
    );
    let with = client(
        folder.path(),
        &server.base,
        &["list", "--token-file", token],
    )
    .await;
    assert_eq!(with.code, Some(0), "{}", with.stderr);
}

#[tokio::test]
async fn a_service_here_needs_no_certificates_and_no_proxy() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    // As in an image without certificates, with the proxy of a company.
    let environment = [
        ("SSL_CERT_FILE", "/nonexistent"),
        ("SSL_CERT_DIR", "/nonexistent"),
        ("http_proxy", "http://127.0.0.1:1"),
        ("FRETWEAR_SERVER", server.base.as_str()),
        ("FRETWEAR_LISTEN", server.base.trim_start_matches("http://")),
    ];
    for command in ["list", "probe"] {
        let ran = Command::new(binary())
            .arg(command)
            .envs(environment)
            .output();
        let ran = ran.expect("it can be started");
        assert!(
            ran.status.success(),
            "{command}: {}",
            String::from_utf8_lossy(&ran.stderr)
        );
    }
}

#[tokio::test]
async fn a_redirection_is_reported_and_not_followed() {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let base = format!("http://{}", listener.local_addr().expect("an address"));
    tokio::spawn(async move {
        let (mut client, _) = listener.accept().await.expect("a connection");
        client.read_exact(&mut [0; 16]).await.expect("a request");
        let answer = b"HTTP/1.1 308 Permanent Redirect\r\nlocation: https://wear.test/\r\ncontent-length: 0\r\n\r\n";
        client.write_all(answer).await.expect("written");
        // Until the other side closes it.
        let _ = client.read_to_end(&mut Vec::new()).await;
    });
    let folder = tempfile::tempdir().expect("a folder can be made");
    let ran = client(folder.path(), &base, &["list"]).await;
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.contains("https://wear.test/"), "{}", ran.stderr);
}
