//! Requirement: a plated contact with a film law answers after how many cycles its resistance passes a limit, shows the resistance over the
//! cycles with its parts, and says what is missing where it cannot.

use serde_json::{Value, json};
use tests::{fretwear, spec};

/// The SD card with both sides plated, at a coarse tolerance, with a film on the base metals.
fn filmed() -> Value {
    let text = std::fs::read(spec("sd_card_plated.json")).expect("the specification is there");
    let mut spec: Value = serde_json::from_slice(&text).expect("JSON");
    spec["accuracy"] = json!({"preset": "draft"});
    spec["interface"]["films"] = json!([{"specific_resistance_ohm_mm2": 1e-5}]);
    spec["life"]["criteria"] =
        json!([{"kind": "resistance", "mohm": 5.0}, {"kind": "base_metal", "side": "slider"}]);
    spec["stop"] = json!([{"kind": "resistance", "mohm": 12.0}]);
    spec
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let headers = lines.next().expect("a header").split(',');
    let index = headers.into_iter().position(|header| header == name);
    let index = index.unwrap_or_else(|| panic!("{name} is a column"));
    let cells = lines.map(|line| line.split(',').nth(index).expect("a cell"));
    cells.map(|cell| cell.parse().expect("a number")).collect()
}

#[test]
fn the_resistance_of_a_filmed_contact_ends_its_life_and_its_run() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), filmed().to_string()).expect("a file");
    let ran = fretwear(
        folder.path(),
        &["solve", "spec.json", "--json", "--out", "results"],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    assert_eq!(summary["outcome"], "stop_condition");
    let resistance = &summary["contact_resistance_mohm"];
    assert!(number(&resistance["initial"]) < 4.0 && number(&resistance["final"]) >= 12.0);
    let [limit, base] = &summary["life"].as_array().expect("a list")[..] else {
        panic!("two criteria: {}", summary["life"]);
    };
    assert_eq!(
        (&limit["status"], &base["status"]),
        (&"reached".into(), &"reached".into())
    );
    // The film is there once the base is exposed; at 12 mOhm it covers more than half of the contact.
    let cycles = number(&limit["cycles"]);
    assert!(cycles > number(&base["cycles"]) && cycles < number(&summary["cycles_done"]));
    let share = number(&limit["band"]["b10"]) / cycles;
    assert!((share - 0.545_87).abs() < 1e-5, "{limit}");
    let read = |name: &str| {
        let path = folder.path().join("results").join(name);
        std::fs::read_to_string(path).expect("a result file")
    };
    let table = read("wear-history.csv");
    let total = column(&table, "contact_resistance_mohm");
    let parts = [
        "slider_constriction_mohm",
        "receptacle_constriction_mohm",
        "film_resistance_mohm",
        "slider_bulk_mohm",
        "receptacle_bulk_mohm",
    ]
    .map(|name| column(&table, name));
    for (row, total) in total.iter().enumerate() {
        let sum: f64 = parts.iter().map(|part| part[row]).sum();
        assert!((sum / total - 1.0).abs() < 1e-9, "{row}: {sum} {total}");
    }
    let filmed = column(&table, "filmed_fraction");
    assert!(filmed[0] <= 0.0 && filmed.last().is_some_and(|last| *last > 0.5));
    let picture = read("life.svg");
    for label in [
        "contact resistance (mOhm)",
        "slider, base metal",
        "b10, b90",
        "limit",
    ] {
        assert!(picture.contains(label), "{label}");
    }
}

#[test]
fn a_resistance_without_a_film_law_is_not_modelled_and_names_what_it_lacks() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut spec = filmed();
    spec["interface"]["films"] = json!([]);
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["solve", "spec.json"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("/stop/0/kind") && ran.stderr.contains("interface.films"));
    spec["stop"] = json!([]);
    spec["cycles"] = json!(200);
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["solve", "spec.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    let entry = &summary["life"][0];
    assert_eq!(entry["status"], "not_modelled", "{entry}");
    let reason = entry["reason"].as_str().expect("a reason");
    assert!(reason.contains("interface.films"), "{reason}");
    assert!(number(&summary["contact_resistance_mohm"]["initial"]) > 0.0);
}
