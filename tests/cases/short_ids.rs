//! Requirement: every client command that takes an id accepts its first or last characters, as the pages show them; one that several ids
//! have is refused with these.

use serde_json::Value;
use tests::{Ran, Server, fretwear};

const SPEC: &str = r#"{"name": "pad","system":{"kind":"cylinder_on_flat"},"cycles":2,"labels":{"lot":"7"},
    "accuracy":{"preset":"draft","estimate_errors":false}}"#;

#[tokio::test]
async fn jobs_and_tokens_are_named_by_the_ends_of_their_ids() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let server = Server::start(folder);
    let run = |arguments: &[&str]| -> Ran {
        fretwear(folder, &[arguments, &["--server", &server.base]].concat())
    };
    let (_, one) = server.submit(SPEC).await;
    let (_, other) = server.submit(SPEC).await;
    let ids = [&one, &other].map(|job| job["id"].as_str().expect("an id"));
    for id in ids {
        server
            .job_when(id, |job| job["status"] == "succeeded")
            .await;
    }
    // As the list of jobs shows one without a name.
    let short = &ids[0][24..];
    let watched = run(&["watch", short, "--json"]);
    assert_eq!(watched.code, Some(0), "{}", watched.stderr);
    let fetched = run(&[
        "fetch",
        &short.to_uppercase(),
        "summary.json",
        "--out",
        "fetched",
    ]);
    assert_eq!(fetched.code, Some(0), "{}", fetched.stderr);
    let file = std::fs::read(folder.join("fetched/summary.json")).expect("a file");
    let summary: Value = serde_json::from_slice(&file).expect("JSON");
    assert_eq!(
        server.get(&format!("/v1/jobs/{}", ids[0])).await.1["summary"],
        summary
    );
    let retried = run(&["retry", short]);
    assert!(
        retried
            .stderr
            .contains(&format!("job {} has succeeded", ids[0])),
        "{}",
        retried.stderr
    );
    assert_eq!(
        run(&["cancel", &ids[1][20..]]).stdout.trim(),
        format!("{} succeeded", ids[1])
    );

    // Ids begin with the time: all of a day have their first characters in common.
    for command in ["watch", "cancel", "retry"] {
        let ambiguous = run(&[command, &ids[0][..4]]);
        assert_eq!(ambiguous.code, Some(2), "{}", ambiguous.stderr);
        for id in ids {
            assert!(
                ambiguous.stderr.contains(&format!("\n  {id} pad\n")),
                "{}",
                ambiguous.stderr
            );
        }
    }
    // A name is no id, even if the search of the service finds it.
    let (_, named) = server.submit(SPEC.replace("pad", "face face")).await;
    let unknown = run(&["watch", "face"]);
    let is_id = named["id"].as_str().expect("an id").ends_with("face");
    assert!(is_id || unknown.code == Some(1), "{}", unknown.stderr);
    assert_eq!(run(&["watch", "pad"]).code, Some(2));

    let token = run(&["worker-token", "create", "cluster", "--out", "token"]);
    let id = token.stdout.split_whitespace().next().expect("an id");
    let revoked = run(&["worker-token", "revoke", &id[24..]]);
    assert_eq!(
        revoked.stdout.trim(),
        format!("{id} revoked"),
        "{}",
        revoked.stderr
    );
}

#[tokio::test]
async fn a_list_is_filtered_by_labels_as_they_are_written() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--workers", "0"]);
    let (_, job) = server.submit(SPEC).await;
    let found = |arguments: &[&str]| {
        let list = ["list", "--json", "--server", &server.base];
        let ran = fretwear(folder.path(), &[&list, arguments].concat());
        let jobs: Value = serde_json::from_str(&ran.stdout).unwrap_or_default();
        (ran.code, jobs[0]["id"].clone(), ran.stderr)
    };
    for label in ["lot=7", "lot:7"] {
        let (_, id, _) = found(&["--label", label]);
        assert_eq!(id, job["id"], "{label}");
    }
    assert_eq!(found(&["--label", "lot=8"]).1, Value::Null);
    assert_eq!(found(&["--label", "lot"]).0, Some(2));
    let (code, _, said) = found(&["--status", "done"]);
    assert_eq!(code, Some(2));
    assert!(
        said.contains("statuses are queued, running, succeeded, failed, cancelled"),
        "{said}"
    );
}
