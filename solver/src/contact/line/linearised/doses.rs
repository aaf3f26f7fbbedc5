//! Doses that the pressures of a contact give both surfaces, and their change with the depths.
//!
//! A node of the slave takes the dose w p, with its path w at the position; a node j of the master takes its shares
//! sum_i w_i (integral phi_i phi_j) p_i/d_j, so that each surface takes the work sum_i w_i d_i p_i. A change of the depths opens the gap of a
//! node of the slave by its own depth and the mean of the master's, and changes the pressures by -T times that.

use super::super::pair::Pair;
use super::super::status::Status;
use super::LinearisedContact;
use super::unknowns::DoseUnknowns;
use crate::linear::vector::{add_scaled, vectorized};
use crate::linear::{BorderedBand, Column};
use crate::sides::{Side, Sides};
use std::ops::Range;

impl LinearisedContact {
    /// Adds the nodes of those sides that wear under the closed nodes to the unknowns.
    pub(crate) fn insert_unknowns(
        &self,
        pair: &Pair<'_>,
        wears: Sides<bool>,
        unknowns: &mut DoseUnknowns,
    ) {
        let slave = pair.interface.slave;
        let coupling = &self.geometry.coupling;
        // Those that the next inverse belongs to.
        let statuses = self.iterate.status.iter().enumerate();
        for (number, _) in statuses.filter(|(_, status)| **status != Status::Open) {
            let node = coupling.first + number;
            if *wears.of(slave) {
                unknowns.insert(slave, node);
            }
            if *wears.of(slave.other()) {
                let (from, shares) = coupling.dual_row(node);
                for j in from..from + shares.len() {
                    unknowns.insert(slave.other(), j);
                }
            }
        }
    }

    /// Nodes of a side under the closed nodes, with those between them.
    pub(crate) fn nodes_of(&self, pair: &Pair<'_>, side: Side) -> Range<usize> {
        let coupling = &self.geometry.coupling;
        let (Some(first), Some(last)) = (self.closed.first(), self.closed.last()) else {
            return 0..0;
        };
        let nodes = coupling.first + first..coupling.first + last + 1;
        if side == pair.interface.slave {
            nodes
        } else {
            coupling.masters(&nodes)
        }
    }

    /// Adds the doses of the pressures over a path of the slider in mm to both surfaces.
    pub(crate) fn add_doses(&self, pair: &Pair<'_>, path: f64, doses: &mut Sides<Vec<f64>>) {
        let slave = pair.interface.slave;
        let (coupling, widths) = (&self.geometry.coupling, &pair.master().widths);
        for closed in &self.closed {
            let node = coupling.first + closed;
            let dose = path * self.slip(*closed) * self.iterate.pressure[*closed];
            doses.of_mut(slave)[node] += dose;
            let (from, shares) = coupling.standard_row(node);
            let master = &mut doses.of_mut(slave.other())[from..];
            for ((taken, share), width) in master.iter_mut().zip(shares).zip(&widths[from..]) {
                *taken += dose * share / width;
            }
        }
    }

    /// Adds the change of the doses per change of the depths, times a factor, to a matrix of the unknowns.
    pub(crate) fn add_sensitivity(
        &self,
        pair: &Pair<'_>,
        unknowns: &DoseUnknowns,
        factor: f64,
        change: &mut Vec<f64>,
        matrix: &mut BorderedBand,
    ) {
        let slave = pair.interface.slave;
        let coupling = &self.geometry.coupling;
        let inverse = self.inverse.inverse();
        let n = self.closed.len();
        // The pressures fall with the gaps: their changes are the columns of the inverse times -1.
        for (j, closed) in self.closed.iter().enumerate() {
            if let Some(column) = unknowns.of(slave, coupling.first + closed) {
                self.scatter(
                    pair,
                    unknowns,
                    -factor,
                    &inverse.column(j)[..n],
                    &mut matrix.column_mut(column),
                );
            }
        }
        let masters = self.nodes_of(pair, slave.other());
        let Some(begin) = masters
            .clone()
            .find(|j| unknowns.of(slave.other(), *j).is_some())
        else {
            return;
        };
        change.clear();
        change.resize(masters.len() * n, 0.0);
        vectorized(
            #[inline(always)]
            || {
                for (i, closed) in self.closed.iter().enumerate() {
                    let (from, weights) = coupling.dual_row(coupling.first + closed);
                    for (j, weight) in (from..).zip(weights) {
                        let at = (j - masters.start) * n;
                        add_scaled(&mut change[at..at + n], *weight, &inverse.column(i)[..n]);
                    }
                }
            },
        );
        for j in begin..masters.end {
            if let Some(column) = unknowns.of(slave.other(), j) {
                let at = (j - masters.start) * n;
                self.scatter(
                    pair,
                    unknowns,
                    -factor,
                    &change[at..at + n],
                    &mut matrix.column_mut(column),
                );
            }
        }
    }

    /// Adds the doses of changes of the pressures of closed nodes, times a factor, to a column of the unknowns.
    fn scatter(
        &self,
        pair: &Pair<'_>,
        unknowns: &DoseUnknowns,
        factor: f64,
        pressures: &[f64],
        column: &mut Column<'_>,
    ) {
        let slave = pair.interface.slave;
        let (coupling, widths) = (&self.geometry.coupling, &pair.master().widths);
        for (closed, pressure) in self.closed.iter().zip(pressures) {
            let dose = factor * self.slip(*closed) * pressure;
            let node = coupling.first + closed;
            if let Some(row) = unknowns.of(slave, node) {
                column.add(row, dose);
            }
            let (from, shares) = coupling.standard_row(node);
            for (j, share) in (from..).zip(shares) {
                if let Some(row) = unknowns.of(slave.other(), j) {
                    column.add(row, dose * share / widths[j]);
                }
            }
        }
    }
}
