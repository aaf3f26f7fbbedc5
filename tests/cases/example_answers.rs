//! Requirement: the document of the interface shows an answer of each of its schemas and texts, with the fields that a service sends.
//!
//! After an intended change:
//!
//!     FRETWEAR_WRITE_ANSWERS=1 cargo test --release -p tests --test cases example_answers
//!     cargo run --release -- openapi > api/openapi.json

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Map, Value, json};
use tests::{RemoteWorker, Server};

/// The committed answers.
const FILE: &str = "../server/src/http/openapi/answers.json";
/// Elements of a list, and lines of a text, that are shown.
const ELEMENTS: usize = 2;
const LINES: usize = 8;

/// Ids of what the answers are about.
struct Subjects {
    job: String,
    sweep: String,
    study: String,
    worker: String,
}

#[tokio::test]
async fn the_interface_shows_answers_with_the_fields_of_a_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let _worker = RemoteWorker::start(folder.path(), &server.base, &[]);
    let subjects = subjects(&server).await;
    let answers = answers(&server, &subjects).await;
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILE);
    if std::env::var_os("FRETWEAR_WRITE_ANSWERS").is_some() {
        let text = serde_json::to_string_pretty(&answers).expect("JSON") + "\n";
        std::fs::write(&file, text).expect("the file can be written");
    }
    let committed = std::fs::read_to_string(&file).expect("it is committed");
    let committed: Value = serde_json::from_str(&committed).expect("JSON");
    let (shown, sent) = (fields(&committed["schemas"]), fields(&answers["schemas"]));
    let differ: Vec<_> = shown.symmetric_difference(&sent).collect();
    assert!(differ.is_empty(), "{differ:#?}");
    let texts = |answers: &Value| -> Vec<String> {
        let texts = answers["texts"].as_object().expect("texts");
        texts
            .iter()
            .map(|(path, text)| first_line(path, text))
            .collect()
    };
    assert_eq!(texts(&committed), texts(&answers));
}

/// Path and first line of a text: the names of its columns, or of the first event or gauge.
fn first_line(path: &str, text: &Value) -> String {
    let line = text.as_str().and_then(|text| text.lines().next());
    format!("{path} {}", line.unwrap_or_default())
}

/// A job with all results, a sweep, a study and a remote worker.
async fn subjects(server: &Server) -> Subjects {
    let spec = json!({
        "name": "gold at the tip", "labels": {"lot": "7"},
        "system": {"kind": "cylinder_on_flat"},
        "cycles": 20, "accuracy": {"preset": "draft"},
        "output": {"snapshots_at_cycles": [20], "stations_mm": [0.0]}
    });
    let job = server.ended(&spec).await;
    let grid = json!({"/cycles": [20, 40]});
    let sweep = created(
        server,
        "/v1/sweeps",
        &json!({"name": "cycles", "base": spec, "grid": grid}),
    )
    .await;
    let study = created(
        server,
        "/v1/studies",
        &json!({"name": "how exact", "base": spec, "budget_s": 4}),
    )
    .await;
    for batch in [
        format!("/v1/sweeps/{sweep}"),
        format!("/v1/studies/{study}"),
    ] {
        server.batch_ended(&batch).await;
    }
    created(server, "/v1/worker-tokens", &json!({"name": "cluster"})).await;
    let worker = loop {
        let (_, list) = server.get("/v1/workers").await;
        if let Some(id) = list["remote"][0]["id"].as_str() {
            break id.to_owned();
        }
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    };
    Subjects {
        job: job["id"].as_str().expect("an id").to_owned(),
        sweep,
        study,
        worker,
    }
}

async fn created(server: &Server, path: &str, body: &Value) -> String {
    let answer = sent(server, path, body).await;
    answer["id"].as_str().expect("an id").to_owned()
}

async fn sent(server: &Server, path: &str, body: &Value) -> Value {
    let (status, answer) = server.post_json(path, body).await;
    assert!((200..300).contains(&status), "{path}: {status} {answer}");
    answer
}

/// An answer of each schema, and the text of each path that has one.
async fn answers(server: &Server, subjects: &Subjects) -> Value {
    let Subjects {
        job,
        sweep,
        study,
        worker,
    } = subjects;
    let results = format!("/v1/jobs/{job}/results");
    let mut schemas = Map::new();
    for (schema, path) in [
        ("Job", format!("/v1/jobs/{job}")),
        ("JobList", "/v1/jobs?limit=1".to_owned()),
        (
            "Histories",
            format!("/v1/histories?jobs={job}&columns=cycle,receptacle_max_depth_mm"),
        ),
        ("Manifest", results.clone()),
        ("Loop", format!("{results}/loop")),
        ("Pressure", format!("{results}/pressure")),
        ("Profile", format!("{results}/profile")),
        ("WearHistory", format!("{results}/wear-history")),
        ("QuantityList", "/v1/quantities".to_owned()),
        ("Spec", format!("/v1/jobs/{job}/spec")),
        ("Labels", "/v1/labels".to_owned()),
        ("ServiceOverview", "/v1/service".to_owned()),
        ("StudyList", "/v1/studies".to_owned()),
        ("StudyDocument", format!("/v1/studies/{study}")),
        ("SweepList", "/v1/sweeps".to_owned()),
        ("Sweep", format!("/v1/sweeps/{sweep}")),
        ("SystemList", "/v1/systems".to_owned()),
        ("SystemDocument", "/v1/systems/sd_card".to_owned()),
        ("WorkerTokens", "/v1/worker-tokens".to_owned()),
        ("WorkerList", "/v1/workers".to_owned()),
    ] {
        let (status, answer) = server.get(&path).await;
        assert_eq!(status, 200, "{path}: {answer}");
        schemas.insert(schema.to_owned(), shown(answer));
    }
    let spec = schemas["Spec"].clone();
    let grid = json!({"base": spec, "grid": {"/cycles": [20, 40]}});
    for (schema, path, body) in [
        ("PlanDocument", "/v1/plans".to_owned(), spec),
        ("SweepPlan", "/v1/sweeps/plans".to_owned(), grid),
        (
            "RetriedJobs",
            format!("/v1/sweeps/{sweep}/retry"),
            json!({}),
        ),
        (
            "CreatedWorkerToken",
            "/v1/worker-tokens".to_owned(),
            json!({"name": "cluster"}),
        ),
        (
            "RemoteWorker",
            format!("/v1/workers/{worker}/drain"),
            json!({}),
        ),
    ] {
        schemas.insert(schema.to_owned(), shown(sent(server, &path, &body).await));
    }
    let texts = texts(server, subjects, &schemas["Spec"]).await;
    json!({"schemas": schemas, "texts": texts})
}

/// The first lines of the text of each path that has one.
async fn texts(server: &Server, subjects: &Subjects, spec: &Value) -> Map<String, Value> {
    let Subjects {
        job, sweep, study, ..
    } = subjects;
    let results = format!("/v1/jobs/{job}/results");
    let mut texts = Map::new();
    for (template, path) in [
        ("/metrics", "/metrics".to_owned()),
        ("/v1/jobs/{id}/events", format!("/v1/jobs/{job}/events")),
        (
            "/v1/jobs/{id}/results/loop",
            format!("{results}/loop?format=csv"),
        ),
        (
            "/v1/jobs/{id}/results/pressure",
            format!("{results}/pressure?format=csv"),
        ),
        (
            "/v1/jobs/{id}/results/profile",
            format!("{results}/profile?format=csv"),
        ),
        (
            "/v1/jobs/{id}/results/wear-history",
            format!("{results}/wear-history?format=csv"),
        ),
        (
            "/v1/studies/{id}/table",
            format!("/v1/studies/{study}/table"),
        ),
        (
            "/v1/sweeps/{id}/outcomes",
            format!("/v1/sweeps/{sweep}/outcomes"),
        ),
    ] {
        let request = server.client.get(format!("{}{path}", server.base));
        // A stream replays its events from there.
        let request = request.header("last-event-id", "0");
        let text = request.send().await.expect("an answer").text().await;
        let text = text.expect("text");
        let lines: Vec<&str> = text.lines().take(LINES).collect();
        texts.insert(template.to_owned(), (lines.join("\n") + "\n").into());
    }
    texts.insert("/v1/events".to_owned(), changes(server, spec).await.into());
    texts
}

/// The first change of the stream of all jobs, which does not end.
async fn changes(server: &Server, spec: &Value) -> String {
    let stream = server.client.get(format!("{}/v1/events", server.base));
    let mut stream = stream.send().await.expect("a stream");
    created(server, "/v1/jobs", spec).await;
    let mut text = String::new();
    loop {
        let chunk = stream.chunk().await.expect("the stream stays open");
        text += std::str::from_utf8(&chunk.expect("the stream does not end")).expect("text");
        let whole = text.rsplit_once("\n\n").map_or("", |(whole, _)| whole);
        if let Some(event) = whole.split("\n\n").find(|event| event.contains("data:")) {
            return format!("{event}\n\n");
        }
    }
}

/// An answer with the first elements of its lists, without what belongs to this machine or is secret.
fn shown(answer: Value) -> Value {
    match answer {
        Value::Array(elements) => elements.into_iter().take(ELEMENTS).map(shown).collect(),
        Value::Object(fields) => {
            let field = |(name, value): (String, Value)| {
                let value = match (&name[..], value) {
                    ("host", Value::String(_)) => "node7".into(),
                    ("token", Value::String(_)) => "shown once".into(),
                    // Their names are no fields.
                    ("$defs" | "properties" | "provenance", Value::Object(named)) => {
                        shown(named.into_iter().take(ELEMENTS).collect())
                    }
                    (_, value) => shown(value),
                };
                (name, value)
            };
            fields.into_iter().map(field).collect()
        }
        value => value,
    }
}

/// Pointers to all fields of a document, elements of lists by a star.
fn fields(document: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    add_fields(document, "", &mut found);
    found
}

fn add_fields(document: &Value, at: &str, found: &mut BTreeSet<String>) {
    match document {
        Value::Array(elements) => {
            for element in elements {
                add_fields(element, &format!("{at}/*"), found);
            }
        }
        Value::Object(fields) => {
            for (name, value) in fields {
                let at = format!("{at}/{name}");
                add_fields(value, &at, found);
                found.insert(at);
            }
        }
        _ => {}
    }
}
