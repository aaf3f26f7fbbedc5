//! The jobs of a sweep by their positions: which changes each makes to the base specification, and what comes of it.

use std::collections::BTreeMap;

use api::problem::Fault;
use api::spec::pointer_token;
use api::sweep::{Changes, SweepRequest};
use serde_json::Value;

use crate::batch::sweep::patch;
use crate::batch::variation::Variation;
use crate::estimate::Estimate;
use crate::spec::{Refused, Resolved};

/// The jobs of a sweep.
pub(super) struct Variations<'a> {
    request: &'a SweepRequest,
    /// The resolved base, into which the pointers of changes point.
    resolved: Value,
}

/// Number of jobs of a sweep.
pub(super) fn number(request: &SweepRequest) -> u64 {
    let length = |length: usize| u64::try_from(length).unwrap_or(u64::MAX);
    match (&request.grid, &request.list) {
        (Some(grid), _) => grid
            .values()
            .fold(1, |jobs, values| jobs.saturating_mul(length(values.len()))),
        (None, list) => list.as_ref().map_or(0, |list| length(list.len())),
    }
}

impl<'a> Variations<'a> {
    /// Variations of a request.
    pub(super) fn of(request: &'a SweepRequest) -> Self {
        let resolved = serde_json::to_vec(&request.base)
            .ok()
            .and_then(|base| crate::spec::read(&base).ok())
            .and_then(|resolved| serde_json::to_value(resolved.spec).ok());
        Self {
            request,
            resolved: resolved.unwrap_or(Value::Null),
        }
    }

    /// Number of them.
    pub(super) fn len(&self) -> u64 {
        number(self.request)
    }

    /// The changes at a position.
    pub(super) fn changes(&self, position: u64) -> Changes {
        match (&self.request.grid, &self.request.list) {
            (Some(grid), _) => combination(grid, position),
            (None, list) => usize::try_from(position)
                .ok()
                .and_then(|position| list.as_ref()?.get(position).cloned())
                .unwrap_or_default(),
        }
    }

    /// The job at a position.
    ///
    /// # Errors
    /// Pointers into the submitted sweep, each with what is wrong there.
    pub(super) fn at(&self, position: u64) -> Result<Variation, Vec<(String, String)>> {
        let overrides = self.changes(position);
        match vary(&self.request.base, &self.resolved, &overrides) {
            Ok((sent, resolved)) => Ok(Variation {
                overrides,
                sent,
                estimate: Estimate::of(&resolved),
                resolved,
            }),
            Err(faults) => {
                let is_grid = self.request.grid.is_some();
                let in_sweep = |fault| in_sweep(fault, position, &overrides, is_grid);
                Err(faults.into_iter().map(in_sweep).collect())
            }
        }
    }
}

/// The combination of a grid at a position, the last pointer varying fastest.
fn combination(grid: &BTreeMap<String, Vec<Value>>, mut position: u64) -> Changes {
    let mut changes = Changes::new();
    for (pointer, values) in grid.iter().rev() {
        let length = u64::try_from(values.len()).unwrap_or(u64::MAX).max(1);
        let value = usize::try_from(position % length).ok();
        position /= length;
        if let Some(value) = value.and_then(|index| values.get(index)) {
            changes.insert(pointer.clone(), value.clone());
        }
    }
    changes
}

/// The base with its changes, JSON, and what it resolves to.
fn vary(
    base: &Value,
    resolved: &Value,
    overrides: &Changes,
) -> Result<(String, Resolved), Vec<Fault>> {
    let mut document = base.clone();
    let set = |(pointer, value): (&String, &Value)| {
        let set = patch::set(&mut document, resolved, pointer, value.clone());
        Some(Fault::new(pointer.clone(), set.err()?))
    };
    let faults: Vec<Fault> = overrides.iter().filter_map(set).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    let sent = document.to_string();
    let read = crate::spec::read(sent.as_bytes());
    let read = read.map_err(|refused| match refused {
        Refused::Parse(error) => {
            let mut faults = vec![Fault::new(error.pointer, error.detail)];
            faults.extend(error.others);
            faults
        }
        Refused::Faults(faults) => faults,
    });
    Ok((sent, read?))
}

/// Moves a fault to its pointer in the submitted sweep: into the changes of its job, or into the base.
fn in_sweep(fault: Fault, index: u64, overrides: &Changes, grid: bool) -> (String, String) {
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
mod tests;
