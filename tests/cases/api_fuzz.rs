//! Requirement: requests made from the OpenAPI document, well-formed and malformed, are never answered with a 5xx, with
//! a status that the document does not name, or with a body that it does not describe. The requests come from
//! schemathesis, an independent program that reads the document.

use std::process::Command;

use tests::Server;

/// What is checked of every answer.
const CHECKS: &str = "not_a_server_error,status_code_conformance,content_type_conformance,response_schema_conformance";
/// Streams and long polls wait for things to happen, which is not what is tested here.
const LEFT_OUT: &str = "/v1/jobs/{id}/events";

#[tokio::test]
#[cfg_attr(
    not(has_schemathesis),
    ignore = "needs the Python package schemathesis"
)]
async fn no_request_made_from_the_document_is_answered_otherwise_than_it_says() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let config = "[reports]\ndirectory = \"reports\"\n";
    std::fs::write(folder.path().join("schemathesis.toml"), config).expect("a file can be written");
    let output = Command::new(env!("FRETWEAR_PYTHON"))
        .args(["-m", "schemathesis.cli", "run"])
        .arg(format!("{}/openapi.json", server.base))
        .args(["--checks", CHECKS, "--exclude-path", LEFT_OUT])
        .args(["--phases", "examples,coverage,fuzzing"])
        .args(["--max-examples", "20", "--max-time", "60", "--seed", "7"])
        .args(["--request-timeout", "30", "--no-color"])
        .current_dir(folder.path())
        .output()
        .expect("schemathesis can be started");
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}");
    assert_eq!(server.get("/healthz").await.0, 200);
}
