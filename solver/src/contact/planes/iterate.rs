//! An iterate of the solution over the coupled nodes of all planes.

use super::problem::Problem;

/// Tractions and height.
#[derive(Debug, Default)]
pub(super) struct Iterate {
    pub(super) is_closed: Vec<bool>,
    pub(super) pressure: Vec<f64>,
    /// Magnitude of the slip, mm, and p |sigma|, MPa mm.
    pub(super) slip: Vec<f64>,
    pub(super) path: Vec<f64>,
    pub(super) gap: Vec<f64>,
    pub(super) height: f64,
    /// Largest indentation, mm: the scale of gaps; and the residual over it at which the iteration has converged.
    pub(super) indentation: f64,
    pub(super) tolerance: f64,
    /// The residual of the solution.
    pub(super) residual: f64,
}

impl Iterate {
    /// Resets to an open contact of so many nodes at a height.
    pub(super) fn reset(&mut self, nodes: usize, height: f64) {
        self.is_closed.clear();
        self.is_closed.resize(nodes, false);
        self.pressure.clear();
        self.pressure.resize(nodes, 0.0);
        self.height = height;
    }

    /// The load at the height less the vertical forces, N/mm.
    pub(super) fn balance(&self, problem: &Problem) -> f64 {
        let n = problem.nodes();
        let forces = self.pressure.iter().zip(&problem.force).enumerate();
        let load = problem.load + problem.spring * self.height;
        forces.fold(load, |balance, (node, (p, force))| {
            balance - problem.shares[node / n] * force[1] * p
        })
    }
}
