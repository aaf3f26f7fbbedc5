//! `fretwear study SPEC [--out DIR]`: an accuracy study.

use std::path::Path;
use std::process::ExitCode;

use indicatif::{ProgressBar, ProgressStyle};

use crate::batch::accuracy;
use crate::batch::accuracy::{Request, RunPlanError, StudyError, report};
use crate::cli::terminal::{failed, refused, specification_for, write_out};
use crate::estimate::machine::{CalibrationCache, cache_file};

pub(super) fn run(spec: &Path, out: Option<&Path>, budget_s: f64) -> ExitCode {
    let resolved = match specification_for(spec, out) {
        Ok(resolved) => resolved,
        Err(code) => return code,
    };
    let program = match std::env::current_exe() {
        Ok(program) => program,
        Err(cause) => return failed(format_args!("the path of this program: {cause}")),
    };
    let cache = CalibrationCache::open(cache_file());
    let Some(machine) = cache.get_or_measure() else {
        return failed("the machine could not be measured");
    };
    let spinner = spinner();
    let request = Request {
        resolved: &resolved,
        machine,
        program,
        budget_s,
    };
    let made = accuracy::make(&request, &mut |run| spinner.set_message(run.to_owned()));
    spinner.finish_and_clear();
    let study = match made {
        Ok(study) => study,
        Err(StudyError::RunPlan(RunPlanError::Refused(error))) => return refused(&error),
        Err(error) => return failed(error),
    };
    write_out(report::text(&study));
    let Some(folder) = out else {
        return ExitCode::SUCCESS;
    };
    let documents = match report::documents(&study) {
        Ok(documents) => documents,
        Err(error) => return failed(error),
    };
    for document in documents {
        let path = folder.join(&document.name);
        if let Err(cause) = std::fs::write(&path, &document.bytes) {
            return failed(format_args!("{}: {cause}", path.display()));
        }
    }
    ExitCode::SUCCESS
}

/// Returns a spinner for the present run on standard error; silent where that is no terminal.
fn spinner() -> ProgressBar {
    let spinner = ProgressBar::new_spinner();
    // The template is a constant; if it is invalid, the default template is used.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed} elapsed") {
        spinner.set_style(style);
    }
    spinner.enable_steady_tick(std::time::Duration::from_millis(200));
    spinner
}
