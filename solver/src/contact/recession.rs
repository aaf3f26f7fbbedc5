//! What wear takes from both surfaces, and how far that opens the gap.

use std::ops::Range;

use super::mortar::Coupling;

/// Gap opened at each coupled node per path p |sigma| at each: k_r on the diagonal, and what the slider loses, carried
/// to its nodes and averaged back, k_s Mhat D^-1 M^T, on some diagonals beside it. In 1/MPa.
#[derive(Debug, Default)]
pub(super) struct WearTransfer {
    nodes: usize,
    /// Diagonals beside the main one, on each side.
    beside: usize,
    /// Diagonal d holds the entries (i, i + d - beside) at i.
    diagonals: Vec<f64>,
}

impl WearTransfer {
    /// For wear coefficients times cycles of receptacle and slider.
    pub(super) fn lay(&mut self, coupling: &Coupling, slider_width: &[f64], kappa: [f64; 2]) {
        let n = coupling.len();
        let [receptacle, slider] = kappa;
        self.nodes = n;
        self.beside = if slider > 0.0 { reach(coupling) } else { 0 };
        self.diagonals.clear();
        self.diagonals.resize((2 * self.beside + 1) * n, 0.0);
        let b = self.beside;
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

    /// The same per unit of what each node's path is the multiple of: every column times its factor.
    pub(super) fn scaled(&self, factor: impl Fn(usize) -> f64, scaled: &mut Self) {
        scaled.nodes = self.nodes;
        scaled.beside = self.beside;
        scaled.diagonals.clear();
        scaled.diagonals.extend_from_slice(&self.diagonals);
        for d in 0..=2 * self.beside {
            let rows = self.rows(d, &(0..self.nodes));
            for i in rows {
                scaled.diagonals[d * self.nodes + i] *= factor(i + d - self.beside);
            }
        }
    }

    /// Adds the gaps opened at the nodes of a span by paths at them, mm.
    pub(super) fn open(&self, span: &Range<usize>, path: &[f64], gap: &mut [f64]) {
        for d in 0..=2 * self.beside {
            let rows = self.rows(d, span);
            if rows.is_empty() {
                continue;
            }
            let path = &path[rows.start + d - self.beside..rows.end + d - self.beside];
            let entries = &self.diagonals[d * self.nodes..][rows.clone()];
            for (gap, (w, e)) in gap[rows].iter_mut().zip(entries.iter().zip(path)) {
                *gap += w * e;
            }
        }
    }

    /// Adds the gaps opened at the nodes of a span by a path at one of them, mm.
    pub(super) fn open_from(&self, span: &Range<usize>, node: usize, path: f64, gap: &mut [f64]) {
        let begin = node.saturating_sub(self.beside).max(span.start);
        let end = (node + self.beside + 1).min(span.end);
        for (i, gap) in (begin..end).zip(&mut gap[begin..end]) {
            *gap += self.diagonals[(node + self.beside - i) * self.nodes + i] * path;
        }
    }

    /// Rows of diagonal d that lie in a span with their columns.
    fn rows(&self, d: usize, span: &Range<usize>) -> Range<usize> {
        let above = self.beside.saturating_sub(d);
        let below = d.saturating_sub(self.beside);
        span.start + above..span.end.saturating_sub(below)
    }
}

/// How many rows away a row of the coupling still shares a slider node.
fn reach(coupling: &Coupling) -> usize {
    let mut reach = 0;
    for i in coupling.first..coupling.end {
        let (from, weights) = coupling.dual_row(i);
        let shares = |l: &usize| coupling.dual_row(*l).0 < from + weights.len();
        let last = (i..coupling.end).take_while(shares).last().unwrap_or(i);
        reach = reach.max(last - i);
    }
    reach
}

/// Vertical recession of the slider's nodes in the coupled range per k, for p |sigma| at the coupled nodes, MPa mm.
pub(super) fn slider_recession(
    coupling: &Coupling,
    slider_width: &[f64],
    path: &[f64],
    recession: &mut Vec<f64>,
) {
    let (begin, end) = coupling.slider_range;
    recession.clear();
    recession.resize(end - begin, 0.0);
    for (l, e) in path.iter().enumerate().filter(|(_, e)| **e != 0.0) {
        let (from, weights) = coupling.standard_row(coupling.first + l);
        for (r, weight) in recession[from - begin..].iter_mut().zip(weights) {
            *r += weight * e;
        }
    }
    for (r, width) in recession.iter_mut().zip(&slider_width[begin..end]) {
        *r /= width;
    }
}
