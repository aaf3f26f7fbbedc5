//! Wear in the contact solve: the gap that the wear of both surfaces opens.

use std::ops::Range;

use super::mortar::Coupling;
use crate::sides::Sides;

/// Gap opened at each coupled node per path p |sigma| at each, 1/MPa: k_r on the diagonal, and the slider's recession,
/// transferred to its nodes and averaged back, k_s Mhat D^-1 M^T, on a few diagonals. A banded matrix.
#[derive(Debug, Default)]
pub(super) struct WearCoupling {
    nodes: usize,
    /// Number of diagonals on each side of the main one.
    bandwidth: usize,
    /// Diagonal d holds the entries (i, i + d - bandwidth) at i.
    diagonals: Vec<f64>,
}

impl WearCoupling {
    /// Assembles the matrix for specific wear rates times cycles, 1/MPa.
    pub(super) fn assemble(&mut self, coupling: &Coupling, slider_width: &[f64], rate: Sides<f64>) {
        let n = coupling.len();
        let Sides { slider, receptacle } = rate;
        self.nodes = n;
        self.bandwidth = if slider > 0.0 {
            half_bandwidth(coupling)
        } else {
            0
        };
        self.diagonals.clear();
        self.diagonals.resize((2 * self.bandwidth + 1) * n, 0.0);
        let b = self.bandwidth;
        self.diagonals[b * n..(b + 1) * n].fill(receptacle);
        if slider <= 0.0 {
            return;
        }
        for i in 0..n {
            let (to, averages) = coupling.dual_row(coupling.first + i);
            for l in i.saturating_sub(b)..(i + b + 1).min(n) {
                let (from, shares) = coupling.standard_row(coupling.first + l);
                let begin = to.max(from);
                let end = (to + averages.len()).min(from + shares.len());
                let mut sum = 0.0;
                for j in begin..end {
                    sum += averages[j - to] * shares[j - from] / slider_width[j];
                }
                self.diagonals[(l + b - i) * n + i] += slider * sum;
            }
        }
    }

    /// Writes the matrix with every column multiplied by a factor.
    pub(super) fn scaled(&self, factor: impl Fn(usize) -> f64, scaled: &mut Self) {
        scaled.nodes = self.nodes;
        scaled.bandwidth = self.bandwidth;
        scaled.diagonals.clear();
        scaled.diagonals.extend_from_slice(&self.diagonals);
        for d in 0..=2 * self.bandwidth {
            let rows = self.rows(d, &(0..self.nodes));
            for i in rows {
                scaled.diagonals[d * self.nodes + i] *= factor(i + d - self.bandwidth);
            }
        }
    }

    /// Adds the gaps opened at the nodes of a span by paths at them, mm.
    pub(super) fn add_opening(&self, span: &Range<usize>, path: &[f64], gap: &mut [f64]) {
        for d in 0..=2 * self.bandwidth {
            let rows = self.rows(d, span);
            if rows.is_empty() {
                continue;
            }
            let path = &path[rows.start + d - self.bandwidth..rows.end + d - self.bandwidth];
            let entries = &self.diagonals[d * self.nodes..][rows.clone()];
            for (gap, (w, e)) in gap[rows].iter_mut().zip(entries.iter().zip(path)) {
                *gap += w * e;
            }
        }
    }

    /// Adds the gaps opened at the nodes of a span by a path at one of them, mm.
    pub(super) fn add_opening_from(
        &self,
        span: &Range<usize>,
        node: usize,
        path: f64,
        gap: &mut [f64],
    ) {
        let begin = node.saturating_sub(self.bandwidth).max(span.start);
        let end = (node + self.bandwidth + 1).min(span.end);
        for (i, gap) in (begin..end).zip(&mut gap[begin..end]) {
            *gap += self.diagonals[(node + self.bandwidth - i) * self.nodes + i] * path;
        }
    }

    /// Rows of diagonal d that lie in a span with their columns.
    fn rows(&self, d: usize, span: &Range<usize>) -> Range<usize> {
        let above = self.bandwidth.saturating_sub(d);
        let below = d.saturating_sub(self.bandwidth);
        span.start + above..span.end.saturating_sub(below)
    }
}

/// Largest distance of two rows of the coupling that share a slider node.
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

/// Path p |sigma| transferred from the coupled nodes to the slider's nodes in the coupled range, MPa mm: the slider's
/// recession over its specific wear rate.
pub(super) fn transfer_path(
    coupling: &Coupling,
    slider_width: &[f64],
    path: &[f64],
    transferred: &mut Vec<f64>,
) {
    let (begin, end) = coupling.slider_range;
    transferred.clear();
    transferred.resize(end - begin, 0.0);
    for (l, e) in path.iter().enumerate().filter(|(_, e)| **e != 0.0) {
        let (from, weights) = coupling.standard_row(coupling.first + l);
        for (r, weight) in transferred[from - begin..].iter_mut().zip(weights) {
            *r += weight * e;
        }
    }
    for (r, width) in transferred.iter_mut().zip(&slider_width[begin..end]) {
        *r /= width;
    }
}
