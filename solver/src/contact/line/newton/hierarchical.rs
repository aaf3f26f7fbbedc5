//! The Jacobian's core as rows and columns that are computed when they are asked for: with few of them its off-diagonal blocks are
//! approximated.
//!
//! The entry of equation k and unknown l is e_k . U(i_k, j_l) f_l, with the relative displacement U of node i by a force at node j
//! (symmetric, like the compliances), the force f of the unknown, and e of the gap, (-s_m, 1), or of the slip, (1, s). The wear by slip adds
//! a multiple of the slip's equation to the gap's of the same node, that by pressure few entries beside the diagonal.

use super::super::deformation::Deformation;
use super::super::problem::Problem;
use super::super::unknown::Unknown;
use super::super::wear_coupling::WearCoupling;
use super::partition::Partition;
use crate::linear::{Approximation, Entries, Hodlr};
use crate::number::count;
use std::ops::Range;

/// Accuracy of the core's approximation: chord steps and their correction do the rest. Arbitrary: 1e-2 and 1e-4 take as
/// long, to 20 % (`cargo bench -p solver -- partial_slip`).
const APPROXIMATION: Approximation = Approximation {
    tolerance: 1e-3,
    compared: false,
    symmetric: false,
};

/// Buffers of the equations.
#[derive(Debug, Default)]
pub(super) struct Hierarchical {
    /// f and e of each unknown.
    force: Vec<[f64; 2]>,
    equation: Vec<[f64; 2]>,
    /// Equation of the gap of each coupled node.
    gap_equation: Vec<Option<usize>>,
    /// Entries of the wear by pressure: equation, unknown, value, by unknowns of the core.
    wear: Vec<(usize, usize, f64)>,
    opened: Vec<f64>,
    deformation: Deformation,
    /// Entries of the Jacobian computed since the last reset of the count.
    pub(super) entries: u64,
}

/// The smooth part of the Jacobian.
struct Influence<'a> {
    problem: &'a Problem<'a>,
    unknowns: &'a [Unknown],
    force: &'a [[f64; 2]],
    equation: &'a [[f64; 2]],
    deformation: &'a mut Deformation,
    entries: &'a mut u64,
}

impl Hierarchical {
    /// Writes forces and equations of unknowns, the wear of whose nodes opens gaps by so much per slip.
    pub(super) fn write_equations(
        &mut self,
        problem: &Problem<'_>,
        unknowns: &[Unknown],
        opening: impl Fn(usize) -> f64,
    ) {
        self.wear.clear();
        self.force.clear();
        self.equation.clear();
        for unknown in unknowns {
            self.force.push(unknown.force(problem));
            let node = unknown.node();
            let slope = problem.slope[node];
            self.equation.push(match unknown {
                Unknown::Shear(_) => [1.0, slope],
                Unknown::Pressure(..) => {
                    let opening = opening(node);
                    [opening - problem.master_slope[node], 1.0 + opening * slope]
                }
            });
        }
    }

    /// Writes the entries of the wear by pressure.
    pub(super) fn write_wear(
        &mut self,
        partition: &Partition,
        wear: &WearCoupling,
        nodes: usize,
        slip_at: impl Fn(usize) -> f64,
    ) {
        self.gap_equation.clear();
        self.gap_equation.resize(nodes, None);
        for (k, unknown) in partition.unknowns.iter().enumerate() {
            if let Unknown::Pressure(node, _) = unknown {
                self.gap_equation[*node] = Some(k);
            }
        }
        self.opened.clear();
        self.opened.resize(nodes, 0.0);
        let reach = wear.reach();
        for (l, unknown) in partition.unknowns[..partition.core].iter().enumerate() {
            let Unknown::Pressure(node, _) = *unknown else {
                continue;
            };
            let near = node.saturating_sub(reach)..(node + reach + 1).min(nodes);
            wear.open_by_pressure(&near, node, slip_at(node), &mut self.opened);
            for i in near {
                let opened = std::mem::take(&mut self.opened[i]);
                if let Some(k) = self.gap_equation[i].filter(|_| opened != 0.0) {
                    self.wear.push((k, l, opened));
                }
            }
        }
    }

    /// Approximates the core and writes the border's rows in it, but for that of the balance.
    pub(super) fn write_core(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        matrix: &mut Hodlr,
        below: &mut [f64],
    ) {
        let core = partition.core;
        let mut influence = Influence {
            problem,
            unknowns: &partition.unknowns,
            force: &self.force,
            equation: &self.equation,
            deformation: &mut self.deformation,
            entries: &mut self.entries,
        };
        let border = partition.unknowns.len() - core;
        for (k, row) in below.chunks_exact_mut(core).take(border).enumerate() {
            influence.row(core + k, 0..core, row);
        }
        for (k, l, opened) in self.wear.iter().filter(|entry| entry.0 >= core) {
            below[(k - core) * core + l] += opened;
        }
        self.wear.retain(|entry| entry.0 < core);
        matrix.approximate(core, &mut influence, &self.wear, APPROXIMATION);
    }
}

impl Influence<'_> {
    /// Writes the products of vectors with the displacements at the nodes of a range of the core by a force at a node.
    fn write(
        &mut self,
        node: usize,
        force: [f64; 2],
        range: Range<usize>,
        vectors: &[[f64; 2]],
        entries: &mut [f64],
    ) {
        *self.entries += count(range.len());
        let coupling = self.problem.coupling;
        let first = coupling.first;
        let (begin, end) = (
            self.unknowns[range.start].node(),
            self.unknowns[range.end - 1].node(),
        );
        let nodes = first + begin..first + end + 1;
        let deformation = &mut *self.deformation;
        deformation.under_force(self.problem.zones, coupling, first + node, force, nodes);
        let unknowns = &self.unknowns[range.clone()];
        let mut rows = unknowns.iter().zip(&vectors[range]).zip(entries).peekable();
        for (at, [x, y]) in (begin..).zip(deformation.averaged(coupling)) {
            while let Some(((_, vector), entry)) =
                rows.next_if(|((unknown, _), _)| unknown.node() == at)
            {
                *entry = vector[0] * x + vector[1] * y;
            }
        }
    }
}

impl Entries for Influence<'_> {
    fn row(&mut self, row: usize, columns: Range<usize>, entries: &mut [f64]) {
        let (node, equation) = (self.unknowns[row].node(), self.equation[row]);
        self.write(node, equation, columns, self.force, entries);
    }

    fn column(&mut self, column: usize, rows: Range<usize>, entries: &mut [f64]) {
        let (node, force) = (self.unknowns[column].node(), self.force[column]);
        self.write(node, force, rows, self.equation, entries);
    }
}
