//! The response of both bodies at the coupled nodes, in the local frame of the receptacle's surface.

use super::mortar::Coupling;
use super::{ContactState, Pair, Surfaces};
use crate::linear::SquareMatrix;

/// Change of the gap (2 i) and of the tangential jump (2 i + 1) of each coupled node, per force along N and T.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// G = Mhat C_s Mhat^T + C_r, its rows and columns in the local frame, mm per N/mm.
    pub(super) local: SquareMatrix,
    /// Jump that the forces of the last increment would make at the new position (N and T components), mm.
    pub(super) last_jump: Vec<f64>,
    /// Slope at each coupled node.
    pub(super) slope: Vec<f64>,
    /// Slope of the slider's surface over each coupled node.
    slider_slope: Vec<f64>,
    slider_column: Vec<f64>,
}

impl Response {
    /// Gathers the response of the coupled nodes.
    pub(super) fn gather(
        &mut self,
        pair: &Pair<'_>,
        coupling: &Coupling,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
    ) {
        let n = coupling.len();
        self.local.reset(2 * n);
        self.slope.clear();
        self.slope
            .extend_from_slice(&surfaces.slope[coupling.first..coupling.end]);
        self.slider_slope.clear();
        for i in coupling.first..coupling.end {
            let (from, weights) = coupling.dual_row(i);
            let slopes = weights.iter().zip(&surfaces.slider_slope[from..]);
            self.slider_slope
                .push(slopes.map(|(weight, slope)| weight * slope).sum());
        }
        for k in 0..n {
            for direction in 0..2 {
                self.gather_column(pair, coupling, k, direction);
            }
        }
        forces_to_local_frame(&mut self.local, &self.slope);
        self.gather_last_jump(pair, coupling, last);
    }

    /// Column of the response to a force at coupled node k along x or y.
    fn gather_column(&mut self, pair: &Pair<'_>, coupling: &Coupling, k: usize, direction: usize) {
        let (begin, end) = coupling.slider_range;
        let slider = &pair.operators.slider.compliance;
        let receptacle = &pair.operators.receptacle.compliance;
        self.slider_column.clear();
        self.slider_column.resize(2 * (end - begin), 0.0);
        let (from, weights) = coupling.dual_row(coupling.first + k);
        for (offset, weight) in weights.iter().enumerate() {
            let column = &slider.column(2 * (from + offset) + direction)[2 * begin..2 * end];
            for (sum, c) in self.slider_column.iter_mut().zip(column) {
                *sum += weight * c;
            }
        }
        let own = &receptacle.column(2 * (coupling.first + k) + direction)
            [2 * coupling.first..2 * coupling.end];
        let target = self.local.column_mut(2 * k + direction);
        for (i, (t, r)) in target
            .chunks_exact_mut(2)
            .zip(own.chunks_exact(2))
            .enumerate()
        {
            let (from, weights) = coupling.dual_row(coupling.first + i);
            let (mut x, mut y) = (0.0, 0.0);
            let slider = self.slider_column[2 * (from - begin)..].chunks_exact(2);
            for (weight, u) in weights.iter().zip(slider) {
                x += weight * u[0];
                y += weight * u[1];
            }
            let (x, y) = (x + r[0], y + r[1]);
            t[0] = y - self.slider_slope[i] * x;
            t[1] = x + self.slope[i] * y;
        }
    }

    fn gather_last_jump(&mut self, pair: &Pair<'_>, coupling: &Coupling, last: &ContactState) {
        let (begin, end) = coupling.slider_range;
        let n = coupling.len();
        self.slider_column.clear();
        self.slider_column.resize(2 * (end - begin), 0.0);
        accumulate(
            &mut self.slider_column,
            &pair.operators.slider.compliance,
            &last.slider_force,
            2 * begin,
        );
        self.last_jump.clear();
        self.last_jump.resize(2 * n, 0.0);
        accumulate(
            &mut self.last_jump,
            &pair.operators.receptacle.compliance,
            &last.receptacle_force,
            2 * coupling.first,
        );
        for (i, s) in self.slope.iter().enumerate() {
            let (from, weights) = coupling.dual_row(coupling.first + i);
            let (mut x, mut y) = (self.last_jump[2 * i], self.last_jump[2 * i + 1]);
            for (offset, weight) in weights.iter().enumerate() {
                x += weight * self.slider_column[2 * (from + offset - begin)];
                y += weight * self.slider_column[2 * (from + offset - begin) + 1];
            }
            self.last_jump[2 * i] = y - s * x;
            self.last_jump[2 * i + 1] = x + s * y;
        }
    }
}

/// target += (rows of the compliance from `first_row`) * force, over the forces that are not zero.
fn accumulate(target: &mut [f64], compliance: &SquareMatrix, force: &[f64], first_row: usize) {
    for (column, f) in force.iter().enumerate().filter(|(_, f)| **f != 0.0) {
        let c = &compliance.column(column)[first_row..first_row + target.len()];
        for (sum, c) in target.iter_mut().zip(c) {
            *sum += f * c;
        }
    }
}

/// Turns columns for forces along (x, y) into columns for forces along N = (-s, 1) and T = (1, s).
fn forces_to_local_frame(g: &mut SquareMatrix, slope: &[f64]) {
    for (k, s) in slope.iter().enumerate() {
        for row in 0..g.order() {
            let (x, y) = (g.get(row, 2 * k), g.get(row, 2 * k + 1));
            *g.at(row, 2 * k) = y - s * x;
            *g.at(row, 2 * k + 1) = x + s * y;
        }
    }
}
