//! Requirement: `fretwear study` solves one scene at many accuracies and shows cost and error of each:
//! table, Pareto front, observed orders, work-precision picture.

use serde_json::Value;
use tests::fretwear;

/// A short fretting test: some hundred cycles of a cylinder on a flat.
const SPEC: &str = r#"{
  "name": "short fretting test",
  "system": {"kind": "cylinder_on_flat", "radius_mm": 6.0, "flat_length_mm": 12.0, "flat_height_mm": 6.0},
  "interface": {"wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 2.9e-8}}},
  "load": {"kind": "line_force", "n_per_mm": 18.5},
  "motion": {"kind": "reciprocating", "amplitude_mm": 0.025, "frequency_hz": 20, "drive": "receptacle_base"},
  "cycles": 300,
  "accuracy": {"preset": "draft"}
}"#;

#[test]
fn an_accuracy_study_shows_error_against_cost() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), SPEC).expect("a file can be written");
    let arguments = ["study", "spec.json", "--out", "results", "--budget-s", "8"];
    let ran = fretwear(folder.path(), &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stdout.contains("Pareto front"), "{}", ran.stdout);

    let results = folder.path().join("results");
    let read = |name: &str| std::fs::read_to_string(results.join(name)).expect(name);
    let study: Value = serde_json::from_str(&read("study.json")).expect("the study is JSON");
    let runs = study["runs"].as_array().expect("runs");
    let (chosen, fixed): (Vec<&Value>, Vec<&Value>) =
        runs.iter().partition(|run| run["tolerance"].is_number());
    assert!(chosen.len() >= 3 && fixed.len() >= 9, "{}", ran.stdout);
    let promised = |run: &Value| {
        let error = |what: &str| run["errors"][what].as_f64().expect("an error");
        error("depth").max(error("width"))
    };
    let tolerance = |run: &Value| run["tolerance"].as_f64().expect("a number");
    let by_tolerance = |a: &&&Value, b: &&&Value| tolerance(a).total_cmp(&tolerance(b));
    let tightest = chosen.iter().min_by(by_tolerance).expect("some");
    let loosest = chosen.iter().max_by(by_tolerance).expect("some");
    // Differences below the uncertainty of the reference are not significant.
    let doubt = |what: &str| {
        let doubts = &study["reference"]["uncertainty"];
        doubts[what].as_f64().expect("a doubt")
    };
    assert!(
        promised(tightest) <= promised(loosest) + doubt("depth") + doubt("width"),
        "{}",
        ran.stdout
    );

    // The front: more expensive means more accurate, and no other run is both cheaper and more accurate.
    let front: Vec<&Value> = runs.iter().filter(|run| run["on_front"] == true).collect();
    assert!(front.is_sorted_by(|a, b| promised(a) > promised(b)));
    for run in runs {
        assert!(run["cpu_s"].as_f64().expect("a cost") > 0.0);
        assert!(run["peak_memory_mb"].as_f64().expect("memory") > 1.0);
    }
    let orders = study["reference"]["orders"].as_array().expect("orders");
    assert!(!orders.is_empty(), "{}", study["reference"]);

    let lines = read("study.csv").lines().count();
    assert_eq!(lines, runs.len() + 1);
    let picture = read("study.svg");
    for title in [
        "processor time (s)",
        "error in worn depth and scar width (%)",
        "short fretting test",
    ] {
        assert!(picture.contains(title), "{title}");
    }
}
