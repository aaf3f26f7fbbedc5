//! Requirement: a change of structure changes no result. Thirty-six short scenes (every system and dimension, plated presets, each drive, a
//! spring, continuous motion, vibration, missions, partial slip, every wear law, heat, resistance, lives with scatter, wear on either and on
//! both sides, rebuilt stiffness, fields) are solved by the service, and the SHA-256 of everything it then serves is compared with a committed table. Ids, times, costs and
//! what is derived from the machine's speed are masked.
//!
//! The engine's bits depend on the processor's vector instructions, so the table holds for x86-64 with AVX2 and FMA;
//! the case is ignored elsewhere. `FRETWEAR_WRITE_GOLDEN=1` writes the table again, for a change that is meant to
//! change results.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};
use tests::{Server, bits};

/// Fields that differ from run to run: what a solve costs, and when things happened.
const MASKED: [&str; 12] = [
    "id",
    "cost",
    "cpu_s",
    "cpu_s_most",
    "machine",
    "eta_s",
    "eta_most_s",
    "updated_at",
    "created_at",
    "started_at",
    "finished_at",
    "links",
];

/// Scene, then part, then SHA-256 of the part.
type Table = BTreeMap<String, BTreeMap<String, String>>;

#[tokio::test]
#[cfg_attr(not(has_fma), ignore = "the table holds for x86-64 with AVX2 and FMA")]
async fn thirty_six_scenes_give_the_committed_bits() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--workers", "2"]);
    let scenes = scenes();
    assert_eq!(scenes.len(), 36);
    let mut jobs = Vec::new();
    for (name, spec) in &scenes {
        let (status, job) = server.submit(spec.clone()).await;
        assert_eq!(status, 202, "{name}: {job}");
        jobs.push((name, job["id"].as_str().expect("an id").to_owned()));
    }
    let mut found = Table::new();
    for (name, id) in jobs {
        let job = server
            .job_when(&id, |job| job["finished_at"].is_string())
            .await;
        assert_eq!(job["status"], "succeeded", "{name}: {job}");
        let mut parts = parts(&server, &id, job).await;
        let spec = scenes[name].clone();
        parts.insert("plan".to_owned(), plan(&server, spec).await);
        found.insert(name.clone(), parts);
    }
    compare(&found);
}

/// The specifications by name.
fn scenes() -> BTreeMap<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/golden");
    let files = std::fs::read_dir(folder).expect("the scenes are there");
    let read = |path: PathBuf| {
        let name = path.file_stem()?.to_str()?.to_owned();
        Some((name, std::fs::read_to_string(path).ok()?))
    };
    files
        .flatten()
        .filter_map(|file| read(file.path()))
        .collect()
}

/// Everything that is served of a job, hashed part by part: a document, or the files of a kind at all cycles.
async fn parts(server: &Server, id: &str, mut job: Value) -> BTreeMap<String, String> {
    let mut parts = BTreeMap::new();
    mask(&mut job);
    parts.insert("job".to_owned(), hash(job.to_string().as_bytes()));
    // Which rows of the history become events depends on the pace; the last event does not.
    let mut done = Value::from(bits::events(server, id, "done").await);
    mask(&mut done);
    parts.insert("done event".to_owned(), hash(done.to_string().as_bytes()));
    let results = format!("/v1/jobs/{id}/results");
    for document in [
        "wear-history",
        "profile?cycle=0",
        "profile?cycle=1000000",
        "pressure?cycle=0",
        "pressure?cycle=1000000",
        "loop?cycle=1000000",
    ] {
        let (status, mut body) = server.get(&format!("{results}/{document}")).await;
        assert_eq!(status, 200, "{document}: {body}");
        mask(&mut body);
        parts.insert(document.to_owned(), hash(body.to_string().as_bytes()));
    }
    let (_, manifest) = server.get(&results).await;
    let mut files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    for file in manifest["files"].as_array().expect("files are listed") {
        let name = file["name"].as_str().expect("a file has a name");
        // The summary tells the cost; without it, it is part of the job.
        if name != "summary.json" {
            let kind = name.replace(|c: char| c.is_ascii_digit(), "");
            let digest = file["sha256"].as_str().expect("a file has a digest");
            let of_kind = files.entry(kind).or_default();
            of_kind.extend(format!("{name} {digest}\n").bytes());
        }
    }
    parts.extend(
        files
            .into_iter()
            .map(|(kind, of_kind)| (kind, hash(&of_kind))),
    );
    parts
}

/// The plan of a specification, hashed.
async fn plan(server: &Server, spec: String) -> String {
    let request = server.client.post(format!("{}/v1/plans", server.base));
    let request = request
        .header("content-type", "application/json")
        .body(spec);
    let answer = request.send().await.expect("the service answers");
    assert_eq!(answer.status(), 200);
    let mut plan: Value = answer.json().await.expect("JSON");
    mask(&mut plan);
    hash(plan.to_string().as_bytes())
}

fn mask(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            fields.retain(|name, _| !MASKED.contains(&name.as_str()));
            fields.values_mut().for_each(mask);
        }
        Value::Array(items) => items.iter_mut().for_each(mask),
        _ => {}
    }
}

fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}

/// Compares with the committed table, or writes it where that is asked for.
fn compare(found: &Table) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/golden_hashes.json");
    if std::env::var_os("FRETWEAR_WRITE_GOLDEN").is_some() {
        let text = serde_json::to_string_pretty(found).expect("a table is JSON");
        std::fs::write(&path, text + "\n").expect("the table can be written");
        return;
    }
    let text = std::fs::read_to_string(&path).expect("the table is there");
    let committed: Table = serde_json::from_str(&text).expect("the table is JSON");
    let mut differ = Vec::new();
    let empty = BTreeMap::new();
    for name in committed.keys().chain(found.keys()) {
        let (old, new) = (
            committed.get(name).unwrap_or(&empty),
            found.get(name).unwrap_or(&empty),
        );
        for part in old.keys().chain(new.keys()) {
            if old.get(part) != new.get(part) {
                differ.push(format!("{name}: {part}"));
            }
        }
    }
    differ.sort();
    differ.dedup();
    assert!(
        differ.is_empty(),
        "other bits than committed:\n{}",
        differ.join("\n")
    );
}
