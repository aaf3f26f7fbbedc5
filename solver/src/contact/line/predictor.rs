//! Predictor: the initial iterate of an increment.

use super::pair::{Pair, WarmStart};
use super::problem::{GAP_TOLERANCE, Iterate, Problem};
use super::state::ContactState;
use super::status::Status;

/// Writes the last contact, shifted with the slider, to the iterate.
pub(super) fn predict(
    it: &mut Iterate,
    pair: &Pair<'_>,
    last: &ContactState,
    problem: &Problem<'_>,
) {
    let (first, end) = (problem.coupling.first, problem.coupling.end);
    let x = &pair.slave().x;
    let n = end - first;
    // Every field is set: the result must depend on the state only, not on the last solve.
    it.indentation = last.indentation;
    it.height = problem.height.unwrap_or(last.height);
    it.tolerance = GAP_TOLERANCE;
    it.status.clear();
    it.pressure.clear();
    it.slip.clear();
    for values in [&mut it.shear, &mut it.path, &mut it.gap, &mut it.along] {
        values.clear();
        values.resize(n, 0.0);
    }
    if !problem.along.is_empty() {
        it.along.copy_from_slice(problem.along);
    }
    let active = last.active_range();
    let mut next = x.partition_point(|&at| at < x[first] - problem.travel);
    for i in first..end {
        let from = x[i] - problem.travel;
        let travelled = active.is_none_or(|(a, b)| from >= x[a] && from <= x[b - 1]);
        while next < x.len() && x[next] < from {
            next += 1;
        }
        let near = next.min(x.len() - 1);
        let was = last.status[near].direction();
        let status = if !travelled {
            Status::Open
        } else if !problem.tracks_slip || was * problem.step > 0.0 {
            Status::slip(problem.step)
        } else {
            Status::Stick
        };
        it.status.push(status);
        it.pressure.push(if travelled {
            interpolated(x, &last.pressure, near, from)
        } else {
            0.0
        });
        it.slip.push(problem.step);
    }
    if it.status.iter().all(|s| *s == Status::Open) {
        it.status.fill(if problem.tracks_slip {
            Status::Stick
        } else {
            Status::slip(problem.step)
        });
    }
}

/// Replaces statuses and pressures by those of a start, from node `first` on, unless it lies beside these nodes.
pub(super) fn start_from(it: &mut Iterate, first: usize, start: WarmStart<'_>) {
    let nodes = first..first + it.status.len();
    let closed = start.first..start.first + start.status.len();
    let begin = closed.start.max(nodes.start);
    let end = closed.end.min(nodes.end);
    if begin >= end {
        return;
    }
    it.status.fill(Status::Open);
    it.pressure.fill(0.0);
    let (to, from) = (
        begin - nodes.start..end - nodes.start,
        begin - closed.start..end - closed.start,
    );
    it.status[to.clone()].copy_from_slice(&start.status[from.clone()]);
    it.pressure[to].copy_from_slice(&start.pressure[from]);
}

/// Value at a place that lies between the node before `next` and that one.
fn interpolated(x: &[f64], values: &[f64], next: usize, at: f64) -> f64 {
    let Some(before) = next.checked_sub(1) else {
        return values[next];
    };
    let t = ((at - x[before]) / (x[next] - x[before])).clamp(0.0, 1.0);
    values[before] + t * (values[next] - values[before])
}
