//! Requirement: in a terminal, `solve` starts a solve that is expected to take more than an hour only with `--yes`, and says how long it
//! takes; a short one starts without.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command};

use nix::pty::openpty;
use tests::binary;

const SHORT: &str =
    r#"{"system":{"kind":"cylinder_on_flat"},"cycles":20,"accuracy":{"preset":"draft"}}"#;
const LONG: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":100000000,
    "accuracy":{"preset":"draft","overrides":{"cycle_jump":1}}}"#;

/// A command in a terminal of its own, and what the terminal shows.
struct InTerminal {
    child: Child,
    screen: File,
    shown: String,
}

impl InTerminal {
    fn solve(folder: &Path, spec: &str, options: &[&str]) -> Self {
        std::fs::write(folder.join("spec.json"), spec).expect("written");
        let terminal = openpty(None, None).expect("a terminal");
        let own = || File::from(terminal.slave.try_clone().expect("a handle"));
        let child = Command::new(binary())
            .args(["solve", "spec.json"])
            .args(options)
            .current_dir(folder)
            // The speed of the machine is measured once for all of them.
            .env("XDG_CACHE_HOME", folder)
            .stdin(own())
            .stdout(own())
            .stderr(own())
            .spawn()
            .expect("it can be started");
        Self {
            child,
            screen: File::from(terminal.master),
            shown: String::new(),
        }
    }

    /// Reads until the terminal has shown some words; false if the command ends before.
    fn shows(&mut self, words: &str) -> bool {
        let mut bytes = [0; 4096];
        while !self.shown.contains(words) {
            match self.screen.read(&mut bytes) {
                // No process has the terminal any more.
                Ok(0) | Err(_) => return false,
                Ok(read) => self.shown += &String::from_utf8_lossy(&bytes[..read]),
            }
        }
        true
    }
}

#[test]
fn a_solve_of_hours_needs_to_be_confirmed() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let mut refused = InTerminal::solve(folder, LONG, &[]);
    assert!(
        refused.shows("h of processor time on this machine; start it with --yes"),
        "{}",
        refused.shown
    );
    assert_eq!(refused.child.wait().expect("it ends").code(), Some(2));

    let mut short = InTerminal::solve(folder, SHORT, &[]);
    assert!(short.shows("completed after 20 cycles"), "{}", short.shown);
    assert_eq!(short.child.wait().expect("it ends").code(), Some(0));

    let mut confirmed = InTerminal::solve(folder, LONG, &["--yes"]);
    assert!(
        confirmed.shows("h of processor time on this machine"),
        "{}",
        confirmed.shown
    );
    assert!(confirmed.shows("/100000000 cycles"), "{}", confirmed.shown);
    confirmed.child.kill().expect("it runs");
    confirmed.child.wait().expect("it ends");
}
