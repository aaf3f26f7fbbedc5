//! Transfer of wear between the coupled nodes and the master's.

use super::super::band::Band;
use super::super::mortar::Coupling;

/// Writes Mhat R M^T, where R multiplies what is shared by a node of the master.
pub(super) fn assemble_transfer(
    coupling: &Coupling,
    at_node: impl Fn(f64, usize) -> f64,
    transfer: &mut Band,
) {
    let (n, b) = (coupling.len(), half_bandwidth(coupling));
    transfer.reset(n, b);
    for i in 0..n {
        let (to, averages) = coupling.dual_row(coupling.first + i);
        for l in i.saturating_sub(b)..(i + b + 1).min(n) {
            let (from, shares) = coupling.standard_row(coupling.first + l);
            let begin = to.max(from);
            let end = (to + averages.len()).min(from + shares.len());
            let mut sum = 0.0;
            for j in begin..end {
                sum += at_node(averages[j - to] * shares[j - from], j);
            }
            *transfer.at(i, l) = sum;
        }
    }
}

/// Largest distance of two rows of the coupling that share a master node.
fn half_bandwidth(coupling: &Coupling) -> usize {
    let mut bandwidth = 0;
    for i in coupling.first..coupling.end {
        let (from, weights) = coupling.dual_row(i);
        let shares = |l: &usize| coupling.dual_row(*l).0 < from + weights.len();
        let last = (i..coupling.end).take_while(shares).last().unwrap_or(i);
        bandwidth = bandwidth.max(last - i);
    }
    bandwidth
}

/// Transfers a path p |sigma| from the coupled nodes to the master's nodes in the coupled range, MPa mm.
pub(super) fn transfer_path(
    coupling: &Coupling,
    master_width: &[f64],
    path: &[f64],
    transferred: &mut Vec<f64>,
) {
    let (begin, end) = coupling.master_range;
    transferred.clear();
    transferred.resize(end - begin, 0.0);
    for (l, e) in path.iter().enumerate().filter(|(_, e)| **e != 0.0) {
        let (from, weights) = coupling.standard_row(coupling.first + l);
        for (r, weight) in transferred[from - begin..].iter_mut().zip(weights) {
            *r += weight * e;
        }
    }
    for (r, width) in transferred.iter_mut().zip(&master_width[begin..end]) {
        *r /= width;
    }
}
