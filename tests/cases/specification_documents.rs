//! Requirement: a command reads its specification from a file or, with `-`, from standard input; JSON with comments and trailing commas
//! is accepted, and any other document is refused with exit code 2, its name, the place, and what was expected there.

use serde_json::Value;
use tests::{Ran, Server, fretwear, fretwear_reading};

const PLAIN: &str = r#"{
  "system": {"kind": "cylinder_on_flat"},
  "cycles": 2,
  "accuracy": {"preset": "draft", "estimate_errors": false}
}"#;

/// The same specification; the names of its fields stand in the same lines.
const WITH_COMMENTS: &str = r#"{ // bench geometry
  "system": {"kind": "cylinder_on_flat",}, /* of bare
  steel */ "cycles": 2, # short
  "accuracy": {"preset": "draft", "estimate_errors": false},
}
"#;

/// Documents that are refused, and what is said of them.
const REFUSED: [(&str, &str, &[&str]); 11] = [
    (
        "empty.json",
        "",
        &["line 1, column 1: expected an object", "found nothing"],
    ),
    (
        "list.json",
        "[]",
        &["line 1, column 1: expected an object", "found a list"],
    ),
    (
        "spec.yaml",
        "# of a bench\nsystem:\n  kind: dimm\n",
        &[
            "line 2, column 1: expected an object",
            "found `system:`",
            "YAML",
        ],
    ),
    (
        "spec.toml",
        "[system]\nkind = \"dimm\"\n",
        &[
            "line 1, column 1: expected an object",
            "found `[system]`",
            "TOML",
        ],
    ),
    (
        "unit.json",
        "{\"system\":{\"kind\":\"dimm\"},\n \"load\":{\"kind\":\"force\",\"n\":\"0.5 N\"}}",
        &[
            "line 2, column ",
            "(/load/n): expected a number, found the text \"0.5 N\"",
            "in the unit of the field's name",
        ],
    ),
    // The comment does not move the place.
    (
        "after-comment.json",
        "{/* 1\n 2 */\n \"cycles\": \"many\"}",
        &["line 3, column 17 (/cycles): expected a count"],
    ),
    ("kind.json", "{}", &["missing field `system`"]),
    (
        "open.json",
        "{\"system\": {\"kind\": \"dimm\"}",
        &["line 1, column 27: EOF"],
    ),
    (
        "quotes.json",
        "{'system': 1}",
        &["line 1, column 2: key must be a string"],
    ),
    ("comment.json", "{} / 2", &["line 1, column "]),
    (
        "latin.json",
        "{\"cycles\": 2 \u{b5}}",
        &["line 1, column 14"],
    ),
];

fn is_refused(ran: &Ran, name: &str, words: &[&str]) {
    assert_eq!(ran.code, Some(2), "{name}: {}", ran.stderr);
    assert_eq!(ran.stdout, "", "{name}");
    let (first, _) = ran.stderr.split_once('\n').expect("a line");
    assert!(
        first.starts_with(&format!("fretwear: {name}: ")),
        "{name}: {first}"
    );
    for words in words {
        assert!(
            ran.stderr.contains(words),
            "{name}: {words}: {}",
            ran.stderr
        );
    }
}

#[test]
fn a_document_that_is_no_specification_is_refused_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    for (name, text, words) in REFUSED {
        std::fs::write(folder.path().join(name), text).expect("written");
        is_refused(&fretwear(folder.path(), &["plan", name]), name, words);
        let read = fretwear_reading(folder.path(), &["plan", "-"], text);
        is_refused(&read, "standard input", words);
    }
    let absent = fretwear(folder.path(), &["solve", "absent.json"]);
    is_refused(&absent, "absent.json", &["No such file"]);
}

#[tokio::test]
async fn every_command_reads_standard_input_and_names_it() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let server = Server::start_with(folder, &["--workers", "0"]);
    let faulty = "{\"system\": {\"kind\": \"dimm\"},\n \"cycles\": 0}";
    let commands: [&[&str]; 6] = [
        &["solve", "-"],
        &["plan", "-"],
        &["export", "-"],
        &["study", "-"],
        &[
            "calibrate",
            "-",
            "--rated-cycles",
            "10",
            "--criterion",
            "base_metal",
        ],
        &["submit", "-", "--server", &server.base],
    ];
    for command in commands {
        let ran = fretwear_reading(folder, command, faulty);
        is_refused(&ran, "standard input", &["/cycles: 0 is outside 1 to "]);
    }
    let (_, list) = server.get("/v1/jobs").await;
    assert_eq!(list["jobs"].as_array().map(Vec::len), Some(0), "{list}");
    // The document that is sent has no comments.
    let queued = fretwear_reading(
        folder,
        &["submit", "-", "--server", &server.base],
        WITH_COMMENTS,
    );
    assert_eq!(queued.code, Some(0), "{}", queued.stderr);
    let (_, job) = server
        .get(&format!("/v1/jobs/{}", queued.stdout.trim()))
        .await;
    assert_eq!(job["spec"]["cycles"], 2, "{job}");
}

#[test]
fn comments_and_trailing_commas_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let solved = |text: &str, out: &str| {
        let ran = fretwear_reading(folder.path(), &["solve", "-", "--json", "--out", out], text);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let summary: Value = serde_json::from_str(&ran.stdout).expect("JSON");
        let file = |name: &str| std::fs::read(folder.path().join(out).join(name)).expect(name);
        (
            summary["receptacle"].clone(),
            file("wear-history.csv"),
            file("spec.resolved.json"),
        )
    };
    assert_eq!(
        solved(PLAIN, "plain"),
        solved(WITH_COMMENTS, "with-comments")
    );
}
