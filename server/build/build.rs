//! Content of the program besides its code: the commit that it is built from, the dashboard and the book.

mod assets;
mod book;
mod postgresql;

use std::process::Command;

fn main() -> std::io::Result<()> {
    println!("cargo::rerun-if-changed=build");
    assets::embed()?;
    postgresql::find();
    println!("cargo::rerun-if-env-changed=FRETWEAR_COMMIT");
    // The log of HEAD grows with each commit and checkout; in a copy without it the commit is not known.
    println!("cargo::rerun-if-changed=../.git/logs/HEAD");
    let given = std::env::var("FRETWEAR_COMMIT").ok();
    let commit = given.or_else(head).unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=FRETWEAR_COMMIT={commit}");
    Ok(())
}

fn head() -> Option<String> {
    let arguments = ["rev-parse", "--short=12", "HEAD"];
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success()).then(|| text.trim().to_owned())
}
