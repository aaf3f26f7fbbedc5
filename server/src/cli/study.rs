//! `fretwear study SPEC [--out DIR] [--json]`: an accuracy study.

use std::path::Path;

use crate::batch::accuracy;
use crate::batch::accuracy::{Request, RunPlanError, StudyError, report};
use crate::cli::specification;
use crate::cli::terminal::{Ended, failed, failed_at, refused, spinner, write_json, write_out};
use crate::estimate::machine::{CalibrationCache, cache_file};
use crate::program;

pub(super) fn run(spec: &Path, out: Option<&Path>, budget_s: f64, json: bool) -> Ended {
    let resolved = specification::resolved_for(spec, out)?;
    let cache = CalibrationCache::open(cache_file());
    let machine = cache
        .get_or_measure()
        .ok_or_else(|| failed("the machine could not be measured"))?;
    let spinner = spinner();
    let request = Request {
        resolved: &resolved,
        machine,
        program: program::own(),
        budget_s,
    };
    let made = accuracy::make(&request, &mut |run| spinner.set_message(run.to_owned()));
    spinner.finish_and_clear();
    let study = made.map_err(|error| match error {
        StudyError::RunPlan(RunPlanError::Refused(error)) => {
            refused(specification::name(spec), &error)
        }
        error => failed(error),
    })?;
    if json {
        write_json(&study)?;
    } else {
        write_out(report::text(&study))?;
    }
    let Some(folder) = out else {
        return Ok(());
    };
    for document in report::documents(&study).map_err(failed)? {
        let path = folder.join(&document.name);
        std::fs::write(&path, &document.bytes).map_err(|cause| failed_at(&path, &cause))?;
    }
    Ok(())
}
