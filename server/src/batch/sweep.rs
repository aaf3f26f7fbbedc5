//! Parameter sweeps. The size of a sweep is checked before it is expanded, and the faults of all jobs are reported.

mod patch;
pub(super) mod table;

use std::collections::{BTreeMap, BTreeSet};

use api::problem::Fault;
use api::spec::pointer_token;
use api::sweep::{Changes, Sweep, SweepJob, SweepRequest};
use serde_json::Value;

use crate::batch::kind::Kind;
use crate::batch::variation::{self, Accept, Variation};
use crate::estimate::Estimate;
use crate::spec::{Refused, Resolved};
use crate::store::{BatchJob, StoredBatch};

/// Largest number of jobs of a sweep.
const JOB_LIMIT: usize = 1000;
/// Largest number of pointers that a job of a sweep changes.
const CHANGE_LIMIT: usize = 32;
/// Largest size of all specifications together, bytes.
const EXPANDED_LIMIT: usize = 32 << 20;
/// Largest number of reported faults.
const FAULT_LIMIT: usize = 100;

/// Returns the jobs of a sweep, in order.
///
/// # Errors
/// [`Refused`] for sizes beyond the limits, and with the faults of the sweep, or of the jobs it would make.
pub(super) fn expand(
    request: &SweepRequest,
    accept: &Accept<'_>,
) -> Result<Vec<Variation>, Refused> {
    check_size(request).map_err(Refused::Faults)?;
    let all = match (&request.grid, &request.list) {
        (Some(grid), _) => combinations(grid),
        (None, list) => list.clone().unwrap_or_default(),
    };
    // Completes variants of which the base has nothing and a change sets one field: `/load/n` of the preset's load.
    let preset = serde_json::to_vec(&request.base)
        .ok()
        .and_then(|base| crate::spec::read(&base).ok())
        .and_then(|resolved| serde_json::to_value(resolved.spec).ok())
        .unwrap_or(Value::Null);
    let (mut variations, mut faults) = (Vec::with_capacity(all.len()), BTreeSet::new());
    for (index, overrides) in all.into_iter().enumerate() {
        match vary(&request.base, &preset, &overrides) {
            Ok(resolved) => variations.push(Variation {
                overrides,
                estimate: Estimate::of(&resolved),
                resolved,
            }),
            Err(found) => {
                let in_sweep = |fault| in_sweep(fault, index, &overrides, request.grid.is_some());
                faults.extend(found.into_iter().map(in_sweep));
            }
        }
        if faults.len() >= FAULT_LIMIT {
            break;
        }
    }
    if !faults.is_empty() {
        let reported = faults.into_iter().take(FAULT_LIMIT);
        let faults = reported.map(|(pointer, detail)| Fault { pointer, detail });
        return Err(Refused::Faults(faults.collect()));
    }
    for variation in &variations {
        accept(&variation.estimate)?;
    }
    Ok(variations)
}

/// Returns a stored batch as a sweep.
pub(super) fn document(batch: StoredBatch) -> Sweep {
    let overview = batch.overview;
    let shown = |job: BatchJob| SweepJob {
        id: job.id,
        overrides: job.overrides,
        status: job.status,
        outcome: job.outcome,
    };
    Sweep {
        id: overview.id,
        name: overview.name,
        created_at: overview.created_at,
        counts: overview.counts,
        jobs: batch.jobs.into_iter().map(shown).collect(),
        links: Kind::Sweep.links(overview.id),
    }
}

/// Checks how large a sweep would become.
fn check_size(request: &SweepRequest) -> Result<(), Vec<Fault>> {
    let mut faults = Vec::from_iter(variation::name_fault(request.name.as_deref()));
    let mut fault = |pointer: &str, detail: String| faults.push(Fault::new(pointer, detail));
    let (pointer, jobs, changes) = match (&request.grid, &request.list) {
        (Some(grid), None) => {
            let jobs = grid
                .values()
                .try_fold(1_usize, |jobs, values| jobs.checked_mul(values.len()));
            ("/grid", jobs.unwrap_or(usize::MAX), grid.len())
        }
        (None, Some(list)) => {
            let changes = list.iter().map(BTreeMap::len).max();
            ("/list", list.len(), changes.unwrap_or_default())
        }
        _ => {
            fault("", "a sweep has either a `grid` or a `list`".to_owned());
            return Err(faults);
        }
    };
    if !(1..=JOB_LIMIT).contains(&jobs) {
        let detail = format!("{jobs} jobs; a sweep has 1 to {JOB_LIMIT}");
        fault(pointer, detail);
    }
    if changes > CHANGE_LIMIT {
        let detail = format!("{changes} pointers a job, at most {CHANGE_LIMIT}");
        fault(pointer, detail);
    }
    let size = serde_json::to_string(&request.base).map_or(0, |base| base.len());
    let expanded = size.saturating_mul(jobs);
    if expanded > EXPANDED_LIMIT {
        let detail = format!("{expanded} bytes in all jobs together, at most {EXPANDED_LIMIT}");
        fault("/base", detail);
    }
    faults.is_empty().then_some(()).ok_or(faults)
}

/// Returns every combination of a grid, the last pointer varying fastest.
fn combinations(grid: &BTreeMap<String, Vec<Value>>) -> Vec<Changes> {
    let mut all = vec![Changes::new()];
    for (pointer, values) in grid {
        all = all
            .iter()
            .flat_map(|changes| {
                values.iter().map(move |value| {
                    let mut changes = changes.clone();
                    changes.insert(pointer.clone(), value.clone());
                    changes
                })
            })
            .collect();
    }
    all
}

/// Resolves the base with its changes.
fn vary(base: &Value, preset: &Value, overrides: &Changes) -> Result<Resolved, Vec<Fault>> {
    let mut document = base.clone();
    let set = |(pointer, value): (&String, &Value)| {
        let set = patch::set(&mut document, preset, pointer, value.clone());
        Some(Fault::new(pointer.clone(), set.err()?))
    };
    let faults: Vec<Fault> = overrides.iter().filter_map(set).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    // A document that was read can be serialized.
    let bytes = serde_json::to_vec(&document).unwrap_or_default();
    crate::spec::read(&bytes).map_err(|refused| match refused {
        Refused::Parse(error) => {
            let mut faults = vec![Fault::new(error.pointer, error.detail)];
            faults.extend(error.others);
            faults
        }
        Refused::Faults(faults) => faults,
    })
}

/// Moves a fault to its pointer in the submitted sweep: into the changes of its job, or into the base.
fn in_sweep(fault: Fault, index: usize, overrides: &Changes, grid: bool) -> (String, String) {
    let Fault { pointer, detail } = fault;
    let changed = overrides.keys().find(|changed| {
        let below = pointer.strip_prefix(changed.as_str());
        below.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    });
    let pointer_in_sweep = match changed {
        Some(changed) if grid => format!("/grid/{}", pointer_token(changed)),
        Some(changed) => format!("/list/{index}/{}", pointer_token(changed)),
        None => return (format!("/base{pointer}"), detail),
    };
    (pointer_in_sweep, format!("{detail} ({pointer} of a job)"))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn expanded(text: &Value) -> Result<Vec<Variation>, Vec<Fault>> {
        let request = variation::read(text.to_string().as_bytes());
        let variations = request.and_then(|request| expand(&request, &|_| Ok(())));
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
        assert_eq!(
            expanded(&json!({"base": {}, "list": []})).expect_err("refused")[0].detail,
            "0 jobs; a sweep has 1 to 1000"
        );
    }
}
