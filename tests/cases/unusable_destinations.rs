//! Requirement: a command that cannot write where it is to write ends with exit code 2 before it solves, submits or makes anything.

use tests::{Ran, Server, fretwear};

/// Solved for hours: a command that starts to solve it does not end.
const LONG: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":100000000,
    "accuracy":{"preset":"draft","overrides":{"cycle_jump":1}}}"#;

fn is_unusable(ran: &Ran, path: &str) {
    assert_eq!(ran.code, Some(2), "{path}: {}", ran.stderr);
    assert_eq!(ran.stdout, "", "{path}");
    assert!(
        ran.stderr.contains(&format!("fretwear: {path}: ")),
        "{path}: {}",
        ran.stderr
    );
}

#[tokio::test]
async fn a_place_that_cannot_be_written_ends_a_command_at_once() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let server = Server::start_with(folder, &["--workers", "0"]);
    std::fs::write(folder.join("long.json"), LONG).expect("written");
    let unknown = "00000000-0000-7000-8000-000000000000";
    // Below a file, and a folder in which not even root can make a file.
    for path in ["long.json/results", "/proc"] {
        let commands: [&[&str]; 4] = [
            &["solve", "long.json", "--out", path],
            &["study", "long.json", "--out", path],
            &[
                "submit",
                "long.json",
                "--out",
                path,
                "--server",
                &server.base,
            ],
            &["fetch", unknown, "--out", path, "--server", &server.base],
        ];
        for command in commands {
            is_unusable(&fretwear(folder, command), path);
        }
    }
    for path in [
        "long.json/new.json",
        "absent/new.json",
        "/proc/new.json",
        ".",
    ] {
        let calibrate = [
            "calibrate",
            "long.json",
            "--rated-cycles",
            "10",
            "--criterion",
            "base_metal",
        ];
        is_unusable(
            &fretwear(folder, &[&calibrate[..], &["--out", path]].concat()),
            path,
        );
        let create = [
            "worker-token",
            "create",
            "cluster",
            "--server",
            &server.base,
            "--out",
            path,
        ];
        is_unusable(&fretwear(folder, &create), path);
    }
    let (_, list) = server.get("/v1/jobs").await;
    assert_eq!(list["jobs"].as_array().map(Vec::len), Some(0), "{list}");
    let (_, list) = server.get("/v1/worker-tokens").await;
    assert_eq!(list["tokens"].as_array().map(Vec::len), Some(0), "{list}");
}
