//! A correction of the iterate: the condensed system, whose border's nodes are closed or open.
//!
//! A closed node has a vanishing gap, the pressure of an open one is corrected to zero. The vertical balance is divided by the contact modulus:
//! as a length, like the gaps beside it.

use super::super::iterate::Iterate;
use super::super::problem::Problem;
use super::super::response::Response;
use super::super::wear::PlanesWear;
use super::partition::Partition;
use crate::linear::{CondensedSystem, DenseLu};

/// Buffers of the correction.
#[derive(Default)]
pub(super) struct Correction {
    system: CondensedSystem,
    /// Equations of the border's closed nodes and of the height.
    lu: DenseLu,
    /// Their places in the border.
    free: Vec<usize>,
    small: Vec<f64>,
    /// Residuals, then changes of all unknowns.
    change: Vec<f64>,
    column: Vec<f64>,
}

impl Correction {
    /// Assembles the derivatives of the gaps and of the vertical balance, and condenses them onto the border and the height.
    pub(super) fn assemble(
        &mut self,
        problem: &Problem,
        partition: &Partition,
        wear: &PlanesWear,
        response: &Response,
        it: &Iterate,
    ) {
        let (n, unknowns) = (problem.nodes(), &partition.nodes);
        let m = unknowns.len();
        let matrix = self.system.system(m + 1);
        for (j, &node) in unknowns.iter().enumerate() {
            self.column.clear();
            self.column.extend_from_slice(response.column(node));
            if problem.wears {
                let plane = node / n;
                let own = &mut self.column[plane * n..(plane + 1) * n];
                let wear = wear.of(plane);
                wear.open_by_pressure(&(0..n), node % n, it.slip[node], own);
            }
            for (entry, row) in matrix.column_mut(j).iter_mut().zip(unknowns) {
                *entry = self.column[*row];
            }
            *matrix.at(m, j) = problem.shares[node / n] * problem.force[node][1] / problem.modulus;
        }
        self.column.clone_from(&problem.per_height);
        if problem.wears {
            for &node in unknowns.iter().filter(|node| it.slip[**node] > 0.0) {
                let plane = node / n;
                let own = &mut self.column[plane * n..(plane + 1) * n];
                let per_height = problem.direction * problem.slope[node] * it.pressure[node];
                let wear = wear.of(plane);
                wear.open_by_slip(&(0..n), node % n, per_height, own);
            }
        }
        for (entry, row) in matrix.column_mut(m).iter_mut().zip(unknowns) {
            *entry = self.column[*row];
        }
        *matrix.at(m, m) = -problem.spring / problem.modulus;
        self.system.condense(partition.core);
    }

    /// Corrects pressures and height by the residuals of an iterate; `false` if the system has no finite solution. The statuses are those of
    /// the last correction unless they have `changed`.
    pub(super) fn apply(
        &mut self,
        problem: &Problem,
        partition: &Partition,
        it: &mut Iterate,
        changed: bool,
    ) -> bool {
        let (unknowns, core) = (&partition.nodes, partition.core);
        self.change.clear();
        self.change
            .extend(unknowns.iter().map(|node| -it.gap[*node]));
        self.change.push(it.balance(problem) / problem.modulus);
        self.system.eliminate(&mut self.change);
        if changed {
            self.factor_border(partition, it);
        }
        let border = &mut self.change[core..];
        self.small.clear();
        self.small.extend(self.free.iter().map(|row| border[*row]));
        for (b, node) in unknowns[core..].iter().enumerate() {
            let change = -it.pressure[*node];
            if it.is_closed[*node] || change == 0.0 {
                continue;
            }
            for (rhs, row) in self.small.iter_mut().zip(&self.free) {
                *rhs -= change * self.system.schur(*row, b);
            }
        }
        if !self.lu.solve(&mut self.small) {
            return false;
        }
        for (change, node) in border.iter_mut().zip(&unknowns[core..]) {
            *change = -it.pressure[*node];
        }
        for (solution, row) in self.small.iter().zip(&self.free) {
            border[*row] = *solution;
        }
        self.system.substitute(&mut self.change);
        if self.change.iter().any(|change| !change.is_finite()) {
            return false;
        }
        for (node, change) in unknowns.iter().zip(&self.change) {
            it.pressure[*node] += change;
        }
        it.height += self.change[unknowns.len()];
        true
    }

    fn factor_border(&mut self, partition: &Partition, it: &Iterate) {
        let border = &partition.nodes[partition.core..];
        self.free.clear();
        let closed = border
            .iter()
            .enumerate()
            .filter(|(_, node)| it.is_closed[**node]);
        self.free.extend(closed.map(|(b, _)| b));
        self.free.push(border.len());
        let matrix = self.lu.matrix(self.free.len());
        for (j, column) in self.free.iter().enumerate() {
            for (entry, row) in matrix.column_mut(j).iter_mut().zip(&self.free) {
                *entry = self.system.schur(*row, *column);
            }
        }
        self.lu.factor();
    }
}
