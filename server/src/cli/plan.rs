//! `fretwear plan SPEC`.

use std::path::Path;

use api::plan::PlanDocument;

use crate::cli::terminal::{Ended, specification, write_json};
use crate::estimate::Estimate;
use crate::estimate::machine::{CalibrationCache, cache_file};

pub(super) fn run(spec: &Path) -> Ended {
    let resolved = specification(spec)?;
    let cache = CalibrationCache::open(cache_file());
    let machine = cache.get_or_measure().cloned();
    let plan = Estimate::of(&resolved).plan(&resolved, machine.as_ref());
    write_json(&PlanDocument {
        spec: resolved.spec,
        plan,
        machine,
    })
}
