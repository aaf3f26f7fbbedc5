//! Requirement: `fretwear solve` runs the published fretting case and writes the files that the contract names.

use std::process::Command;

use serde_json::Value;
use tests::{binary, fretwear, spec};

/// Cycles and the depths of the flat that two published codes give, um.
const REFERENCE: [(u64, f64); 4] = [
    (1_000, 0.3755),
    (5_000, 1.128),
    (10_000, 1.8115),
    (18_000, 2.7095),
];

#[test]
fn solve_follows_the_published_depths_and_writes_its_files() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mccoll = spec("mccoll.json");
    let mccoll = mccoll.to_str().expect("the path is text");
    let ran = fretwear(
        folder.path(),
        &["solve", mccoll, "--json", "--out", "results"],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("the summary is JSON");
    let ratio = |side: &Value| {
        side["worn_area_mm2"].as_f64().expect("worn")
            / side["ideal_area_mm2"].as_f64().expect("ideal")
    };
    let flat = ratio(&summary["receptacle"]);
    assert!((0.955..0.985).contains(&flat), "{flat}");
    // Hertz: 0.03586 mm and 328.4 MPa.
    let initial = &summary["initial"];
    let off =
        |value: &Value, expected: f64| (value.as_f64().expect("a number") / expected - 1.0).abs();
    assert!(
        off(&initial["contact_half_width_mm"], 0.03586) < 0.02,
        "{initial}"
    );
    assert!(
        off(&initial["peak_pressure_mpa"], 328.4) < 0.02,
        "{initial}"
    );

    let results = folder.path().join("results");
    for (cycle, depth) in REFERENCE {
        let profile = std::fs::read_to_string(results.join(format!("profile-{cycle}.csv")))
            .expect("a profile was asked for");
        let deepest = deepest_of_receptacle(&profile);
        assert!(
            (1e3 * deepest / depth - 1.0).abs() < 0.05,
            "{cycle}: {deepest}"
        );
        for part in ["pressure", "loop"] {
            assert!(
                results.join(format!("{part}-{cycle}.csv")).exists(),
                "{part} {cycle}"
            );
        }
    }
    for picture in ["wear-history", "profiles", "pressure", "loops"] {
        assert!(results.join(format!("{picture}.svg")).exists(), "{picture}");
    }
    for name in ["summary.json", "spec.resolved.json", "wear-history.csv"] {
        assert!(results.join(name).exists(), "{name}");
    }
}

/// Largest depth among the lines of the receptacle.
fn deepest_of_receptacle(profile: &str) -> f64 {
    let depths = profile
        .lines()
        .filter(|line| line.starts_with("receptacle"))
        .filter_map(|line| line.rsplit(',').next()?.parse::<f64>().ok());
    depths.fold(0.0, f64::max)
}

#[test]
fn the_smallest_specification_is_enough() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let minimal = spec("minimal.json");
    let ran = fretwear(
        folder.path(),
        &[
            "solve",
            minimal.to_str().expect("the path is text"),
            "--json",
        ],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("the summary is JSON");
    assert_eq!(summary["outcome"], "completed");
    assert!(
        summary["receptacle"]["max_depth_mm"]
            .as_f64()
            .expect("a depth")
            > 0.0
    );
}

#[test]
fn results_that_cannot_be_written_are_a_failure() {
    let full = std::fs::File::options().write(true).open("/dev/full");
    let full = full.expect("Linux has it");
    let folder = tempfile::tempdir().expect("a folder can be made");
    let spec = folder.path().join("spec.json");
    let text = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,"accuracy":{"preset":"draft"}}"#;
    std::fs::write(&spec, text).expect("written");
    for command in ["solve", "plan", "export"] {
        let ran = Command::new(binary())
            .arg(command)
            .arg(&spec)
            .stdout(full.try_clone().expect("a handle"))
            .output()
            .expect("it can be started");
        assert_eq!(ran.status.code(), Some(1), "{command}");
        let said = String::from_utf8_lossy(&ran.stderr);
        assert!(
            said.contains("fretwear: standard output: "),
            "{command}: {said}"
        );
    }
}
