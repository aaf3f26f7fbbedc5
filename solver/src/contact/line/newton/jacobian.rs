//! The Jacobian of an increment: equations of the unknowns, in their order, and the vertical balance.
//!
//! The balance is divided by the contact modulus E*: as a length, like the gaps beside it, it does not make the pivots depend on the
//! unit of stress.

use super::super::band::Band;
use super::super::problem::{Iterate, Problem};
use super::super::response::{Column, Response};
use super::super::unknown::Unknown;
use super::super::wear_coupling::WearCoupling;
use super::hierarchical::Hierarchical;
use super::partition::Partition;
use crate::linear::{Blocks, SquareMatrix};
use std::ops::Range;

/// Buffers of the assembly.
#[derive(Debug, Default)]
pub(super) struct Jacobian {
    /// Gaps and slips of the coupled nodes per unit of an unknown.
    gap: Vec<f64>,
    slip: Vec<f64>,
    /// Gap opened by wear, per slip: by the path, and by no path.
    opening: Band,
    other_opening: Band,
    pub(super) hierarchical: Hierarchical,
}

impl Jacobian {
    /// Writes the derivatives of the gaps of closed nodes, of the slips of sticking ones and of the vertical balance, from wear that
    /// [`Self::linearise_wear`] has linearised.
    pub(super) fn assemble(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        response: &Response,
        wear: &WearCoupling,
        it: &Iterate,
        matrix: &mut SquareMatrix,
    ) {
        let unknowns = &partition.unknowns;
        let span = span(unknowns);
        for (u, unknown) in unknowns.iter().enumerate() {
            let slip_at = |node| it.local_state(node, partition.status(it, node)).slip;
            let responses = response.column(*unknown);
            let slip = self.respond(problem, responses, wear, &span, *unknown, slip_at);
            let balance = balance(problem, *unknown);
            write_column(unknowns, &self.gap, slip, balance, matrix.column_mut(u));
        }
        self.raise(problem, wear, &span);
        let modulus = problem.pair.interface.modulus;
        write_column(
            unknowns,
            &self.gap,
            &self.slip,
            -problem.spring / modulus,
            matrix.column_mut(unknowns.len()),
        );
    }

    /// The same with a core whose off-diagonal blocks have low rank, from the responses of the border alone; the opening by slips is
    /// that of lumped wear.
    pub(super) fn assemble_hierarchical(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        response: &Response,
        wear: &WearCoupling,
        it: &Iterate,
        blocks: Blocks<'_>,
    ) {
        let Blocks {
            core: matrix,
            right,
            below,
            corner,
        } = blocks;
        let unknowns = &partition.unknowns;
        let span = span(unknowns);
        let slip_at = |node| it.local_state(node, partition.status(it, node)).slip;
        let opening = |node| {
            let mut opening = 0.0;
            if problem.wears && problem.tracks_slip {
                opening += self.opening.diagonal(node);
                if wear.other_opening().is_some() {
                    opening += self.other_opening.diagonal(node);
                }
            }
            opening
        };
        self.hierarchical
            .write_equations(problem, unknowns, opening);
        if problem.wears {
            self.hierarchical
                .write_wear(partition, wear, it.status.len(), slip_at);
        }
        let core = partition.core;
        let (inner, border) = unknowns.split_at(core);
        let mut columns = right.chunks_exact_mut(core);
        let mut column = || columns.next().unwrap_or_default();
        for (b, unknown) in border.iter().enumerate() {
            let responses = response.column(*unknown);
            let slip = self.respond(problem, responses, wear, &span, *unknown, slip_at);
            write_entries(inner, &self.gap, slip, column());
            let balance = balance(problem, *unknown);
            write_column(border, &self.gap, slip, balance, corner.column_mut(b));
        }
        self.raise(problem, wear, &span);
        write_entries(inner, &self.gap, &self.slip, column());
        let spring = -problem.spring / problem.pair.interface.modulus;
        let beside = corner.column_mut(border.len());
        write_column(border, &self.gap, &self.slip, spring, beside);
        self.hierarchical
            .write_core(problem, partition, matrix, below);
        let balances = below[border.len() * core..].iter_mut().zip(inner);
        for (entry, unknown) in balances {
            *entry = balance(problem, *unknown);
        }
    }

    /// Linearises the wear about an iterate, with lumped openings if asked.
    pub(super) fn linearise_wear(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        wear: &mut WearCoupling,
        it: &Iterate,
        lumped: bool,
    ) {
        if !problem.wears {
            return;
        }
        let local = |node: usize| it.local_state(node, partition.status(it, node));
        let direction = |node: usize| it.slip_direction(node, partition.status(it, node));
        let n = it.status.len();
        wear.linearise(problem.coupling, problem.pair, &(0..n).map(local));
        let per_slip = |l: usize| direction(l) * it.pressure[l];
        wear.per_slip()
            .combine(per_slip, |_| 0.0, &mut self.opening);
        if lumped {
            self.opening.lump();
        }
        if let Some(other) = wear.other_opening() {
            let per_slip = &mut self.other_opening;
            other.per_slip.combine(direction, |_| 0.0, per_slip);
            if lumped {
                per_slip.lump();
            }
        }
    }

    /// Writes the gaps that an unknown opens, with its wear; returns the slips.
    fn respond<'a>(
        &mut self,
        problem: &Problem<'_>,
        (gap, slip): Column<'a>,
        wear: &WearCoupling,
        span: &Range<usize>,
        unknown: Unknown,
        slip_at: impl Fn(usize) -> f64,
    ) -> &'a [f64] {
        self.gap.resize(problem.coupling.len(), 0.0);
        self.gap[span.clone()].copy_from_slice(&gap[span.clone()]);
        if problem.wears {
            if problem.tracks_slip {
                self.opening.add_product(span, slip, &mut self.gap);
            }
            if let Unknown::Pressure(node, _) = unknown {
                wear.open_by_pressure(span, node, slip_at(node), &mut self.gap);
            }
            if wear.other_opening().is_some() && problem.tracks_slip {
                self.other_opening.add_product(span, slip, &mut self.gap);
            }
        }
        slip
    }

    /// Writes the gaps and slips per height.
    fn raise(&mut self, problem: &Problem<'_>, wear: &WearCoupling, span: &Range<usize>) {
        let n = problem.coupling.len();
        self.gap.resize(n, 0.0);
        self.slip.resize(n, 0.0);
        for i in span.clone() {
            self.gap[i] = 1.0 + problem.sag[i];
            self.slip[i] = problem.slope[i];
        }
        if problem.wears {
            self.opening.add_product(span, &self.slip, &mut self.gap);
            if wear.other_opening().is_some() {
                self.other_opening
                    .add_product(span, &self.slip, &mut self.gap);
            }
        }
    }
}

/// An unknown's part in the vertical balance, as a length.
fn balance(problem: &Problem<'_>, unknown: Unknown) -> f64 {
    problem.force_weight() * unknown.force(problem)[1] / problem.pair.interface.modulus
}

fn write_column(unknowns: &[Unknown], gap: &[f64], slip: &[f64], balance: f64, column: &mut [f64]) {
    write_entries(unknowns, gap, slip, column);
    column[unknowns.len()] = balance;
}

/// Writes what an unknown or the height has in the equations of unknowns.
fn write_entries(unknowns: &[Unknown], gap: &[f64], slip: &[f64], column: &mut [f64]) {
    for (entry, unknown) in column.iter_mut().zip(unknowns) {
        *entry = match *unknown {
            Unknown::Pressure(i, _) => gap[i],
            Unknown::Shear(i) => slip[i],
        };
    }
}

/// From the first node with an unknown to the last.
fn span(unknowns: &[Unknown]) -> Range<usize> {
    let nodes = unknowns.iter().map(|unknown| unknown.node());
    let first = nodes.clone().min().unwrap_or(0);
    first..nodes.max().map_or(first, |last| last + 1)
}
