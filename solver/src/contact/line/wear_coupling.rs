//! Wear in the contact solve: the gap that the wear of both surfaces opens.
//!
//! With e = p |sigma| and the specific wear rates k_s of the slave and k_m of the master at the coupled nodes, an
//! increment of n cycles opens the gaps
//!   F = W e,  W = n (diag k_s + S diag k_m),  S = Mhat D^-1 M^T,
//! where S transfers the master's recession to its nodes and averages it back. A rate that varies with p and |sigma|
//! adds its derivatives: dF/dp = W_p |sigma| with k + p dk/dp in place of k, dF/d|sigma| = W_s p with
//! k + |sigma| dk/d|sigma|. Uniform rates are assembled once an increment.

use super::band::Band;
use super::mortar::Coupling;
use super::pair::Pair;
use crate::law::wear::{LocalState, Rate, WearLaw};
use crate::sides::{Side, Sides};

/// Gap opening of an increment, and its derivatives.
#[derive(Debug, Default)]
pub(super) struct WearCoupling {
    laws: Sides<Option<WearLaw>>,
    cycles: f64,
    /// S; zero where the master does not wear.
    transfer: Band,
    /// States of the coupled nodes with their rates, where these vary.
    local: Vec<(LocalState, Sides<Rate>)>,
    opening: Band,
    per_pressure: Band,
    per_slip: Band,
}

impl WearCoupling {
    /// Assembles the matrices for the laws of both surfaces and a number of cycles. Rates that vary are evaluated by
    /// [`Self::linearise`].
    pub(super) fn assemble(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        laws: Sides<Option<WearLaw>>,
        cycles: f64,
    ) {
        self.laws = laws;
        self.cycles = cycles;
        self.transfer.reset(coupling.len(), 0);
        let (slave, master) = (pair.interface.slave, pair.interface.slave.other());
        if laws.of(master).is_some() {
            self.assemble_transfer(coupling, &pair.master().widths);
        }
        if !self.varies() {
            let rates = laws.map(|law| uniform(law) * cycles);
            let (own, far) = (*rates.of(slave), *rates.of(master));
            self.transfer.combine(|_| far, |_| own, &mut self.opening);
        }
    }

    fn assemble_transfer(&mut self, coupling: &Coupling, master_width: &[f64]) {
        let (n, b) = (coupling.len(), half_bandwidth(coupling));
        self.transfer.reset(n, b);
        for i in 0..n {
            let (to, averages) = coupling.dual_row(coupling.first + i);
            for l in i.saturating_sub(b)..(i + b + 1).min(n) {
                let (from, shares) = coupling.standard_row(coupling.first + l);
                let begin = to.max(from);
                let end = (to + averages.len()).min(from + shares.len());
                let mut sum = 0.0;
                for j in begin..end {
                    sum += averages[j - to] * shares[j - from] / master_width[j];
                }
                *self.transfer.at(i, l) = sum;
            }
        }
    }

    /// Whether a rate depends on the local state.
    pub(super) fn varies(&self) -> bool {
        let varies = |law: Option<WearLaw>| law.is_some_and(|law| law.uniform().is_none());
        varies(self.laws.slider) || varies(self.laws.receptacle)
    }

    /// Linearises rates that vary about the pressures and slips of the coupled nodes.
    pub(super) fn linearise(&mut self, slave: Side, states: impl Iterator<Item = LocalState>) {
        if !self.varies() {
            return;
        }
        let laws = self.laws;
        let rate = |at| laws.map(|law| law.map_or_else(Rate::default, |law| law.rate(at)));
        self.local.clear();
        self.local.extend(states.map(|at| (at, rate(at))));
        let (transfer, local, cycles) = (&self.transfer, &self.local, self.cycles);
        let master = slave.other();
        let combine = |factor: fn(LocalState, Rate) -> f64, combined: &mut Band| {
            let factor = |at, rate| cycles * factor(at, rate);
            transfer.combine(
                |l| factor(local[l].0, *local[l].1.of(master)),
                |l| factor(local[l].0, *local[l].1.of(slave)),
                combined,
            );
        };
        combine(|_, k| k.value, &mut self.opening);
        combine(
            |at, k| k.value + at.pressure * k.d_pressure,
            &mut self.per_pressure,
        );
        combine(|at, k| k.value + at.slip * k.d_slip, &mut self.per_slip);
    }

    /// W: gap opened per path p |sigma|, 1/MPa.
    pub(super) fn opening(&self) -> &Band {
        &self.opening
    }

    /// W_p: gap opened per pressure, over the slip.
    pub(super) fn per_pressure(&self) -> &Band {
        if self.varies() {
            &self.per_pressure
        } else {
            &self.opening
        }
    }

    /// W_s: gap opened per slip, over the pressure.
    pub(super) fn per_slip(&self) -> &Band {
        if self.varies() {
            &self.per_slip
        } else {
            &self.opening
        }
    }

    /// Writes the recession of both surfaces, mm, the slave's at the coupled nodes and the master's at its nodes in the
    /// coupled range; returns the worn areas as the integrals of the rates over the coupled nodes, mm^2.
    pub(super) fn recession(
        &self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        path: &[f64],
        recession: &mut Sides<Vec<f64>>,
    ) -> Sides<f64> {
        Sides::from_fn(|side| {
            let recession = recession.of_mut(side);
            recession.clear();
            let Some(law) = *self.laws.of(side) else {
                return 0.0;
            };
            // A uniform rate is a factor of the transferred path.
            let factor = law.uniform().unwrap_or(1.0) * self.cycles;
            let share = |(l, e): (usize, &f64)| match law.uniform() {
                Some(_) => *e,
                None => self.local[l].1.of(side).value * e,
            };
            let shares = path.iter().enumerate().map(share);
            let widths = &pair.slave().widths[coupling.first..];
            let area = widths.iter().zip(shares.clone());
            let area = factor * area.map(|(width, e)| width * e).sum::<f64>();
            if side == pair.interface.slave {
                recession.extend(shares);
            } else {
                transfer_path(coupling, &pair.master().widths, shares, recession);
            }
            for depth in recession.iter_mut() {
                *depth *= factor;
            }
            area
        })
    }
}

/// The specific wear rate of a law whose rate is uniform, 1/MPa.
fn uniform(law: Option<WearLaw>) -> f64 {
    law.and_then(WearLaw::uniform).unwrap_or(0.0)
}

/// Largest distance of two rows of the coupling that share a master node.
fn half_bandwidth(coupling: &Coupling) -> usize {
    let mut bandwidth = 0;
    for i in coupling.first..coupling.end {
        let (from, weights) = coupling.dual_row(i);
        let shares = |l: &usize| coupling.dual_row(*l).0 < from + weights.len();
        let last = (i..coupling.end).take_while(shares).last().unwrap_or(i);
        bandwidth = bandwidth.max(last - i);
    }
    bandwidth
}

/// Transfers a path p |sigma| from the coupled nodes to the master's nodes in the coupled range, MPa mm.
fn transfer_path(
    coupling: &Coupling,
    master_width: &[f64],
    path: impl Iterator<Item = f64>,
    transferred: &mut Vec<f64>,
) {
    let (begin, end) = coupling.master_range;
    transferred.resize(end - begin, 0.0);
    for (l, e) in path.enumerate().filter(|(_, e)| *e != 0.0) {
        let (from, weights) = coupling.standard_row(coupling.first + l);
        for (r, weight) in transferred[from - begin..].iter_mut().zip(weights) {
            *r += weight * e;
        }
    }
    for (r, width) in transferred.iter_mut().zip(&master_width[begin..end]) {
        *r /= width;
    }
}
