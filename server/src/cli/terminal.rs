//! Output of the command line: results on standard output, everything else on standard error.

use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use api::problem::Fault;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::spec::Refused;

/// End of a command: the exit code of one that failed, which has been reported.
pub(super) type Ended = Result<(), ExitCode>;

/// Exit code of a specification, file or folder that cannot be used: nothing was solved.
pub(super) const REFUSED: u8 = 2;

/// Writes a line on standard output; reports a failure and returns its exit code. A closed pipe (`| head`) is none.
pub(super) fn write_out(line: impl Display) -> Ended {
    let mut output = std::io::stdout().lock();
    match writeln!(output, "{line}").and_then(|()| output.flush()) {
        Err(cause) if cause.kind() != ErrorKind::BrokenPipe => {
            Err(failed(format_args!("standard output: {cause}")))
        }
        _ => Ok(()),
    }
}

/// Writes a document as JSON on standard output.
pub(super) fn write_json(document: &impl Serialize) -> Ended {
    write_out(serde_json::to_string_pretty(document).map_err(failed)?)
}

/// Writes a line on standard error.
pub(super) fn write_err(line: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{}", printable(&line.to_string()));
}

/// Text without control characters other than new lines: names and reasons of jobs may have some, which act on terminals.
pub(super) fn printable(text: &str) -> String {
    let shown = |c: char| match c {
        '\n' => c,
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    text.chars().map(shown).collect()
}

/// Reports a failure; returns its exit code.
pub(super) fn failed(cause: impl Display) -> ExitCode {
    write_err(format_args!("fretwear: {cause}"));
    ExitCode::FAILURE
}

/// Reports that a file or folder cannot be read or written.
pub(super) fn failed_at(path: &Path, cause: &std::io::Error) -> ExitCode {
    failed(format_args!("{}: {cause}", path.display()))
}

/// Reports what the user can correct; returns its exit code.
pub(super) fn unusable(cause: impl Display) -> ExitCode {
    write_err(format_args!("fretwear: {cause}"));
    ExitCode::from(REFUSED)
}

/// Reports that a file or folder of the arguments cannot be used; returns its exit code.
pub(super) fn unusable_at(path: &Path, cause: &std::io::Error) -> ExitCode {
    unusable(format_args!("{}: {cause}", path.display()))
}

/// Reports a refused specification, which was read from `source`, with all its faults; returns its exit code.
pub(super) fn refused(source: impl Display, refused: &Refused) -> ExitCode {
    let code = unusable(format_args!("{source}: {refused}"));
    let faults = match refused {
        Refused::Parse(error) => &error.others,
        Refused::Faults(faults) => faults,
    };
    for Fault { pointer, detail } in faults {
        write_err(format_args!("  {pointer}: {detail}"));
    }
    code
}

/// Returns a progress bar of cycles on standard error; silent where standard error is no terminal.
pub(super) fn bar(cycles: u64) -> ProgressBar {
    let template = "{msg:>9} [{bar:40}] {pos}/{len} cycles, {elapsed} elapsed, {eta} left";
    styled(ProgressBar::new(cycles), template)
}

/// Returns a spinner for the present run on standard error; silent where that is no terminal.
pub(super) fn spinner() -> ProgressBar {
    styled(
        ProgressBar::new_spinner(),
        "{spinner} {msg}, {elapsed} elapsed",
    )
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    // The template is a constant; if it is invalid, the default template is used.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
