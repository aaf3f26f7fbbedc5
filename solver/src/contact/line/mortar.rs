//! Dual mortar coupling of two graphs, integrated exactly on the common segments of both meshes.
//!
//! On a slave element with linear shape functions phi the dual ones are psi_1 = 2 phi_1 - phi_2,
//! psi_2 = 2 phi_2 - phi_1 (Wohlmuth 2000): integral psi_i phi_k = delta_ik integral phi_i. Their averages
//! Mhat_ij = (1/d_i) integral psi_i phi_j reproduce constants and, on covered elements, linear functions, so the
//! patch test holds at any position.

use super::pair::Pair;
use std::ops::Range;

/// Three-point Gauss rule on [0, 1], accurate for the gap of curved profiles.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// A slave node is covered if the master ends at most this part of its length before it: the last master element is
/// then continued, which moves nothing by more than round-off.
const ROUND_OFF: f64 = 1e-10;

/// Coupling of the slave nodes `first..end` with the master at one position.
#[derive(Debug, Default)]
pub(in crate::contact) struct Coupling {
    /// First slave node.
    pub(in crate::contact) first: usize,
    /// One past the last slave node.
    pub(in crate::contact) end: usize,
    /// First master node that any row touches, and one past the last.
    pub(in crate::contact) master_range: (usize, usize),
    /// For each slave node: first master node of its row, and where its weights begin.
    rows: Vec<(usize, usize)>,
    /// Mhat_ij.
    dual: Vec<f64>,
    /// integral phi_i phi_j, mm.
    standard: Vec<f64>,
    /// Average of the unworn gap at height 0, mm.
    pub(in crate::contact) gap: Vec<f64>,
}

/// Slave nodes whose whole support faces the master: first and one past the last.
pub(in crate::contact) fn covered(pair: &Pair<'_>, pairing_x: f64) -> (usize, usize) {
    let (slave, master) = (&pair.slave().x, &pair.master().x);
    let offset = pair.offset(pairing_x);
    let round_off = ROUND_OFF * (master[master.len() - 1] - master[0]);
    let left = master[0] + offset - round_off;
    let right = master[master.len() - 1] + offset + round_off;
    let begin = slave.partition_point(|&x| x < left);
    let end = slave.partition_point(|&x| x <= right);
    let first = if begin == 0 { 0 } else { begin + 1 };
    let end = if end == slave.len() {
        end
    } else {
        end.saturating_sub(1)
    };
    (first, end.max(first))
}

impl Coupling {
    /// Integrates the coupling of the slave nodes `first..end`, which must be covered.
    pub(in crate::contact) fn integrate(
        &mut self,
        pair: &Pair<'_>,
        pairing_x: f64,
        first: usize,
        end: usize,
    ) {
        let slave = pair.slave();
        let offset = pair.offset(pairing_x);
        (self.first, self.end) = (first, end);
        self.lay_out(&slave.x, &pair.master().x, offset);
        let elements = first.saturating_sub(1)..end.min(slave.x.len() - 1);
        let start = slave.x[elements.start] - offset;
        let mut next = pair.master().x.partition_point(|&x| x <= start);
        for element in elements {
            next = self.integrate_element(pair, offset, element, next);
        }
        for i in first..end {
            let width = slave.widths[i];
            self.gap[i - first] /= width;
            let row = self.row_span(i);
            self.dual[row].iter_mut().for_each(|m| *m /= width);
        }
    }

    fn lay_out(&mut self, slave: &[f64], master: &[f64], offset: f64) {
        self.rows.clear();
        self.gap.clear();
        self.gap.resize(self.end - self.first, 0.0);
        let (mut begin, mut total) = (usize::MAX, 0);
        let mut last = 0;
        let left_of = |i: usize| slave[i.saturating_sub(1)] - offset;
        // Both bounds of a support advance from one node to the next.
        let start = left_of(self.first);
        let mut beyond_left = master.partition_point(|&x| x <= start);
        let mut beyond_right = beyond_left;
        for i in self.first..self.end {
            let left = left_of(i);
            let right = slave[(i + 1).min(slave.len() - 1)] - offset;
            beyond_left = advance(master, beyond_left, |x| x <= left);
            beyond_right = advance(master, beyond_right, |x| x < right);
            let from = beyond_left.saturating_sub(1);
            let to = beyond_right.min(master.len() - 1);
            self.rows.push((from, total));
            total += to + 1 - from;
            begin = begin.min(from);
            last = last.max(to + 1);
        }
        self.rows.push((0, total));
        self.master_range = (begin.min(last), last);
        self.dual.clear();
        self.dual.resize(total, 0.0);
        self.standard.clear();
        self.standard.resize(total, 0.0);
    }

    /// Integrates one slave element. The first master node beyond its beginning is `next` or follows it; returns that node.
    fn integrate_element(
        &mut self,
        pair: &Pair<'_>,
        offset: f64,
        element: usize,
        next: usize,
    ) -> usize {
        let (slave, master) = (pair.slave(), pair.master());
        let (a, b) = (slave.x[element], slave.x[element + 1]);
        let next = advance(&master.x, next, |x| x <= a - offset);
        let mut j = next.clamp(1, master.x.len() - 1);
        let mut left = a;
        while left < b {
            // As the support is laid out: sums and differences of places differ by round-off.
            let last = j == master.x.len() - 1 || master.x[j] >= b - offset;
            let right = if last { b } else { b.min(master.x[j] + offset) };
            if right > left {
                self.integrate_segment(pair, offset, element, j - 1, left, right);
            }
            left = right;
            j = (j + 1).min(master.x.len() - 1);
        }
        next
    }

    /// Integrates the part of the slave element `e` from `left` to `right`, mm, that faces the master element `m`.
    fn integrate_segment(
        &mut self,
        pair: &Pair<'_>,
        offset: f64,
        e: usize,
        m: usize,
        left: f64,
        right: f64,
    ) {
        let (slave, master) = (&pair.slave().x, &pair.master().x);
        let dx = right - left;
        // Shape functions at both ends; they are linear.
        let slave_at = |x: f64| (x - slave[e]) / (slave[e + 1] - slave[e]);
        let master_at = |x: f64| (x - offset - master[m]) / (master[m + 1] - master[m]);
        let t = [slave_at(left), slave_at(right)];
        let u = [master_at(left), master_at(right)];
        let gaps = GAUSS.map(|(at, weight)| {
            let own = t[0] + at * (t[1] - t[0]);
            (own, weight * dx * pair.unworn_gap(left + at * dx, offset))
        });
        let far = [u.map(|u| 1.0 - u), u];
        let standard = [t.map(|t| 1.0 - t), t];
        let dual = [0, 1].map(|side| t.map(|t| dual_shapes(t)[side]));
        for side in 0..2 {
            let i = e + side;
            if i < self.first || i >= self.end {
                continue;
            }
            let (from, offset) = self.rows[i - self.first];
            let place = offset + m - from;
            for (t, gap) in gaps {
                self.gap[i - self.first] += dual_shapes(t)[side] * gap;
            }
            for (j, far) in far.iter().enumerate() {
                self.dual[place + j] += dx * product(&dual[side], far);
                self.standard[place + j] += dx * product(&standard[side], far);
            }
        }
    }

    fn row_span(&self, i: usize) -> std::ops::Range<usize> {
        self.rows[i - self.first].1..self.rows[i - self.first + 1].1
    }

    /// Number of coupled slave nodes.
    pub(in crate::contact) fn len(&self) -> usize {
        self.end - self.first
    }

    /// Averaging row of slave node `i`: its first master node and the weights Mhat_ij.
    pub(in crate::contact) fn dual_row(&self, i: usize) -> (usize, &[f64]) {
        (self.rows[i - self.first].0, &self.dual[self.row_span(i)])
    }

    /// The averaging rows of some coupled slave nodes.
    pub(in crate::contact) fn dual_rows(
        &self,
        nodes: &Range<usize>,
    ) -> impl Iterator<Item = (usize, &[f64])> {
        self.rows[nodes.start - self.first..=nodes.end - self.first]
            .windows(2)
            .map(|rows| (rows[0].0, &self.dual[rows[0].1..rows[1].1]))
    }

    /// Master nodes that the rows of some coupled slave nodes touch.
    pub(in crate::contact) fn masters(&self, nodes: &Range<usize>) -> Range<usize> {
        // Both ends of the rows ascend.
        let (first, _) = self.dual_row(nodes.start);
        let (last, weights) = self.dual_row(nodes.end - 1);
        first..last + weights.len()
    }

    /// Transfer row of slave node `i`: its first master node and the integrals of phi_i phi_j, mm.
    pub(in crate::contact) fn standard_row(&self, i: usize) -> (usize, &[f64]) {
        (
            self.rows[i - self.first].0,
            &self.standard[self.row_span(i)],
        )
    }

    /// Lets a slave node average the master with the positive weights of its transfer row, and share in proportion to a part of each node besides, as
    /// much in all. Of linear functions such averages are exact on even meshes only.
    pub(super) fn share_by(&mut self, i: usize, part: impl Fn(usize) -> f64) {
        let (from, span) = (self.rows[i - self.first].0, self.row_span(i));
        let whole: f64 = self.standard[span.clone()].iter().sum();
        let mut shared = 0.0;
        for (j, place) in (from..).zip(span.clone()) {
            self.dual[place] = self.standard[place] / whole;
            self.standard[place] *= part(j);
            shared += self.standard[place];
        }
        for share in &mut self.standard[span] {
            *share *= whole / shared;
        }
    }
}

/// The dual shape functions of an element.
fn dual_shapes(t: f64) -> [f64; 2] {
    [2.0 - 3.0 * t, 3.0 * t - 1.0]
}

/// The first node from `next` on that does not lie before.
fn advance(nodes: &[f64], next: usize, is_before: impl Fn(f64) -> bool) -> usize {
    let passed = nodes[next..].iter().take_while(|x| is_before(**x));
    next + passed.count()
}

/// Mean product of two linear functions with these values at both ends.
fn product(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (2.0 * (a[0] * b[0] + a[1] * b[1]) + a[0] * b[1] + a[1] * b[0]) / 6.0
}

#[cfg(test)]
mod tests;
