//! Active window: the nodes of the slave that an increment is solved for, and the candidates beside them.

use super::pair::{Pair, Surfaces};
use super::state::ContactState;
use crate::linear::vector::vectorized;

/// A node whose undeformed gap is smaller than this part of the indentation is a candidate: the free surface beside a
/// contact sinks, so a node with a positive undeformed gap closes only if shear lifts it, by far less than this.
pub(crate) const CANDIDATE_GAP: f64 = 0.3;
/// Additional nodes at either end of a window: about as many as the contact moves and widens by in an increment. With 2, 4
/// and 8 `fuzz_button.json` at 0.02 takes 1.46, 1.55 and 1.75 s to 500 cycles, `mccoll.json` at 0.003 5.1, 5.2 and 5.3 s.
const MARGIN_NODES: usize = 2;
/// The same, as a part of the window: the edges of a wide worn contact move by many nodes, because its gaps are small beside
/// them. With a 4th, 8th, 16th and none `mccoll.json` at 0.003 takes 5.6, 5.2, 5.1 and 6.7 s.
const MARGIN_SHARE: usize = 16;

/// The first window: the last contact, shifted with the slider over the receptacle.
pub(super) fn initial_window(
    pair: &Pair<'_>,
    last: &ContactState,
    pairing_x: f64,
    covered: (usize, usize),
    undeformed: &[f64],
) -> (usize, usize) {
    let x = &pair.slave().x;
    let Some((first, end)) = last.active_range() else {
        let gaps = undeformed.iter().enumerate();
        let lowest = gaps.fold(
            (0, f64::INFINITY),
            |m, (i, g)| if *g < m.1 { (i, *g) } else { m },
        );
        let node = covered.0 + lowest.0;
        return widened((node, node + 1), covered);
    };
    let step = pair.travel(last, pairing_x);
    let begin = x.partition_point(|&at| at < x[first] + step);
    let stop = x.partition_point(|&at| at <= x[end - 1] + step);
    let begin = begin.clamp(covered.0, covered.1 - 1);
    widened((begin, stop.clamp(begin + 1, covered.1)), covered)
}

/// Undeformed vertical gap of the covered nodes at height 0, mm: exact shapes, worn depths interpolated.
pub(in crate::contact) fn undeformed_gaps(
    pair: &Pair<'_>,
    surfaces: &Surfaces<'_>,
    pairing_x: f64,
    covered: (usize, usize),
    gaps: &mut Vec<f64>,
) {
    let (slave, master) = (pair.slave(), pair.master());
    let side = pair.interface.slave;
    let (own, other) = (surfaces.depth.of(side), surfaces.depth.of(side.other()));
    let offset = pair.offset(pairing_x);
    let last = master.x.len() - 1;
    gaps.clear();
    gaps.resize(covered.1 - covered.0, 0.0);
    let nodes = &slave.x[covered.0..covered.1];
    vectorized(
        #[inline(always)]
        || {
            for (gap, x) in gaps.iter_mut().zip(nodes) {
                *gap = pair.unworn_gap(*x, offset);
            }
        },
    );
    let mut m = 1;
    for (gap, (x, own)) in gaps.iter_mut().zip(nodes.iter().zip(&own[covered.0..])) {
        let local = x - offset;
        while m < last && master.x[m] < local {
            m += 1;
        }
        let t = (local - master.x[m - 1]) / (master.x[m] - master.x[m - 1]);
        *gap += (1.0 - t) * other[m - 1] + t * other[m] + own;
    }
}

/// Candidate nodes at a height, the gaps beginning at node `offset`: first and one past the last.
pub(in crate::contact) fn candidates(
    undeformed: &[f64],
    offset: usize,
    indentation: f64,
    height: f64,
) -> (usize, usize) {
    let threshold = CANDIDATE_GAP * indentation - height;
    let below = |gap: &f64| *gap < threshold;
    match (
        undeformed.iter().position(below),
        undeformed.iter().rposition(below),
    ) {
        (Some(first), Some(last)) => (offset + first, offset + last + 1),
        _ => (usize::MAX, 0),
    }
}

/// The window with its margin, within the covered nodes.
pub(in crate::contact) fn widened(
    (first, end): (usize, usize),
    covered: (usize, usize),
) -> (usize, usize) {
    let margin = MARGIN_NODES + (end - first) / MARGIN_SHARE;
    (
        first.saturating_sub(margin).max(covered.0),
        (end + margin).min(covered.1),
    )
}
