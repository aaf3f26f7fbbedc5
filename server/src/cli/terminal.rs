//! Output of the command line: results on standard output, everything else on standard error.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use api::problem::Fault;
use indicatif::{ProgressBar, ProgressStyle};

use crate::spec;
use crate::spec::{Refused, Resolved};

/// Exit code of a refused specification.
const REFUSED: u8 = 2;

/// Writes a line on standard output. A closed pipe (`| head`) is not an error.
pub(super) fn write_out(line: impl Display) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

/// Writes a line on standard error.
pub(super) fn write_err(line: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Reports a failure; returns its exit code.
pub(super) fn failed(cause: impl Display) -> ExitCode {
    write_err(format_args!("fretwear: {cause}"));
    ExitCode::FAILURE
}

/// Reports a refused specification with all its faults; returns its exit code.
pub(super) fn refused(refused: &Refused) -> ExitCode {
    write_err(format_args!("fretwear: {refused}"));
    if let Refused::Faults(faults) = refused {
        for Fault { pointer, detail } in faults {
            write_err(format_args!("  {pointer}: {detail}"));
        }
    }
    ExitCode::from(REFUSED)
}

/// Reads and resolves the specification in a file; reports a failure and returns its exit code.
pub(super) fn specification(path: &Path) -> Result<Resolved, ExitCode> {
    let bytes =
        std::fs::read(path).map_err(|cause| failed(format_args!("{}: {cause}", path.display())))?;
    spec::read(&bytes).map_err(|error| refused(&error))
}

/// The same, with a folder for the results. The folder is created before the solve, so that a failure to create it does
/// not waste a finished run.
pub(super) fn specification_for(path: &Path, out: Option<&Path>) -> Result<Resolved, ExitCode> {
    let resolved = specification(path)?;
    if let Some(folder) = out {
        std::fs::create_dir_all(folder)
            .map_err(|cause| failed(format_args!("{}: {cause}", folder.display())))?;
    }
    Ok(resolved)
}

/// Returns a progress bar of cycles on standard error; silent where standard error is no terminal.
pub(super) fn bar(cycles: u64) -> ProgressBar {
    let bar = ProgressBar::new(cycles);
    let template = "{msg:>9} [{bar:40}] {pos}/{len} cycles, {elapsed} elapsed, {eta} left";
    // The template is a constant; if it is invalid, the default template is used.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
