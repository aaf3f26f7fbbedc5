//! What the command line writes: results on standard output, everything else on standard error.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use api::problem::Fault;
use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::REFUSED;
use crate::spec;
use crate::spec::{Refused, Resolved};

/// Writes a line on standard output. A reader that has gone (`| head`) is no failure of the work.
pub(super) fn say(line: impl Display) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

/// Writes a line on standard error.
pub(super) fn tell(line: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Reports a failure.
pub(super) fn failed(cause: impl Display) -> ExitCode {
    tell(format_args!("fretwear: {cause}"));
    ExitCode::FAILURE
}

/// Reports a refused specification with all its faults.
pub(super) fn refused(refused: &Refused) -> ExitCode {
    tell(format_args!("fretwear: {refused}"));
    if let Refused::Faults(faults) = refused {
        for Fault { pointer, detail } in faults {
            tell(format_args!("  {pointer}: {detail}"));
        }
    }
    ExitCode::from(REFUSED)
}

/// Reads and resolves the specification in a file; reports why not, with the exit code that belongs to it.
pub(super) fn specification(path: &Path) -> Result<Resolved, ExitCode> {
    let bytes =
        std::fs::read(path).map_err(|cause| failed(format_args!("{}: {cause}", path.display())))?;
    spec::read(&bytes).map_err(|error| refused(&error))
}

/// The same, with a folder for what comes out of it. The folder is made before the work, so that one that cannot be made
/// does not cost a finished run.
pub(super) fn specification_for(path: &Path, out: Option<&Path>) -> Result<Resolved, ExitCode> {
    let resolved = specification(path)?;
    if let Some(folder) = out {
        std::fs::create_dir_all(folder)
            .map_err(|cause| failed(format_args!("{}: {cause}", folder.display())))?;
    }
    Ok(resolved)
}

/// A progress bar on standard error, counting cycles; silent where standard error is no terminal.
pub(super) fn bar(cycles: u64) -> ProgressBar {
    let bar = ProgressBar::new(cycles);
    let template = "{msg:>9} [{bar:40}] {pos}/{len} cycles, {elapsed} gone, {eta} to go";
    // The template is a constant; were it broken, the default bar would do.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
