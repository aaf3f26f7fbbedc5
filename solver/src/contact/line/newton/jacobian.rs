//! The Jacobian of an increment: equations of the unknowns, in their order, and the vertical balance.
//!
//! The balance is divided by the contact modulus E*: as a length, like the gaps beside it, it does not make the pivots depend on the
//! unit of stress.

use super::super::band::Band;
use super::super::problem::{Iterate, Problem};
use super::super::response::Response;
use super::super::unknown::Unknown;
use super::super::wear_coupling::WearCoupling;
use super::partition::Partition;
use crate::linear::SquareMatrix;
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
}

impl Jacobian {
    /// Writes the derivatives of the gaps of closed nodes, of the slips of sticking ones and of the vertical balance.
    pub(super) fn assemble(
        &mut self,
        problem: &Problem<'_>,
        partition: &Partition,
        response: &Response,
        wear: &mut WearCoupling,
        (it, lumped): (&Iterate, bool),
        matrix: &mut SquareMatrix,
    ) {
        let n = it.status.len();
        let unknowns = &partition.unknowns;
        let span = span(unknowns);
        let modulus = problem.pair.interface.modulus;
        self.gap.resize(n, 0.0);
        self.slip.resize(n, 0.0);
        let local = |node: usize| it.local_state(node, partition.status(it, node));
        let direction = |node: usize| it.slip_direction(node, partition.status(it, node));
        if problem.wears {
            wear.linearise(problem.coupling, problem.pair, &(0..n).map(local));
            let per_slip = |l: usize| direction(l) * it.pressure[l];
            wear.per_slip()
                .combine(per_slip, |_| 0.0, &mut self.opening);
            if lumped {
                self.opening.lump();
            }
        }
        let other = wear.other_opening().filter(|_| problem.wears);
        if let Some(other) = other {
            let per_slip = &mut self.other_opening;
            other.per_slip.combine(direction, |_| 0.0, per_slip);
            if lumped {
                per_slip.lump();
            }
        }
        for (u, unknown) in unknowns.iter().enumerate() {
            let (gap, slip) = response.column(*unknown);
            self.gap[span.clone()].copy_from_slice(&gap[span.clone()]);
            if problem.wears {
                if problem.tracks_slip {
                    self.opening.add_product(&span, slip, &mut self.gap);
                }
                if let Unknown::Pressure(a, _) = *unknown {
                    wear.open_by_pressure(&span, a, local(a).slip, &mut self.gap);
                }
            }
            if other.is_some() && problem.tracks_slip {
                self.other_opening.add_product(&span, slip, &mut self.gap);
            }
            let balance = problem.force_weight() * unknown.force(problem)[1];
            write_column(
                unknowns,
                &self.gap,
                slip,
                balance / modulus,
                matrix.column_mut(u),
            );
        }
        for i in span.clone() {
            self.gap[i] = 1.0 + problem.sag[i];
            self.slip[i] = problem.slope[i];
        }
        if problem.wears {
            self.opening.add_product(&span, &self.slip, &mut self.gap);
        }
        if other.is_some() {
            self.other_opening
                .add_product(&span, &self.slip, &mut self.gap);
        }
        let height = matrix.column_mut(unknowns.len());
        write_column(
            unknowns,
            &self.gap,
            &self.slip,
            -problem.spring / modulus,
            height,
        );
    }
}

fn write_column(unknowns: &[Unknown], gap: &[f64], slip: &[f64], balance: f64, column: &mut [f64]) {
    for (entry, unknown) in column.iter_mut().zip(unknowns) {
        *entry = match *unknown {
            Unknown::Pressure(i, _) => gap[i],
            Unknown::Shear(i) => slip[i],
        };
    }
    column[unknowns.len()] = balance;
}

/// From the first node with an unknown to the last.
fn span(unknowns: &[Unknown]) -> Range<usize> {
    let nodes = unknowns.iter().map(|unknown| unknown.node());
    let first = nodes.clone().min().unwrap_or(0);
    first..nodes.max().map_or(first, |last| last + 1)
}
