//! `fretwear solve-child`: a service's solving process.
//!
//! One line on standard input is the resolved specification; every line on standard output is a [`Line`]. Standard
//! input stays open as long as the supervisor lives: at its end this process ends too. Large results are written into
//! the attempt's folder, and the lines only name them.

use std::io::{BufRead, Read, Write};
use std::path::Path;
use std::process::ExitCode;

use api::job::Outcome;
use solver::observer::Flow;

use super::terminal::{failed, refused, tell};
use crate::documents::VTU;
use crate::files;
use crate::solve::{self, Failure, FieldsFile, Line, UNWRITTEN};
use crate::translate;

/// Exit code when the supervisor is gone.
const ORPHANED: i32 = 3;

pub(super) fn run(folder: &Path) -> ExitCode {
    let mut spec = String::new();
    if let Err(cause) = std::io::stdin().lock().read_line(&mut spec) {
        return failed(cause);
    }
    let resolved = match translate::read(spec.as_bytes()) {
        Ok(resolved) => resolved,
        Err(error) => {
            write(&Line::Failed(Failure {
                outcome: Outcome::NotConverged,
                reason: error.to_string(),
            }));
            return refused(&error);
        }
    };
    std::thread::spawn(end_with_supervisor);
    let solved = solve::run(&resolved.scene, &mut |line| match line {
        Line::Fields(fields) => keep(folder, &fields),
        line => write(&line),
    });
    let last = match solved {
        Ok(summary) => Line::Summary(Box::new(summary)),
        Err(failure) => Line::Failed(failure),
    };
    match write(&last) {
        Flow::Continue => ExitCode::SUCCESS,
        Flow::Stop => ExitCode::FAILURE,
    }
}

/// Blocks until standard input ends, then ends the process.
fn end_with_supervisor() {
    let mut rest = [0_u8; 64];
    let mut stdin = std::io::stdin().lock();
    while stdin.read(&mut rest).is_ok_and(|length| length > 0) {}
    std::process::exit(ORPHANED);
}

/// Writes fields into the attempt's folder and tells of the file. A disk that takes no more is no fault of the study:
/// the process ends without a verdict, and another attempt is made.
fn keep(folder: &Path, fields: &FieldsFile) -> Flow {
    if let Err(error) = files::keep(folder, &fields.name, &fields.bytes) {
        tell(error);
        std::process::exit(UNWRITTEN);
    }
    let FieldsFile { name, cycle, bytes } = fields;
    write(&Line::Kept(files::described(
        name,
        Some(*cycle),
        VTU,
        bytes,
    )))
}

/// Writes a line; a supervisor that does not read any more stops the run.
fn write(line: &Line) -> Flow {
    let Ok(mut bytes) = serde_json::to_vec(line) else {
        return Flow::Stop;
    };
    bytes.push(b'\n');
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(&bytes).and_then(|()| stdout.flush()) {
        Ok(()) => Flow::Continue,
        Err(_) => Flow::Stop,
    }
}
