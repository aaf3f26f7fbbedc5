//! A correction of the iterate: the condensed system with the border's unknowns under the conditions of their statuses.
//!
//! A closed node has a vanishing gap, a sticking one a vanishing slip besides. The shear of a slipping node follows its
//! pressure, the tractions of an open node are corrected to zero.

use super::super::problem::{Iterate, Problem};
use super::super::status::Status;
use super::super::unknown::Unknown;
use super::partition::Partition;
use super::secant::Secant;
use super::system::System;
use crate::linear::DenseLu;

/// Condition of an unknown of the border.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Condition {
    /// Equation holds.
    Free,
    /// Change is known.
    Known { change: f64 },
    /// Besides a known change it changes by the change of the free unknown before it, times a factor.
    Follows { factor: f64, change: f64 },
}

/// Buffers of the correction.
#[derive(Debug, Default)]
pub(super) struct Correction {
    conditions: Vec<Condition>,
    /// Places of the free unknowns in the border.
    free: Vec<usize>,
    lu: DenseLu,
    rhs: Vec<f64>,
    /// Residuals, then changes of all unknowns.
    change: Vec<f64>,
    secant: Secant,
}

impl Correction {
    /// Corrects tractions and height by the residuals of an iterate; `false` if the system has no finite solution. The system
    /// and the statuses are those of the last correction unless it is `renewed`.
    pub(super) fn apply(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        system: &mut System,
        renewed: bool,
        it: &mut Iterate,
    ) -> bool {
        self.write_residuals(problem, partition, it);
        system.eliminate(&mut self.change);
        self.set_conditions(problem, partition, it);
        if renewed {
            self.factor_border(system);
            self.secant.restart();
        }
        if !self.solve_border(partition.core, system) {
            return false;
        }
        system.substitute(&mut self.change);
        self.secant.accelerate(&mut self.change);
        if self.change.iter().any(|change| !change.is_finite()) {
            return false;
        }
        for (unknown, change) in partition.unknowns.iter().zip(&self.change) {
            match *unknown {
                Unknown::Pressure(i, _) => it.pressure[i] += change,
                Unknown::Shear(i) => it.shear[i] += change,
            }
        }
        it.height += self.change[partition.unknowns.len()];
        settle(problem, it);
        true
    }

    /// Changes of all unknowns per height, if that is given: its equation is the last one. No changes if the system has no finite
    /// solution.
    pub(super) fn per_height(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        system: &mut System,
        it: &Iterate,
    ) -> &[f64] {
        let unknowns = partition.unknowns.len();
        self.change.clear();
        self.change.resize(unknowns, 0.0);
        self.change
            .push(-problem.spring / problem.pair.interface.modulus);
        system.eliminate(&mut self.change);
        self.set_conditions(problem, partition, it);
        self.factor_border(system);
        if !self.solve_border(partition.core, system) {
            return &[];
        }
        system.substitute(&mut self.change);
        &self.change[..unknowns]
    }

    fn write_residuals(&mut self, problem: &Problem<'_>, partition: &Partition, it: &Iterate) {
        self.change.clear();
        let residuals = partition.unknowns.iter().map(|unknown| match *unknown {
            Unknown::Pressure(i, _) => -it.gap[i],
            Unknown::Shear(i) => -it.slip[i],
        });
        self.change.extend(residuals);
        let modulus = problem.pair.interface.modulus;
        self.change.push(partition.balance(problem, it) / modulus);
    }

    fn set_conditions(&mut self, problem: &Problem<'_>, partition: &Partition, it: &Iterate) {
        self.conditions.clear();
        self.free.clear();
        for unknown in &partition.unknowns[partition.core..] {
            let node = unknown.node();
            self.push(match (*unknown, it.status[node]) {
                (_, Status::Open) => Condition::Known {
                    change: -unknown.value(it),
                },
                (Unknown::Pressure(..), _) | (_, Status::Stick) => Condition::Free,
                (Unknown::Shear(_), status) => {
                    let factor = status.direction() * problem.friction.at(node);
                    let change = factor * it.pressure[node] - it.shear[node];
                    Condition::Follows { factor, change }
                }
            });
        }
        self.push(Condition::Free);
    }

    fn push(&mut self, condition: Condition) {
        if condition == Condition::Free {
            self.free.push(self.conditions.len());
        }
        self.conditions.push(condition);
    }

    /// Factors the equations of the border's free unknowns.
    fn factor_border(&mut self, system: &System) {
        let matrix = self.lu.matrix(self.free.len());
        let mut columns = 0;
        for (b, condition) in self.conditions.iter().enumerate() {
            let entries = self.free.iter().map(|row| system.schur(*row, b));
            match *condition {
                Condition::Free => {
                    let target = matrix.column_mut(columns).iter_mut();
                    target.zip(entries).for_each(|(to, entry)| *to = entry);
                    columns += 1;
                }
                Condition::Follows { factor, .. } => {
                    let target = matrix.column_mut(columns - 1).iter_mut();
                    target
                        .zip(entries)
                        .for_each(|(to, entry)| *to += factor * entry);
                }
                Condition::Known { .. } => {}
            }
        }
        self.lu.factor();
    }

    /// Solves for the border's changes, whose residuals are those after the elimination of the core.
    fn solve_border(&mut self, core: usize, system: &System) -> bool {
        let border = &mut self.change[core..];
        self.rhs.clear();
        self.rhs.extend(self.free.iter().map(|row| border[*row]));
        for (b, condition) in self.conditions.iter().enumerate() {
            let (Condition::Known { change } | Condition::Follows { change, .. }) = *condition
            else {
                continue;
            };
            if change != 0.0 {
                for (rhs, row) in self.rhs.iter_mut().zip(&self.free) {
                    *rhs -= change * system.schur(*row, b);
                }
            }
        }
        let is_finite = self.lu.solve(&mut self.rhs);
        let mut solution = self.rhs.iter();
        let mut last = 0.0;
        for (change, condition) in border.iter_mut().zip(&self.conditions) {
            *change = match *condition {
                Condition::Free => {
                    last = solution.next().copied().unwrap_or(0.0);
                    last
                }
                Condition::Known { change } => change,
                Condition::Follows { factor, change } => change + factor * last,
            };
        }
        is_finite
    }
}

/// Sets the tractions that follow from the statuses: none at open nodes, friction at slipping ones.
pub(super) fn settle(problem: &Problem<'_>, it: &mut Iterate) {
    for (i, status) in it.status.iter().enumerate() {
        match *status {
            Status::Open => (it.pressure[i], it.shear[i]) = (0.0, 0.0),
            Status::Stick => {}
            slipping => {
                it.shear[i] = slipping.direction() * problem.friction.at(i) * it.pressure[i];
            }
        }
    }
}
