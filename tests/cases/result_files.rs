//! Requirement: a job with requested fields lists them and all its documents with length and SHA-256; each file is
//! served with exactly these bytes, whole and in ranges; the archive contains what `fretwear solve --out` writes, bit for bit; deleting
//! the job deletes its files.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::{Cursor, Read};
use std::path::Path;

use serde_json::Value;
use sha2::{Digest, Sha256};
use tests::{Server, database, fretwear};
use zip::ZipArchive;

const SPEC: &str = r#"{
  "system": {"kind": "cylinder_on_flat"},
  "cycles": 20,
  "output": {"fields": true, "snapshots_at_cycles": [20]}
}"#;

/// Files that the solved job must list, at least.
const NAMES: [&str; 11] = [
    "fields-0.vtu",
    "fields-20.vtu",
    "fields-20-leftmost.vtu",
    "loop-20.csv",
    "pressure-20.csv",
    "pressure.svg",
    "profile-20.csv",
    "spec.resolved.json",
    "summary.json",
    "wear-history.csv",
    "wear-history.parquet",
];

#[tokio::test]
async fn every_file_is_served_as_the_manifest_describes_it() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (status, job) = server.submit(SPEC).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["status"], "succeeded", "{job}");

    let (_, manifest) = server.get(&format!("/v1/jobs/{id}/results")).await;
    assert_eq!(manifest["complete"], true);
    let files = manifest["files"].as_array().expect("files are listed");
    let listed: Vec<&str> = files.iter().filter_map(|f| f["name"].as_str()).collect();
    for name in NAMES {
        assert!(listed.contains(&name), "{name} is not in {listed:?}");
    }
    let solved = solved(folder.path());
    for file in files {
        let name = file["name"].as_str().expect("a file has a name");
        let bytes = fetched(&server, &id, name, file).await;
        if name.starts_with("fields-") {
            assert_eq!(
                std::fs::read(solved.join(name)).expect("solved"),
                bytes,
                "{name}"
            );
        }
    }

    let archive = archived(&server, &id).await;
    let written: BTreeMap<String, Vec<u8>> = std::fs::read_dir(&solved)
        .expect("a folder")
        .map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_name().and_then(OsStr::to_str).expect("a name");
            (name.to_owned(), std::fs::read(&path).expect("a file"))
        })
        .collect();
    assert_eq!(
        archive.keys().collect::<Vec<_>>(),
        written.keys().collect::<Vec<_>>()
    );
    for (name, bytes) in &archive {
        if name == "summary.json" {
            assert_eq!(without_cost(bytes), without_cost(&written[name]));
        } else {
            assert!(*bytes == written[name], "{name}");
        }
    }

    let results = folder.path().join("fretwear.db.results");
    assert!(results.join(&id).is_dir());
    let deleted = server
        .client
        .delete(format!("{}/v1/jobs/{id}", server.base))
        .send()
        .await
        .expect("the service answers");
    assert_eq!(deleted.status(), 204);
    assert!(!results.join(&id).exists());
}

#[tokio::test]
async fn damaged_small_results_are_named_and_not_sent() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let spec = SPEC.replace("true", "false");
    let (_, job) = server.submit(spec).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let ended = |job: &Value| job["finished_at"].is_string();
    server.job_when(&id, ended).await;
    assert_eq!(database::damage_results(folder.path()).await, 1);
    let results = format!("/v1/jobs/{id}/results");
    for path in [
        "wear-history",
        "profile?cycle=20",
        "files/wear-history.parquet",
    ] {
        let (status, problem) = server.get(&format!("{results}/{path}")).await;
        let kind = problem["type"].as_str();
        assert_eq!(
            (status, kind),
            (500, Some("/problems/result-damaged")),
            "{path}"
        );
    }
    let ran = fretwear(folder.path(), &["verify"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stdout);
    let (_, manifest) = server.get(&results).await;
    let files = manifest["files"].as_array().expect("files");
    assert!(
        files.iter().any(|file| file["damaged"].is_string()),
        "{manifest}"
    );
}

/// Solves the same specification without a service; returns the folder of its files.
fn solved(folder: &Path) -> std::path::PathBuf {
    std::fs::write(folder.join("spec.json"), SPEC).expect("a file can be written");
    let ran = fretwear(folder, &["solve", "spec.json", "--out", "solved"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    folder.join("solved")
}

/// The files of a job's archive by name.
async fn archived(server: &Server, id: &str) -> BTreeMap<String, Vec<u8>> {
    let url = format!("{}/v1/jobs/{id}/results/archive", server.base);
    let answer = server.client.get(url).send().await.expect("an answer");
    assert_eq!(answer.status(), 200);
    let bytes = answer.bytes().await.expect("a body");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let files = (0..archive.len()).map(|index| {
        let mut file = archive.by_index(index).expect("a file");
        let mut content = Vec::new();
        file.read_to_end(&mut content).expect("a content");
        (file.name().expect("a name").into_owned(), content)
    });
    files.collect()
}

/// A summary without what a run has cost, which differs from run to run.
fn without_cost(summary: &[u8]) -> Value {
    let mut summary: Value = serde_json::from_slice(summary).expect("JSON");
    summary["cost"] = Value::Null;
    summary
}

/// Fetches a whole file; compares it with its description and with its second half, fetched by range.
async fn fetched(server: &Server, id: &str, name: &str, described: &Value) -> Vec<u8> {
    let url = format!("{}/v1/jobs/{id}/results/files/{name}", server.base);
    let get = |range: Option<String>| {
        let request = server.client.get(&url);
        let request = range
            .into_iter()
            .fold(request, |request, range| request.header("range", range));
        async { request.send().await.expect("the service answers") }
    };
    let bytes = get(None).await.bytes().await.expect("a body").to_vec();
    let digest = Sha256::digest(&bytes)
        .iter()
        .fold(String::new(), |text, byte| text + &format!("{byte:02x}"));
    assert_eq!(described["sha256"], digest, "{name}");
    assert_eq!(described["bytes"], bytes.len(), "{name}");
    let half = bytes.len() / 2;
    let rest = get(Some(format!("bytes={half}-"))).await;
    assert_eq!(rest.status(), 206, "{name}");
    assert_eq!(
        rest.bytes().await.expect("a body")[..],
        bytes[half..],
        "{name}"
    );
    bytes
}
