//! Slopes of both surfaces at the coupled nodes: they span the local frames and shift the gap with the jump.

use super::mortar::Coupling;
use super::pair::{Pair, Surfaces};

/// Slopes at the coupled nodes, -.
#[derive(Debug, Default)]
pub(in crate::contact) struct LocalSlopes {
    /// The interface, between both surfaces: N = (-s, 1), T = (1, s).
    pub(in crate::contact) interface: Vec<f64>,
    /// The master's surface.
    pub(in crate::contact) master: Vec<f64>,
}

impl LocalSlopes {
    /// Reads the slave's slopes at its nodes and averages the master's over them.
    pub(in crate::contact) fn assemble(
        &mut self,
        pair: &Pair<'_>,
        coupling: &Coupling,
        surfaces: &Surfaces<'_>,
    ) {
        let slave = pair.interface.slave;
        let far = *surfaces.slope.of(slave.other());
        self.master.clear();
        for i in coupling.first..coupling.end {
            let (from, weights) = coupling.dual_row(i);
            let slopes = weights.iter().zip(&far[from..]);
            let slope = slopes.map(|(weight, slope)| weight * slope).sum();
            self.master.push(slope);
        }
        let own = &surfaces.slope.of(slave)[coupling.first..coupling.end];
        self.interface.clear();
        let weight = pair.interface.slope_weights;
        for (own, far) in own.iter().zip(&self.master) {
            self.interface
                .push(weight.of(slave) * own + weight.of(slave.other()) * far);
        }
    }
}
