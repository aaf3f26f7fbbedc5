//! `fretwear plan SPEC`.

use std::path::Path;
use std::process::ExitCode;

use api::plan::PlanDocument;

use crate::cli::terminal::{failed, specification, write_out};
use crate::estimate::Estimate;
use crate::estimate::machine::{CalibrationCache, cache_file};

pub(super) fn run(spec: &Path) -> ExitCode {
    let resolved = match specification(spec) {
        Ok(resolved) => resolved,
        Err(code) => return code,
    };
    let cache = CalibrationCache::open(cache_file());
    let machine = cache.get_or_measure().cloned();
    let plan = Estimate::of(&resolved).plan(&resolved, machine.as_ref());
    match serde_json::to_string_pretty(&PlanDocument {
        spec: resolved.spec,
        plan,
        machine,
    }) {
        Ok(text) => {
            write_out(text);
            ExitCode::SUCCESS
        }
        Err(cause) => failed(cause),
    }
}
