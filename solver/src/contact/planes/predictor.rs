//! Predictors of the contact of a plane: that of an increment like it, or the last one, moved with the slider.

use super::super::line::{ContactState, Pair, Status, WarmStart};

/// Writes statuses and pressures of a start to the nodes of a plane from `first` on.
pub(super) fn start_from(
    closed: &mut [bool],
    pressure: &mut [f64],
    first: usize,
    start: WarmStart<'_>,
) {
    let nodes = (start.first..).zip(start.status.iter().zip(start.pressure));
    for (node, (status, p)) in nodes {
        let Some(at) = node.checked_sub(first).filter(|at| *at < closed.len()) else {
            continue;
        };
        closed[at] = *status != Status::Open;
        pressure[at] = *p;
    }
}

/// Writes the last contact, moved with the slider, to the nodes of a plane from `first` on.
pub(super) fn moved(
    pair: &Pair<'_>,
    last: &ContactState,
    slider_x: f64,
    closed: &mut [bool],
    pressure: &mut [f64],
    first: usize,
) {
    let Some((begin, end)) = last.active_range() else {
        return;
    };
    let x = &pair.slave().x;
    let travel = pair.travel(last, slider_x);
    for (i, (closed, pressure)) in (first..).zip(closed.iter_mut().zip(pressure)) {
        let from = x[i] - travel;
        if from < x[begin] || from > x[end - 1] {
            continue;
        }
        let next = x.partition_point(|&at| at < from).max(1);
        let t = ((from - x[next - 1]) / (x[next] - x[next - 1])).clamp(0.0, 1.0);
        *closed = true;
        *pressure = (1.0 - t) * last.pressure[next - 1] + t * last.pressure[next];
    }
}
