//! Parameter sweeps. The size of a sweep is checked before it is expanded, and the faults of all jobs are reported; of a large one,
//! those of a sample, which has every value of every field as far as its size allows.

mod patch;
pub(super) mod portion;
mod sample;
pub(super) mod table;
mod variations;

use std::collections::{BTreeMap, BTreeSet};

use api::problem::Fault;
use api::sweep::{Sweep, SweepJob, SweepRequest};

use crate::batch::error::EvaluateError;
use crate::batch::kind::Kind;
use crate::batch::sweep::variations::Variations;
use crate::batch::variation::{self, Accept, Variation};
use crate::estimate::Estimate;
use crate::spec::Refused;
use crate::store::{BatchJob, BatchPart, StoredBatch};

/// Largest number of jobs of a grid.
const GRID_LIMIT: u64 = 1_000_000;
/// Largest number of jobs of a list, and of a grid that is queued as a whole.
const WHOLE_LIMIT: u64 = 1_000;
/// Jobs of a larger grid that are queued at once.
const FIRST_JOBS: u64 = 250;
/// Largest number of pointers that a job of a sweep changes.
const CHANGE_LIMIT: usize = 32;
/// Largest size of all specifications that are queued at once, bytes.
const EXPANDED_LIMIT: u64 = 32 << 20;
/// Largest number of reported faults.
const FAULT_LIMIT: usize = 100;

/// The jobs of a sweep.
#[derive(Debug)]
pub(super) struct Expanded {
    /// Those that are queued at once, in order.
    pub(super) first: Vec<Variation>,
    /// Estimates of some of the later ones.
    pub(super) sample: Vec<Estimate>,
    /// Number of all.
    pub(super) jobs: u64,
}

/// Returns the number of jobs of a sweep, and the estimates of some of them.
///
/// # Errors
/// [`Refused`] for sizes beyond the limits, and with the faults of these jobs.
pub(super) fn sampled(request: &SweepRequest) -> Result<(u64, Vec<Estimate>), Refused> {
    check_size(request).map_err(Refused::Faults)?;
    let variations = Variations::of(request);
    let jobs = variations.len();
    let (mut some, mut faults) = (Vec::new(), BTreeSet::new());
    for position in sample::timed(jobs) {
        match variations.at(position) {
            Ok(variation) => some.push(variation.estimate),
            Err(found) => faults.extend(found),
        }
    }
    refuse(faults)?;
    Ok((jobs, some))
}

/// Returns the first jobs of a sweep, in order.
///
/// # Errors
/// [`Refused`] for sizes beyond the limits, and with the faults of the sweep, or of the jobs it would make.
pub(super) fn expand(request: &SweepRequest, accept: &Accept<'_>) -> Result<Expanded, Refused> {
    check_size(request).map_err(Refused::Faults)?;
    let variations = Variations::of(request);
    let jobs = variations.len();
    let at_once = jobs_at_once(jobs);
    let later = (at_once < jobs).then(|| sample::positions(request, at_once..jobs));
    let (mut first, mut sample, mut faults) = (Vec::new(), Vec::new(), BTreeSet::new());
    for position in (0..at_once).chain(later.into_iter().flatten()) {
        match variations.at(position) {
            Ok(variation) if position < at_once => first.push(variation),
            Ok(variation) => sample.push(variation.estimate),
            Err(found) => faults.extend(found),
        }
        if faults.len() >= FAULT_LIMIT {
            break;
        }
    }
    refuse(faults)?;
    let estimates = first.iter().map(|variation| &variation.estimate);
    estimates.chain(&sample).try_for_each(accept)?;
    Ok(Expanded {
        first,
        sample,
        jobs,
    })
}

/// Refuses faults, if there are any: each a pointer and its detail.
fn refuse(faults: BTreeSet<(String, String)>) -> Result<(), Refused> {
    if faults.is_empty() {
        return Ok(());
    }
    let reported = faults.into_iter().take(FAULT_LIMIT);
    let faults = reported.map(|(pointer, detail)| Fault { pointer, detail });
    Err(Refused::Faults(faults.collect()))
}

/// Number of jobs of a sweep that are queued when it is submitted.
fn jobs_at_once(jobs: u64) -> u64 {
    if jobs <= WHOLE_LIMIT {
        jobs
    } else {
        FIRST_JOBS
    }
}

/// Returns a part of a stored batch as a sweep.
///
/// # Errors
/// [`EvaluateError::Corrupt`] if its request cannot be read.
pub(super) fn document(batch: StoredBatch, part: BatchPart) -> Result<Sweep, EvaluateError> {
    let overview = batch.overview;
    let request = batch.request.as_deref().map(serde_json::from_str);
    let request: Option<SweepRequest> =
        request
            .transpose()
            .map_err(|cause| EvaluateError::Corrupt {
                id: overview.id,
                what: "request",
                cause,
            })?;
    let mut links = Kind::Sweep.links(overview.id);
    let is_full = batch.jobs.len() >= usize::try_from(part.limit).unwrap_or(usize::MAX);
    if let Some(last) = batch.jobs.last().filter(|_| is_full) {
        let (own, from, limit) = (&links["self"], last.position + 1, part.limit);
        links.insert(
            "next".to_owned(),
            format!("{own}?from={from}&limit={limit}"),
        );
    }
    let shown = |job: BatchJob| SweepJob {
        id: job.id,
        position: job.position,
        overrides: job.overrides,
        status: job.status,
        outcome: job.outcome,
    };
    Ok(Sweep {
        id: overview.id,
        name: overview.name,
        created_at: overview.created_at,
        counts: overview.counts,
        asked: overview.asked,
        grid: request.and_then(|request| request.grid),
        to_come: overview.to_come,
        never_queued: overview.never_queued,
        refused: overview.refused,
        jobs: batch.jobs.into_iter().map(shown).collect(),
        refused_changes: batch.refused,
        links,
    })
}

/// Checks how large a sweep would become.
fn check_size(request: &SweepRequest) -> Result<(), Vec<Fault>> {
    let mut faults = Vec::from_iter(variation::name_fault(request.name.as_deref()));
    let mut fault = |pointer: &str, detail: String| faults.push(Fault::new(pointer, detail));
    let (pointer, limit, changes) = match (&request.grid, &request.list) {
        (Some(grid), None) => ("/grid", GRID_LIMIT, grid.len()),
        (None, Some(list)) => {
            let changes = list.iter().map(BTreeMap::len).max();
            ("/list", WHOLE_LIMIT, changes.unwrap_or_default())
        }
        _ => {
            fault("", "a sweep has either a `grid` or a `list`".to_owned());
            return Err(faults);
        }
    };
    let jobs = variations::number(request);
    if !(1..=limit).contains(&jobs) {
        fault(
            pointer,
            format!("{jobs} jobs; a {} has 1 to {limit}", &pointer[1..]),
        );
    }
    if request.grid.as_ref().is_some_and(BTreeMap::is_empty) {
        fault(
            pointer,
            "no pointer; a grid has the values of 1 at least".to_owned(),
        );
    }
    if changes > CHANGE_LIMIT {
        let detail = format!("{changes} pointers a job, at most {CHANGE_LIMIT}");
        fault(pointer, detail);
    }
    let size = serde_json::to_string(&request.base).map_or(0, |base| base.len());
    let size = u64::try_from(size).unwrap_or(u64::MAX);
    let expanded = size.saturating_mul(jobs_at_once(jobs));
    if expanded > EXPANDED_LIMIT {
        let detail = format!(
            "{expanded} bytes in the jobs that are queued at once, at most {EXPANDED_LIMIT}"
        );
        fault("/base", detail);
    }
    faults.is_empty().then_some(()).ok_or(faults)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn expanded(text: &Value) -> Result<Vec<Variation>, Vec<Fault>> {
        let request = variation::read(text.to_string().as_bytes());
        let expanded = request.and_then(|request| expand(&request, &|_| Ok(())));
        let variations = expanded.map(|expanded| expanded.first);
        variations.map_err(|refused| match refused {
            Refused::Faults(faults) => faults,
            Refused::Parse(error) => panic!("{error}"),
        })
    }

    #[test]
    fn a_grid_makes_every_combination_and_creates_missing_objects() {
        let variations = expanded(&json!({
            "base": {"system": {"kind": "dimm"}},
            "grid": {"/cycles": [10, 20], "/interface/friction": [
                {"law": "coulomb", "coefficient": 0.3}, {"law": "frictionless"}, null]}
        }))
        .expect("accepted");
        assert_eq!(variations.len(), 6);
        let cycles: Vec<_> = variations.iter().map(|v| v.resolved.scene.cycles).collect();
        assert_eq!(cycles, [10, 10, 10, 20, 20, 20]);
        assert!(variations[1].resolved.spec.interface.friction.is_some());
    }

    #[test]
    fn a_change_within_a_variant_that_the_base_leaves_out_changes_the_preset() {
        let variations = expanded(&json!({
            "base": {"system": {"kind": "dimm"}},
            "list": [{"/load/n": 0.25}, {"/interface/friction/coefficient": 0.5}, {"/accuracy/tolerance": 0.1},
                     {"/materials/slider/hardness_mpa": 900.0}]
        }))
        .expect("accepted");
        let load = variations[0].resolved.spec.load.as_ref().expect("a load");
        assert_eq!(load.n, Some(0.25));
        assert!((variations[1].resolved.scene.friction.unworn() - 0.5).abs() < 1e-15);
        assert_eq!(variations[2].resolved.spec.accuracy.preset, None);
    }

    #[test]
    fn faults_point_to_where_they_were_written() {
        let faults = expanded(&json!({
            "base": {"system": {"kind": "dimm"}, "cycels": 3, "stop": []},
            "list": [{"/cycles": 0}, {"/stop/0/worn_depth_mm": 1.0}, {"cycles": 1}, {"/load/n": "x"}, {"/system/kind/x": 1}]
        }))
        .expect_err("refused");
        let pointers: Vec<_> = faults.iter().map(|fault| fault.pointer.as_str()).collect();
        assert_eq!(
            pointers,
            [
                "/base/cycels",
                "/list/0/~1cycles",
                "/list/1/~1stop~10~1worn_depth_mm",
                "/list/2/cycles",
                "/list/3/~1load~1n",
                "/list/4/~1system~1kind~1x"
            ]
        );
    }

    #[test]
    fn a_sweep_that_would_be_too_large_is_refused_before_it_is_expanded() {
        let values: Vec<u32> = (1..=100).collect();
        let axes = ["/a", "/b", "/c", "/d", "/e", "/f", "/g", "/h", "/i", "/j"];
        let grid: BTreeMap<_, _> = axes.iter().map(|axis| (*axis, &values)).collect();
        let faults = expanded(&json!({"base": {}, "grid": grid})).expect_err("refused");
        assert_eq!(faults[0].pointer, "/grid");
        let base = json!({"name": "x".repeat(100_000)});
        let list: Vec<_> = (0..1000).map(|n| json!({"/cycles": n})).collect();
        let faults = expanded(&json!({"base": base, "list": list})).expect_err("refused");
        assert_eq!(faults[0].pointer, "/base");
        for neither in [
            json!({"base": {}}),
            json!({"base": {}, "grid": {}, "list": []}),
        ] {
            assert_eq!(expanded(&neither).expect_err("refused").len(), 1);
        }
        let no_pointer = json!({"base": {"system": {"kind": "dimm"}}, "grid": {}});
        let faults = expanded(&no_pointer).expect_err("refused");
        assert_eq!((faults.len(), &faults[0].pointer[..]), (1, "/grid"));
        assert_eq!(
            expanded(&json!({"base": {}, "list": []})).expect_err("refused")[0].detail,
            "0 jobs; a list has 1 to 1000"
        );
    }
}
