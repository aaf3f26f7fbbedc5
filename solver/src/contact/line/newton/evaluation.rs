//! Evaluation of an iterate: gaps, slips and paths under its tractions.

use super::super::deformation::{Deformation, WIDE};
use super::super::problem::{GAP_TOLERANCE, Iterate, Problem};
use super::super::response::Response;
use super::super::status::Status;
use super::super::unknown::Unknown;
use super::super::wear_coupling::WearCoupling;
use crate::linear::vector::{add_scaled, vectorized};

/// Round-off of a gap over the largest length in its sum: some units in the last place.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// Buffers of the evaluation.
#[derive(Debug, Default)]
pub(super) struct Evaluation {
    /// Gaps and slips by deformation.
    gap: Vec<f64>,
    slip: Vec<f64>,
    /// Forces of the unknowns on the slider at the coupled nodes.
    force: Vec<f64>,
    deformation: Deformation,
}

impl Evaluation {
    /// Slips, paths and gaps of the iterate; returns the largest gap of a closed node over the indentation.
    pub(super) fn evaluate(
        &mut self,
        problem: &Problem<'_>,
        unknowns: &[Unknown],
        response: &Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
    ) -> f64 {
        let n = it.status.len();
        self.deform(problem, unknowns, response, it);
        let mut indentation = 0.0_f64;
        for (i, fixed) in problem.fixed_slip.iter().enumerate() {
            it.slip[i] = fixed + problem.slope[i] * it.height;
            if problem.tracks_slip {
                it.slip[i] += self.slip[i];
            }
            it.path[i] = if problem.along.is_empty() {
                let slips = it.status[i].direction() * it.slip[i];
                (it.pressure[i] * slips).max(0.0)
            } else {
                let at = it.local_state(i, it.status[i]);
                (at.pressure * at.slip).max(0.0)
            };
            if it.status[i] != Status::Open {
                indentation = indentation.max(self.gap[i].abs());
            }
        }
        // The wear alone first: it is part of the scale of gaps.
        it.gap.clear();
        it.gap.resize(n, 0.0);
        if problem.wears {
            let states = (0..n).map(|l| it.local_state(l, it.status[l]));
            wear.linearise(problem.coupling, problem.pair, &states);
            wear.opening().add_product(&(0..n), &it.path, &mut it.gap);
            if let Some(other) = wear.other_opening() {
                for (gap, opened) in it.gap.iter_mut().zip(&other.opened) {
                    *gap += opened;
                }
            }
        }
        let (mut residual, mut largest) = (0.0_f64, 0.0_f64);
        for (i, jump) in self.gap.iter().enumerate() {
            let raised = (1.0 + problem.sag[i]) * it.height;
            let worn = it.gap[i];
            it.gap[i] = problem.gap[i] + raised + jump + worn;
            if it.status[i] != Status::Open {
                indentation = indentation.max(worn);
                residual = residual.max(it.gap[i].abs());
                // A closed gap is the difference of the undeformed gap and the height, each at most this large unless
                // the system was nearly singular.
                largest = largest.max(2.0 * problem.gap[i].abs());
            }
        }
        it.indentation = indentation;
        let scale = indentation.max(f64::MIN_POSITIVE);
        it.tolerance = GAP_TOLERANCE.max(ROUND_OFF * largest / scale);
        residual / scale
    }

    /// Gaps and slips by deformation under the unknowns of an iterate.
    fn deform(
        &mut self,
        problem: &Problem<'_>,
        unknowns: &[Unknown],
        response: &Response,
        it: &Iterate,
    ) {
        for values in [&mut self.gap, &mut self.slip] {
            values.clear();
            values.resize(it.status.len(), 0.0);
        }
        if it.status.len() >= WIDE {
            self.deform_wide(problem, unknowns, it);
            return;
        }
        vectorized(
            #[inline(always)]
            || {
                for unknown in unknowns {
                    let value = unknown.value(it);
                    if value != 0.0 {
                        let (gap, slip) = response.column(*unknown);
                        add_scaled(&mut self.gap, value, gap);
                        add_scaled(&mut self.slip, value, slip);
                    }
                }
            },
        );
    }

    /// The same of a wide contact, whose responses are not computed one by one.
    fn deform_wide(&mut self, problem: &Problem<'_>, unknowns: &[Unknown], it: &Iterate) {
        self.force.clear();
        self.force.resize(2 * it.status.len(), 0.0);
        for unknown in unknowns {
            let (value, [x, y]) = (unknown.value(it), unknown.force(problem));
            let node = unknown.node();
            self.force[2 * node] += value * x;
            self.force[2 * node + 1] += value * y;
        }
        let coupling = problem.coupling;
        self.deformation
            .under_forces(problem.zones, coupling, &self.force);
        let displacements = self.deformation.averaged(coupling).enumerate();
        for (i, [x, y]) in displacements {
            self.gap[i] = y - problem.master_slope[i] * x;
            self.slip[i] = x + problem.slope[i] * y;
        }
    }
}
