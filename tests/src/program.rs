//! The binary under test.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Exit code and output of a command.
#[derive(Debug)]
pub struct Ran {
    /// Exit code; `None` if a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// Path of the binary that `cargo test --workspace` built beside this test.
///
/// # Panics
/// If the tests run outside of cargo's target folder.
pub fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    let deps = test.parent().expect("a test is in a folder");
    let path = deps
        .parent()
        .expect("deps is in the profile's folder")
        .join("fretwear");
    assert!(
        path.exists(),
        "{} is not built; run cargo test --workspace",
        path.display()
    );
    path
}

/// Runs `fretwear` with arguments in a folder, to its end.
///
/// # Panics
/// If it cannot be started.
pub fn fretwear(folder: &Path, arguments: &[&str]) -> Ran {
    fretwear_with(folder, arguments, &[])
}

/// The same with variables of the environment.
///
/// # Panics
/// If it cannot be started.
pub fn fretwear_with(folder: &Path, arguments: &[&str], environment: &[(&str, &Path)]) -> Ran {
    let output = Command::new(binary())
        .current_dir(folder)
        .args(arguments)
        .envs(environment.iter().copied())
        .output()
        .expect("the binary can be started");
    ran(&output)
}

/// The same with a text on its standard input.
///
/// # Panics
/// If it cannot be started.
pub fn fretwear_reading(folder: &Path, arguments: &[&str], input: &str) -> Ran {
    let mut child = Command::new(binary())
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary can be started");
    let mut stdin = child.stdin.take().expect("a pipe was asked for");
    // A command that refuses its arguments does not read it.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    ran(&child.wait_with_output().expect("it ends"))
}

fn ran(output: &Output) -> Ran {
    Ran {
        code: output.status.code(),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// One of the specifications in `tests/specs`.
///
/// # Panics
/// If there is none of that name.
pub fn spec(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("specs")
        .join(name);
    assert!(path.exists(), "{} is missing", path.display());
    path
}

/// `fuzz_button.json` with a given jump, so that a job of it takes a while: 70 s with single cycles.
///
/// # Panics
/// If there is no such specification.
pub fn fuzz_button_with_jump(cycles: u64) -> String {
    let bytes = std::fs::read(spec("fuzz_button.json")).expect("the specification is there");
    let mut spec: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
    spec["accuracy"] = serde_json::json!({"overrides": {"cycle_jump": cycles}});
    spec.to_string()
}
