//! Requirement: malicious input is refused with a 4xx problem, at no more cost than reading it, and the service stays
//! available: bodies of 50 MB, JSON 10 000 levels deep, numbers at the end of the range, a mesh of 1e9 elements, heads
//! that never end, bodies that never end, path traversal, 10 000 labels. No job is queued.

use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use nix::sys::resource::{Resource, getrlimit, setrlimit};
use serde_json::{Value, json};
use tests::Server;

/// Largest accepted peak memory of a service that refuses all of this, MB.
const MEMORY_LIMIT_MB: f64 = 256.0;
/// Bodies of 1 MiB that one address may have in memory.
const BODIES_OF_ONE_ADDRESS: usize = 64;
/// Longer than the service's timeout for a head.
const HEAD_TIMEOUT: Duration = Duration::from_mins(2);

fn connection(server: &Server) -> TcpStream {
    let address = server.base.trim_start_matches("http://");
    let stream = TcpStream::connect(address).expect("the service takes connections");
    stream
        .set_read_timeout(Some(HEAD_TIMEOUT))
        .expect("a time can be set");
    stream
}

/// Sends raw bytes, as far as the service reads them; returns the first line of its answer.
fn raw(server: &Server, head: &str, body: &[u8]) -> String {
    let mut stream = connection(server);
    stream
        .write_all(head.as_bytes())
        .expect("a head can be sent");
    // The service may answer and close the connection before it has read everything.
    let _ = stream.write_all(body);
    let mut answer = [0_u8; 64];
    let length = stream.read(&mut answer).expect("the service answers");
    String::from_utf8_lossy(&answer[..length])
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned()
}

async fn refused(server: &Server, body: impl Into<reqwest::Body>, expected: u16) -> Value {
    let (status, problem) = server.submit(body).await;
    assert_eq!(status, expected, "{problem}");
    assert!(
        problem["type"]
            .as_str()
            .is_some_and(|kind| kind.starts_with("/problems/")),
        "{problem}"
    );
    problem
}

async fn alive_and_empty(server: &Server) {
    assert_eq!(server.get("/healthz").await.0, 200);
    let (_, list) = server.get("/v1/jobs").await;
    assert_eq!(list["jobs"], json!([]));
}

#[tokio::test]
async fn large_bodies_are_refused_without_buffering() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let head = "POST /v1/jobs HTTP/1.1\r\nhost: 127.0.0.1\r\ncontent-type: application/json\r\n";
    let body = vec![b' '; 50 << 20];
    let declared = format!("{head}content-length: {}\r\n\r\n", body.len());
    let line = raw(&server, &declared, &body);
    assert!(line.contains(" 413 "), "{line}");
    let mut chunked = format!("{:x}\r\n", body.len()).into_bytes();
    chunked.extend_from_slice(&body);
    let undeclared = format!("{head}transfer-encoding: chunked\r\n\r\n");
    chunked.extend_from_slice(b"\r\n0\r\n\r\n");
    let line = raw(&server, &undeclared, &chunked);
    assert!(line.contains(" 413 "), "{line}");
    alive_and_empty(&server).await;
    let peak = server.peak_memory_mb();
    assert!(peak < MEMORY_LIMIT_MB, "{peak} MB");
}

#[tokio::test]
async fn malicious_documents_are_refused_with_a_problem() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    for (open, close) in [("[", "]"), (r#"{"system":"#, "}")] {
        let deep = format!("{}1{}", open.repeat(10_000), close.repeat(10_000));
        refused(&server, deep.clone(), 400).await;
        let unknown = format!(r#"{{"system":{{"kind":"dimm"}},"x":{deep}}}"#);
        refused(&server, unknown, 422).await;
    }
    let huge = r#"{"system":{"kind":"cylinder_on_flat","radius_mm":1e308},"load":{"kind":"line_force","n_per_mm":1e308}}"#;
    let problem = refused(&server, huge, 422).await;
    assert_eq!(
        problem["faults"].as_array().map(Vec::len),
        Some(2),
        "{problem}"
    );
    refused(&server, r#"{"system":{"kind":"dimm"},"cycles":1e400}"#, 400).await;

    let mesh = |size: f64| {
        let accuracy = json!({"overrides": {"contact_element_mm": size}});
        json!({"system": {"kind": "fuzz_button"}, "accuracy": accuracy}).to_string()
    };
    let problem = refused(&server, mesh(1e-10), 422).await;
    assert_eq!(
        problem["faults"][0]["pointer"],
        "/accuracy/overrides/contact_element_mm"
    );
    // A wear coefficient so small that the run does not end early.
    let rows = json!({
        "system": {"kind": "dimm"},
        "plating": {"slider": [], "receptacle": []},
        "interface": {"wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 1e-12}}},
        "cycles": 1_000_000_000,
        "accuracy": {"overrides": {"cycle_jump": 1}},
    });
    let problem = refused(&server, rows.to_string(), 422).await;
    assert!(problem.to_string().contains("output"), "{problem}");

    let labels: serde_json::Map<String, Value> = (0..10_000)
        .map(|label| (format!("label-{label}"), json!("x")))
        .collect();
    let labelled = json!({"system": {"kind": "dimm"}, "labels": labels});
    let problem = refused(&server, labelled.to_string(), 422).await;
    assert_eq!(problem["faults"][0]["pointer"], "/labels");
    let stations =
        json!({"system": {"kind": "dimm"}, "output": {"stations_mm": vec![0.0; 100_000]}});
    refused(&server, stations.to_string(), 422).await;
    alive_and_empty(&server).await;
    let peak = server.peak_memory_mb();
    assert!(peak < MEMORY_LIMIT_MB, "{peak} MB");
}

#[tokio::test]
async fn path_traversal_is_answered_with_404() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    for path in [
        "/v1/jobs/../../../../etc/passwd",
        "/v1/jobs/..%2f..%2fetc%2fpasswd",
        "/v1/jobs/%2e%2e/results/files/fretwear.db",
        "/v1/jobs/00000000-0000-7000-8000-000000000000/results/files/..%2f..%2ffretwear.db",
        "/v1/jobs/00000000-0000-7000-8000-000000000000/results/files/%00",
        "/assets/..%2f..%2fetc%2fpasswd",
        "//etc/passwd",
    ] {
        let head = format!("GET {path} HTTP/1.1\r\nhost: 127.0.0.1\r\n\r\n");
        let line = raw(&server, &head, b"");
        assert!(line.contains(" 404 "), "{path}: {line}");
    }
    let line = raw(
        &server,
        "GET / HTTP/1.1\r\nhost: attacker.test\r\n\r\n",
        b"",
    );
    assert!(line.contains(" 403 "), "{line}");
    for hosts in ["", "host: 127.0.0.1\r\nhost: 127.0.0.1\r\n"] {
        let line = raw(&server, &format!("GET / HTTP/1.1\r\n{hosts}\r\n"), b"");
        assert!(line.contains(" 400 "), "{hosts}: {line}");
    }
    let line = raw(&server, "GET /healthz HTTP/1.0\r\n\r\n", b"");
    assert!(line.contains(" 200 "), "{line}");
}

#[tokio::test]
async fn endless_heads_are_disconnected_while_others_are_answered() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let mut slow: Vec<TcpStream> = (0..200)
        .map(|_| {
            let mut stream = connection(&server);
            stream
                .write_all(b"GET /healthz HTTP/1.1\r\nhost: 127.0.0.1\r\nx-slow: ")
                .expect("a part of a head can be sent");
            stream
        })
        .collect();
    alive_and_empty(&server).await;
    for stream in &mut slow {
        let mut answer = Vec::new();
        match stream.read_to_end(&mut answer) {
            Ok(_) => {}
            Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset),
        }
        let text = String::from_utf8_lossy(&answer);
        assert!(!text.contains(" 200 "), "{text}");
    }
    let many = "x: y\r\n".repeat(1000);
    let line = raw(
        &server,
        &format!("GET /healthz HTTP/1.1\r\n{many}\r\n"),
        b"",
    );
    assert!(line.contains(" 431 "), "{line}");
    let healthy = raw(
        &server,
        "GET /healthz HTTP/1.1\r\nhost: 127.0.0.1\r\n\r\n",
        b"",
    );
    assert!(healthy.contains(" 200 "), "{healthy}");
}

#[tokio::test]
async fn thousands_of_idle_connections_keep_no_request_waiting() {
    const IDLE: u64 = 5_000;
    let most = allow_many_files();
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let mut idle: Vec<TcpStream> = (0..IDLE.min(most / 2))
        .map(|_| connection(&server))
        .collect();
    let began = std::time::Instant::now();
    alive_and_empty(&server).await;
    println!("answered in {:.3} s", began.elapsed().as_secs_f64());
    // They are not answered because idle connections timed out: those that are not the oldest are still open.
    assert!(is_open(idle.last_mut().expect("a connection")));
}

/// Raises the limit on open files; other tests of this process need some, too.
fn allow_many_files() -> u64 {
    let (_, most) = getrlimit(Resource::RLIMIT_NOFILE).expect("a limit");
    setrlimit(Resource::RLIMIT_NOFILE, most, most).expect("a higher limit");
    most
}

/// Sends the head of a submission of 1 MiB and a part of its body on each of some connections.
fn unfinished_bodies(server: &Server, count: u64, part: &[u8]) -> Vec<TcpStream> {
    let most = allow_many_files();
    let head = format!(
        "POST /v1/jobs HTTP/1.1\r\nhost: 127.0.0.1\r\ncontent-type: application/json\r\ncontent-length: {}\r\n\r\n",
        1 << 20
    );
    let one = || {
        let mut stream = connection(server);
        stream.write_all(head.as_bytes()).expect("a head");
        // The service may give up one that it has no memory for.
        let _ = stream.write_all(part);
        stream
    };
    (0..count.min(most / 2)).map(|_| one()).collect()
}

fn is_open(stream: &mut TcpStream) -> bool {
    stream.set_nonblocking(true).expect("a mode");
    let read = stream.read(&mut [0]).map_err(|error| error.kind());
    read == Err(ErrorKind::WouldBlock)
}

#[tokio::test]
async fn a_thousand_unfinished_bodies_keep_no_request_waiting() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let mut unfinished = unfinished_bodies(&server, 1_100, b"{");
    let began = std::time::Instant::now();
    alive_and_empty(&server).await;
    println!("answered in {:.3} s", began.elapsed().as_secs_f64());
    // Nothing was answered because they timed out.
    assert!(unfinished.iter_mut().all(is_open));
}

#[tokio::test]
async fn unfinished_bodies_have_a_limited_memory() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let part = vec![b' '; (1 << 20) - 1];
    let mut unfinished = unfinished_bodies(&server, 300, &part);
    // The service has read all of them and keeps as many as one address may have.
    while unfinished.len() > BODIES_OF_ONE_ADDRESS {
        unfinished.retain_mut(is_open);
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    // Another body needs memory and is received.
    refused(&server, "[".repeat(1 << 19), 400).await;
    alive_and_empty(&server).await;
    let peak = server.peak_memory_mb();
    assert!(peak < MEMORY_LIMIT_MB, "{peak} MB");
}
