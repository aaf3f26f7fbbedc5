//! Requirement: a service with an access token answers requests without it only for its health and its static pages, and
//! a service without a token listens on loopback only.

use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Stdio};

use tests::program::binary;
use tests::{Server, fretwear};

const TOKEN: &str = "0123456789-abcdefghij";

#[tokio::test]
async fn only_requests_with_the_token_are_answered() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let file = folder.path().join("token");
    std::fs::write(&file, format!("{TOKEN}\n")).expect("a file can be written");
    let option = file.to_str().expect("the path is text");
    let server = Server::start_with(folder.path(), &["--token-file", option]);
    for (path, expected) in [
        ("/healthz", 200),
        ("/readyz", 200),
        ("/", 200),
        ("/docs", 200),
        ("/book", 200),
        ("/book/guide/accuracy.html", 200),
        ("/v1/jobs", 401),
        ("/v1/systems", 401),
        ("/openapi.json", 401),
        ("/metrics", 401),
        ("/nowhere", 401),
    ] {
        assert_eq!(server.get(path).await.0, expected, "{path}");
    }
    assert_eq!(server.submit(r#"{"system":{"kind":"dimm"}}"#).await.0, 401);
    for (token, expected) in [(TOKEN, 200), ("0123456789-abcdefghiJ", 401), ("", 401)] {
        let request = server.client.get(format!("{}/v1/jobs", server.base));
        let answer = request.bearer_auth(token).send().await;
        assert_eq!(
            answer.expect("the service answers").status(),
            expected,
            "{token}"
        );
    }
}

#[test]
fn without_a_token_the_service_listens_on_loopback_only() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let ran = fretwear(folder.path(), &["serve", "--listen", "0.0.0.0:0"]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.contains("access token"), "{}", ran.stderr);
    std::fs::write(folder.path().join("weak"), "short").expect("a file can be written");
    let ran = fretwear(
        folder.path(),
        &["serve", "--listen", "0.0.0.0:0", "--token-file", "weak"],
    );
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.contains("5 characters"), "{}", ran.stderr);
}

/// Lines that a service with these options writes under a umask until it serves.
fn first_lines(folder: &std::path::Path, umask: &str, options: &str) -> String {
    let command = format!("umask {umask}; exec \"$0\" serve --workers 0 {options}");
    let mut service = Command::new("sh")
        .args(["-c", &command])
        .arg(binary())
        .current_dir(folder)
        .env("RUST_LOG", "info")
        .stderr(Stdio::piped())
        .spawn()
        .expect("the service can be started");
    let log = service.stderr.take().expect("a pipe");
    let mut lines = String::new();
    for line in BufReader::new(log).lines() {
        lines.push_str(&line.expect("text"));
        lines.push('\n');
        if lines.contains("service started") {
            break;
        }
    }
    service.kill().expect("it is there");
    service.wait().expect("it ends");
    lines
}

#[test]
fn secrets_and_data_that_others_can_reach_are_warnings() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let file = folder.path().join("token");
    std::fs::write(&file, TOKEN).expect("a file can be written");
    let allow = |mode| {
        let mode = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&file, mode).expect("a mode");
    };
    let warnings = ["file of a secret", "change the database"];
    let given = |umask| {
        let options = "--listen 127.0.0.1:0 --token-file token";
        let lines = first_lines(folder.path(), umask, options);
        assert!(lines.contains("service started"), "{lines}");
        warnings.map(|words| lines.contains(words))
    };
    allow(0o600);
    assert_eq!(given("022"), [false, false]);
    assert_eq!(given("000"), [false, true]);
    allow(0o644);
    assert_eq!(given("077"), [true, false]);
}
