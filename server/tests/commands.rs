//! Output and exit codes of commands that end by themselves.

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::{Value, json};
use tempfile::TempDir;

const FRETWEAR: &str = env!("CARGO_BIN_EXE_fretwear");

fn folder() -> TempDir {
    TempDir::new().expect("a temporary folder")
}

fn solve(spec: &str, arguments: &[&str]) -> (Output, TempDir) {
    let folder = folder();
    let path: PathBuf = folder.path().join("spec.json");
    std::fs::write(&path, spec).expect("a file");
    let output = Command::new(FRETWEAR)
        .arg("solve")
        .arg(&path)
        .args(arguments)
        .current_dir(folder.path())
        .output()
        .expect("a run");
    (output, folder)
}

#[test]
fn rejected_specifications_exit_with_2_and_all_faults() {
    let spec = r#"{"frobnicate":1,"system":{"kind":"cylinder_on_flat","radius_mm":-6},"materials":{"slider":"cheese"}}"#;
    let (output, _folder) = solve(spec, &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let stderr = String::from_utf8(output.stderr).expect("text");
    for pointer in ["/frobnicate", "/system/radius_mm", "/materials/slider"] {
        assert!(stderr.contains(pointer), "{stderr}");
    }
    let (output, _folder) = solve(r#"{"system":{"kind":"dimm"},"cycles":NaN}"#, &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        String::from_utf8(output.stderr)
            .expect("text")
            .contains("line 1, column")
    );
}

#[test]
fn solve_writes_summary_and_files() {
    let study = json!({
        "system": {"kind": "fuzz_button"},
        "cycles": 2,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}},
        "output": {"snapshots_at_cycles": [1, 2]}
    });
    let (output, folder) = solve(&study.to_string(), &["--json", "--out", "results"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let summary: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(summary["cycles_done"], 2);
    assert!(summary["cost"]["wall_s"].as_f64() > Some(0.0));
    assert!(summary["cost"]["peak_memory_mb"].as_f64() > Some(1.0));
    for name in [
        "summary.json",
        "spec.resolved.json",
        "wear-history.csv",
        "profile-2.csv",
        "pressure-2.csv",
        "loop-1.csv",
    ] {
        assert!(folder.path().join("results").join(name).is_file(), "{name}");
    }
}

#[test]
fn addresses_other_than_loopback_are_rejected() {
    let folder = folder();
    let output = Command::new(FRETWEAR)
        .args(["serve", "--listen", "0.0.0.0:0"])
        .current_dir(folder.path())
        .output()
        .expect("a run");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        String::from_utf8(output.stderr)
            .expect("text")
            .contains("not a loopback address")
    );
}
