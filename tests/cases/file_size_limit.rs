//! Requirement: a limit on the size of files (`ulimit -f`) is an error with a sentence that names the file. It ends no process without
//! a line.

use std::path::Path;
use std::process::Command;

use tests::program::binary;

/// Exit code and standard error of a command whose files may have 512 or 1024 bytes, as the shell counts.
fn limited(folder: &Path, arguments: &str) -> (Option<i32>, String) {
    let command = format!("ulimit -f 1; exec \"$0\" {arguments}");
    let ended = Command::new("sh")
        .args(["-c", &command])
        .arg(binary())
        .current_dir(folder)
        .output()
        .expect("a shell");
    let stderr = String::from_utf8_lossy(&ended.stderr).into_owned();
    (ended.status.code(), stderr)
}

#[test]
fn files_that_would_be_too_large_are_named() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let spec = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,"accuracy":{"preset":"draft"}}"#;
    std::fs::write(folder.path().join("spec.json"), spec).expect("a file can be written");
    let (code, stderr) = limited(folder.path(), "solve spec.json --out results");
    assert_eq!(code, Some(1), "{stderr}");
    assert!(
        stderr.contains("results/") && stderr.contains("too large"),
        "{stderr}"
    );
    let (code, stderr) = limited(folder.path(), "serve --listen 127.0.0.1:0 --workers 0");
    assert_eq!(code, Some(1), "{stderr}");
    assert!(stderr.contains("fretwear: "), "{stderr}");
}
