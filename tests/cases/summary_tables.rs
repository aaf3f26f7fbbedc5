//! Requirement: `solve`, `watch` and `submit --watch` end with tables that an engineer reads, lives first, with the figures of the document
//! that `--json` writes.

use std::path::Path;

use serde_json::Value;
use tests::{Ran, Server, fretwear};

/// A plated contact, through the gold of its tip and no further.
const PLATED: &str = r#"{
    "name": "tip of gold",
    "system": {"kind": "sd_card"},
    "plating": {"slider": [{"material": "hard_gold", "thickness_um": 0.05, "wear": {"law": "archard", "k_over_h_per_mpa": 1e-7}}]},
    "interface": {"wear": {"slider": {"law": "archard", "k_over_h_per_mpa": 1e-7}}},
    "life": {"coefficient_of_variation": 0.2, "contacts": 24,
        "criteria": [{"kind": "base_metal", "side": "slider"}, {"kind": "worn_depth", "mm": 0.01, "side": "receptacle"}]},
    "cycles": 400,
    "accuracy": {"preset": "draft"}
}"#;

/// A ring that turns on a block: without cycles and lives.
const CONTINUOUS: &str = r#"{"system":{"kind":"cylinder_on_flat"},
    "motion":{"kind":"continuous","speed_mm_s":1,"distance_mm":1},
    "interface":{"wear":{"slider":null}},
    "accuracy":{"preset":"draft","estimate_errors":false}}"#;

/// The cell of a column in the row that begins with some cells.
fn cell<'a>(tables: &'a str, first: &[&str], column: &str) -> &'a str {
    let cells = |line: &'a str| -> Vec<&'a str> {
        let line = line.trim_matches('|');
        line.split('|').map(str::trim).collect()
    };
    for table in tables.split("\n\n") {
        let mut lines = table.lines().map(cells);
        let header = lines.next().unwrap_or_default();
        if let Some(row) = lines.find(|cells| cells.starts_with(first)) {
            let index = header.iter().position(|name| *name == column);
            return row[index.unwrap_or_else(|| panic!("no column {column} in\n{tables}"))];
        }
    }
    panic!("no row {first:?} in\n{tables}")
}

/// A figure of a table is that of the document, as far as it is written out.
fn agrees(cell: &str, value: &Value, scale: f64) {
    let (shown, exact): (f64, f64) = (
        cell.parse().expect(cell),
        scale * value.as_f64().expect("a number"),
    );
    // Four digits at least.
    assert!(
        (shown - exact).abs() <= 6e-4 * exact.abs(),
        "{cell}: {exact}"
    );
}

/// Everything but the times of the run.
fn without_cost(ran: &Ran) -> Vec<&str> {
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.stdout
        .lines()
        .filter(|line| !line.ends_with(" MiB"))
        .collect()
}

fn solved(folder: &Path, json: bool) -> Ran {
    let arguments = ["solve", "spec.json", "--json"];
    fretwear(folder, &arguments[..if json { 3 } else { 2 }])
}

/// Asserts that tables show the figures of a document.
fn shows_figures(tables: &str, document: &Value) {
    let [reached, missing] = [&document["life"][0], &document["life"][1]];
    assert_eq!(reached["status"], "reached", "{reached}");
    for (column, value) in [
        ("cycles", &reached["cycles"]),
        ("b10", &reached["band"]["b10"]),
        ("b90", &reached["band"]["b90"]),
        (
            "first of 24, b10",
            &reached["band"]["first_of_contacts_b10"],
        ),
        (
            "99 % of connectors",
            &reached["at_reliability"][1]["of_contacts"],
        ),
        ("hours", &reached["duration_h"]),
    ] {
        agrees(cell(tables, &["base_metal", "slider"], column), value, 1.0);
    }
    let depth = ["worn_depth, 0.01 mm", "receptacle"];
    assert_eq!(cell(tables, &depth, "cycles"), "not reached", "{tables}");
    let reason = missing["reason"].as_str().expect("a reason");
    let reason = format!("\nworn_depth, 0.01 mm (receptacle): {reason}\n");
    assert!(tables.contains(&reason), "{tables}");
    // No mission is repeated.
    assert!(!tables.contains("repetitions"), "{tables}");
    for side in ["slider", "receptacle"] {
        let shown = cell(tables, &["deepest wear, µm"], side);
        agrees(shown, &document[side]["max_depth_mm"], 1e3);
    }
    let peak = |column: &str| cell(tables, &["peak pressure, MPa"], column);
    agrees(
        peak("unworn"),
        &document["initial"]["peak_pressure_mpa"],
        1.0,
    );
    agrees(peak("at the end"), &document["peak_pressure_mpa"], 1.0);
}

#[tokio::test]
async fn a_solve_ends_with_its_lives_and_a_watch_with_the_same_tables() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    std::fs::write(folder.join("spec.json"), PLATED).expect("written");
    let ran = solved(folder, false);
    let document: Value = serde_json::from_str(&solved(folder, true).stdout).expect("JSON");
    let tables = ran.stdout.as_str();
    assert!(
        tables.starts_with("tip of gold: completed after 400 cycles, "),
        "{tables}"
    );
    assert!(tables.contains("first of 24, b10"), "{tables}");
    // Lives first.
    let place = |words: &str| {
        tables
            .find(words)
            .unwrap_or_else(|| panic!("no {words} in\n{tables}"))
    };
    let order = [
        "life until",
        "| wear",
        "| contact",
        "estimated errors: ",
        " MiB",
    ]
    .map(place);
    assert!(order.is_sorted(), "{tables}");

    shows_figures(tables, &document);

    let server = Server::start(folder);
    let at = ["--server", server.base.as_str()];
    let followed = fretwear(
        folder,
        &[&["submit", "spec.json", "--watch"], &at[..]].concat(),
    );
    assert_eq!(without_cost(&followed), without_cost(&ran));
    let (_, list) = server.get("/v1/jobs").await;
    let id = list["jobs"][0]["id"].as_str().expect("an id");
    let watched = fretwear(folder, &[&["watch", id], &at[..]].concat());
    assert_eq!(watched.stdout, followed.stdout);
    let watched = fretwear(folder, &[&["watch", id, "--json"], &at[..]].concat());
    let summary: Value = serde_json::from_str(&watched.stdout).expect("JSON");
    assert_eq!(summary["life"], document["life"]);
    // The document of a job that is not followed.
    let queued = fretwear(
        folder,
        &[&["submit", "spec.json", "--json"], &at[..]].concat(),
    );
    let job: Value = serde_json::from_str(&queued.stdout).expect("JSON");
    assert_eq!(job["spec"]["name"], "tip of gold", "{job}");
}

#[test]
fn a_continuous_motion_has_millimetres_instead_of_cycles() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), CONTINUOUS).expect("written");
    let ran = solved(folder.path(), false);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        ran.stdout.starts_with("completed after 1 mm of sliding\n"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains("errors were not estimated"),
        "{}",
        ran.stdout
    );
}

#[test]
fn a_warning_of_the_plan_is_said_once_at_the_start_and_stays_in_the_document() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let spec = r#"{"system":{"kind":"zif"},"cycles":5,"accuracy":{"preset":"draft","estimate_errors":false}}"#;
    std::fs::write(folder.path().join("spec.json"), spec).expect("written");
    let solved = fretwear(folder.path(), &["solve", "spec.json", "--json"]);
    assert_eq!(solved.code, Some(0), "{}", solved.stderr);
    let words = "it is beyond its limit and not simulated";
    let lines = solved.stderr.lines();
    let said: Vec<_> = lines
        .filter(|line| line.contains("across_width: ") && line.contains(words))
        .collect();
    assert_eq!(said.len(), 1, "{}", solved.stderr);
    let document: Value = serde_json::from_str(&solved.stdout).expect("a document");
    let warnings = document["warnings"].to_string();
    assert!(
        warnings.contains("across_width: it is beyond"),
        "{warnings}"
    );
}
