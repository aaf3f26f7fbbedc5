//! Wear in the contact solve: the gap that the wear of both surfaces opens.
//!
//! With e = p |sigma| and the specific wear rates k_s of the slave and k_m of the master, an increment of n cycles opens the
//! gaps
//!   F = W e,  W = n (diag k_s + Mhat diag k_m D^-1 M^T),
//! where the master's nodes take the path e and their recession is averaged back. The rates of a law that varies with the local
//! state are those at the coupled nodes on either side, so that its columns of S = Mhat D^-1 M^T are multiplied by k_m; those of
//! laws by dose, as that of a plating, belong to the nodes of their own surface, whose depths they depend on. Rates that vary add their derivatives:
//! dF/dp = W_p |sigma| and dF/d|sigma| = W_s p (`rates`). Laws of which a power of the depth adds open a gap of their own
//! (`power_opening`). Uniform rates are assembled once an increment.

mod power_opening;
mod rates;
mod transfer;

use super::band::Band;
use super::mortar::Coupling;
use super::pair::Pair;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::sides::{Side, Sides};
use power_opening::PowerOpening;
use rates::NodeRates;
use std::ops::Range;
use transfer::{assemble_transfer, transfer_path};

/// Gap opening of an increment, and its derivatives.
#[derive(Debug, Default)]
pub(in crate::contact) struct WearCoupling {
    wear: Sides<Option<SurfaceWear>>,
    cycles: f64,
    /// Depths of the slave's coupled nodes and of the master's nodes in the coupled range before the increment, mm.
    depth: Sides<Vec<f64>>,
    /// S; zero where the master does not wear.
    transfer: Band,
    /// The master's part of W where it wears by dose.
    by_dose: Band,
    /// Path at the coupled nodes, and at the master's nodes where it wears by dose, MPa mm.
    path: Vec<f64>,
    master_path: Vec<f64>,
    /// Rates that vary: at the coupled nodes, or at the master's where that wears by dose.
    rates: Sides<Vec<NodeRates>>,
    opening: Band,
    per_pressure: Band,
    per_slip: Band,
    /// The part of sides that wear by no path.
    by_power: PowerOpening,
}

impl WearCoupling {
    /// Assembles the matrices for the wear of both surfaces, worn to these depths at their contact nodes, and a number of cycles.
    /// Rates that vary are evaluated by [`Self::linearise`].
    pub(in crate::contact) fn assemble(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        wear: &Sides<Option<SurfaceWear>>,
        depth: Sides<&[f64]>,
        cycles: f64,
    ) {
        self.wear = *wear;
        self.cycles = cycles;
        self.transfer.reset(coupling.len(), 0);
        let (slave, master) = (pair.interface.slave, pair.interface.slave.other());
        if matches!(wear.of(master), Some(SurfaceWear::Law(_))) {
            let widths = &pair.master().widths;
            assemble_transfer(coupling, |shared, j| shared / widths[j], &mut self.transfer);
        }
        if self.varies() {
            let (begin, end) = coupling.master_range;
            let ranges = [(slave, coupling.first..coupling.end), (master, begin..end)];
            for (side, range) in ranges {
                let depths = self.depth.of_mut(side);
                depths.clear();
                depths.extend_from_slice(&depth.of(side)[range]);
            }
        } else {
            let rates = wear.map(|wear| uniform(wear) * cycles);
            let (own, far) = (*rates.of(slave), *rates.of(master));
            self.transfer.combine(|_| far, |_| own, &mut self.opening);
        }
    }

    fn wears_by_dose(&self, side: Side) -> bool {
        matches!(self.wear.of(side), Some(SurfaceWear::ByDose(_)))
    }

    /// Returns `true` if a rate depends on the local state or on the depth.
    pub(super) fn varies(&self) -> bool {
        let varies = |wear: Option<SurfaceWear>| wear.is_some_and(|wear| wear.uniform().is_none());
        varies(self.wear.slider) || varies(self.wear.receptacle)
    }

    /// Returns `true` if a side wears by no path.
    fn has_power(&self) -> bool {
        let has = |wear| matches!(wear, Some(SurfaceWear::ByPower { .. }));
        has(self.wear.slider) || has(self.wear.receptacle)
    }

    /// The opening that is no product with the path, if there is one.
    pub(super) fn other_opening(&self) -> Option<&PowerOpening> {
        self.has_power().then_some(&self.by_power)
    }

    /// Adds the gaps that a pressure at a node opens, over its slip.
    pub(in crate::contact) fn open_by_pressure(
        &self,
        span: &Range<usize>,
        node: usize,
        slip: f64,
        sum: &mut [f64],
    ) {
        self.per_pressure().add_column(span, node, slip, sum);
        if let Some(other) = self.other_opening() {
            other.per_pressure.add_column(span, node, 1.0, sum);
        }
    }

    /// Adds the gaps that the magnitude of a slip at a node opens, over its pressure.
    pub(in crate::contact) fn open_by_slip(
        &self,
        span: &Range<usize>,
        node: usize,
        pressure: f64,
        sum: &mut [f64],
    ) {
        self.per_slip().add_column(span, node, pressure, sum);
        if let Some(other) = self.other_opening() {
            other.per_slip.add_column(span, node, 1.0, sum);
        }
    }

    /// Linearises rates that vary about the pressures and slips of the coupled nodes.
    pub(in crate::contact) fn linearise(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        states: &(impl Iterator<Item = LocalState> + Clone),
    ) {
        if !self.varies() {
            return;
        }
        let (slave, master) = (pair.interface.slave, pair.interface.slave.other());
        self.path.clear();
        let paths = states.clone().map(|at| (at.pressure * at.slip).max(0.0));
        self.path.extend(paths);
        if self.wears_by_dose(master) {
            transfer_path(
                coupling,
                &pair.master().widths,
                &self.path,
                &mut self.master_path,
            );
        }
        for side in Side::BOTH {
            let rates = self.rates.of_mut(side);
            rates.clear();
            match *self.wear.of(side) {
                None | Some(SurfaceWear::ByPower { .. }) => {
                    rates.resize(coupling.len(), NodeRates::default());
                }
                Some(SurfaceWear::Law(law)) => {
                    rates.extend(states.clone().map(|at| NodeRates::of_law(law, at)));
                }
                Some(SurfaceWear::ByDose(curve)) => {
                    let path = if side == slave {
                        &self.path
                    } else {
                        &self.master_path
                    };
                    let nodes = self.depth.of(side).iter().zip(path);
                    rates.extend(
                        nodes.map(|(depth, e)| NodeRates::by_dose(&curve, *depth, self.cycles * e)),
                    );
                }
            }
        }
        if self.has_power() {
            let (wear, depth) = (&self.wear, &self.depth);
            self.by_power
                .linearise(coupling, pair, wear, depth, self.cycles, states);
        }
        self.combine(
            coupling,
            pair,
            |rates| rates.value,
            |wear| &mut wear.opening,
        );
        self.combine(
            coupling,
            pair,
            |rates| rates.per_pressure,
            |wear| &mut wear.per_pressure,
        );
        self.combine(
            coupling,
            pair,
            |rates| rates.per_slip,
            |wear| &mut wear.per_slip,
        );
    }

    /// Assembles the matrix of one kind of rates.
    fn combine(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        kind: fn(&NodeRates) -> f64,
        combined: fn(&mut Self) -> &mut Band,
    ) {
        let slave = pair.interface.slave;
        let mut matrix = std::mem::take(combined(self));
        let (own, far) = (self.rates.of(slave), self.rates.of(slave.other()));
        let (cycles, diagonal) = (self.cycles, |l: usize| self.cycles * kind(&own[l]));
        if self.wears_by_dose(slave.other()) {
            let widths = &pair.master().widths;
            let begin = coupling.master_range.0;
            let worn = |shared: f64, j: usize| shared * kind(&far[j - begin]) / widths[j];
            assemble_transfer(coupling, worn, &mut self.by_dose);
            self.by_dose.combine(|_| cycles, diagonal, &mut matrix);
        } else {
            let factor = |l: usize| cycles * kind(&far[l]);
            self.transfer.combine(factor, diagonal, &mut matrix);
        }
        *combined(self) = matrix;
    }

    /// Nodes to either side at which a pressure opens gaps.
    pub(super) fn reach(&self) -> usize {
        let other = self.other_opening();
        let other = other.map_or(0, |other| other.per_pressure.bandwidth());
        self.per_pressure().bandwidth().max(other)
    }

    /// W: gap opened per path p |sigma|, 1/MPa.
    pub(in crate::contact) fn opening(&self) -> &Band {
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
    /// coupled range; returns the worn areas as the integrals of the rates over the nodes that they belong to, mm^2.
    pub(in crate::contact) fn recession(
        &self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        path: &[f64],
        recession: &mut Sides<Vec<f64>>,
    ) -> Sides<f64> {
        Sides::from_fn(|side| {
            let recession = recession.of_mut(side);
            recession.clear();
            match *self.wear.of(side) {
                None => 0.0,
                Some(SurfaceWear::ByPower { .. }) => {
                    recession.extend_from_slice(self.by_power.recession.of(side));
                    let widths = if side == pair.interface.slave {
                        &pair.slave().widths[coupling.first..]
                    } else {
                        &pair.master().widths[coupling.master_range.0..]
                    };
                    let nodes = recession.iter().zip(widths);
                    nodes.map(|(worn, width)| width * worn).sum()
                }
                Some(SurfaceWear::Law(_)) => {
                    self.recession_by_law(coupling, pair, side, path, recession)
                }
                Some(SurfaceWear::ByDose(curve)) => {
                    let widths = if side == pair.interface.slave {
                        recession.extend_from_slice(path);
                        &pair.slave().widths[coupling.first..]
                    } else {
                        transfer_path(coupling, &pair.master().widths, path, recession);
                        &pair.master().widths[coupling.master_range.0..]
                    };
                    let nodes = recession.iter_mut().zip(self.depth.of(side)).zip(widths);
                    nodes.fold(0.0, |area, ((depth, before), width)| {
                        *depth = curve.recession(*before, self.cycles * *depth).0;
                        area + width * *depth
                    })
                }
            }
        })
    }

    /// Recession of a side that wears by one law; returns its worn area.
    fn recession_by_law(
        &self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        side: Side,
        path: &[f64],
        recession: &mut Vec<f64>,
    ) -> f64 {
        // A uniform rate is a factor of the transferred path.
        let uniform = self.wear.of(side).and_then(SurfaceWear::uniform);
        let factor = uniform.unwrap_or(1.0) * self.cycles;
        if uniform.is_some() {
            recession.extend_from_slice(path);
        } else {
            let nodes = path.iter().zip(self.rates.of(side));
            recession.extend(nodes.map(|(e, rates)| rates.value * e));
        }
        let widths = &pair.slave().widths[coupling.first..];
        let area = widths.iter().zip(&recession[..]);
        let area = factor * area.map(|(width, e)| width * e).sum::<f64>();
        if side != pair.interface.slave {
            let shares = std::mem::take(recession);
            transfer_path(coupling, &pair.master().widths, &shares, recession);
        }
        for depth in recession.iter_mut() {
            *depth *= factor;
        }
        area
    }
}

/// The specific wear rate of a surface on which it is uniform, 1/MPa.
fn uniform(wear: Option<SurfaceWear>) -> f64 {
    wear.and_then(SurfaceWear::uniform).unwrap_or(0.0)
}
