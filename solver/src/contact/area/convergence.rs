//! Convergence of the pressures of a contact.

/// Iterations without a smaller residual after which cells join with less pressure. Arbitrary: what converges has a smaller one every few.
const STALLED: usize = 30;

/// Convergence of the iteration.
pub(super) struct Convergence {
    /// Product of the last residual with the preconditioned one; 0 where directions begin again.
    pub(super) product: f64,
    /// Smallest residual, and iterations since.
    least: f64,
    since: usize,
    /// Part of the pressure of an overlap that a cell joins with.
    pub(super) joining: f64,
}

impl Default for Convergence {
    fn default() -> Self {
        Self {
            product: 0.0,
            least: f64::INFINITY,
            since: 0,
            joining: 1.0,
        }
    }
}

impl Convergence {
    /// Notes a residual. Where it does not become smaller, cells join with a tenth of the pressure.
    pub(super) fn note(&mut self, residual: f64) {
        self.since += 1;
        if residual < self.least {
            (self.least, self.since) = (residual, 0);
        }
        if self.since == STALLED {
            self.joining *= 0.1;
            self.since = 0;
        }
    }
}
