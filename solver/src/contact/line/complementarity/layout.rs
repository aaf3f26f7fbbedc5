//! Rows, columns and scales of the complementarity problem.

use super::super::problem::{Iterate, Problem};
use super::super::response::Response;
use super::super::unknown::Unknown;

/// The bound of the height lies this many indentations below any possible height. Arbitrary: 4 solves the same of the
/// hard cases; 256 fails one of them by cancellation.
const HEIGHT_MARGIN: f64 = 16.0;

/// Rows and columns of the unknowns of `n` nodes, and the scales of pressure and length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    pub(super) n: usize,
    pub(super) sheared: bool,
    pub(super) pressure: f64,
    pub(super) length: f64,
    pub(super) lowest: f64,
}

impl Layout {
    pub(super) fn of(problem: &Problem<'_>, response: &Response, it: &Iterate) -> Self {
        let n = it.status.len();
        let range = problem
            .gap
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |m, g| {
                (m.0.min(*g), m.1.max(*g))
            });
        // Invalid if the last linear solve failed.
        let indentation = if it.indentation.is_finite() {
            it.indentation
        } else {
            0.0
        };
        let length = indentation.max(range.1 - range.0).max(f64::MIN_POSITIVE);
        let stiffest = (0..n)
            .map(|i| response.column(Unknown::pressure(problem, i)).0[i])
            .fold(f64::MIN_POSITIVE, f64::max);
        Self {
            n,
            sheared: problem.tracks_slip,
            pressure: length / stiffest,
            length,
            lowest: -range.1 - HEIGHT_MARGIN * length,
        }
    }

    pub(super) fn order(self) -> usize {
        if self.sheared {
            4 * self.n + 1
        } else {
            self.n + 1
        }
    }

    pub(super) fn height(self) -> usize {
        self.order() - 1
    }

    /// Row of a, of b and of gamma of a node.
    pub(super) fn shear(self, i: usize) -> [usize; 3] {
        [self.n + i, 2 * self.n + i, 3 * self.n + i]
    }
}
