//! Requirement: a backup of a served database is complete, verified, and can be restored and served.

use serde_json::json;
use tests::{Server, bits, fretwear};

#[tokio::test]
async fn a_backup_restores_every_job_and_file_and_damage_is_detected() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let spec = json!({
        "system": {"kind": "fuzz_button"},
        "cycles": 2,
        "accuracy": {"preset": "draft"},
        "output": {"fields": true}
    });
    let (_, job) = server.submit(spec.to_string()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let ended = |job: &serde_json::Value| job["finished_at"].is_string();
    server.job_when(&id, ended).await;
    let expected = bits::of(&server, &id).await;
    let database = "sqlite://fretwear.db";
    let ran = fretwear(folder.path(), &["backup", "copy", "--database", database]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stdout.starts_with("1 jobs and "), "{}", ran.stdout);
    let again = fretwear(folder.path(), &["backup", "copy", "--database", database]);
    assert_eq!(again.code, Some(1), "nothing is overwritten");
    drop(server);

    let other = tempfile::tempdir().expect("a folder can be made");
    let copy = folder.path().join("copy").display().to_string();
    let ran = fretwear(other.path(), &["restore", &copy, "--database", database]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let server = Server::start(other.path());
    assert_eq!(bits::of(&server, &id).await, expected);
    drop(server);

    let files = folder.path().join("copy/fretwear.db.results").join(&id);
    let attempt = std::fs::read_dir(files).expect("files").next();
    let attempt = attempt.expect("an attempt").expect("its folder").path();
    let file = std::fs::read_dir(attempt).expect("files").next();
    let file = file.expect("a file").expect("a file").path();
    std::fs::write(&file, "not what it was").expect("damage");
    let third = tempfile::tempdir().expect("a folder can be made");
    let ran = fretwear(third.path(), &["restore", &copy, "--database", database]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.contains("is damaged"), "{}", ran.stderr);
    assert!(!third.path().join("fretwear.db").exists());

    let copy = format!("sqlite://{copy}/fretwear.db");
    let ran = fretwear(folder.path(), &["verify", "--database", &copy]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.starts_with("damaged: "), "{}", ran.stdout);
    let ran = fretwear(folder.path(), &["verify", "--database", database]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
}
