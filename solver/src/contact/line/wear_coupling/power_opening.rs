//! Gap that is opened by sides of which a power of the depth adds: their wear is no product with the path p |sigma|.
//!
//! With the increase dy of y = h^(1/c) at the coupled nodes, which the master's nodes take over as they take over a path, an increment of
//! n cycles recedes a node by r(h, n dy), so that
//!   F = r_s + Mhat r_m,  dF/dp = r_s' n dy_p + Mhat diag(r_m') D^-1 M^T n dy_p,
//! and dF/d|sigma| likewise, where r' is the derivative of r by its increase.

use super::super::band::Band;
use super::super::mortar::Coupling;
use super::super::pair::Pair;
use super::transfer::{assemble_transfer, transfer_path};
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::sides::{Side, Sides};

/// The opening of an increment, and its derivatives.
#[derive(Debug, Default)]
pub(in super::super) struct PowerOpening {
    /// Gaps of the coupled nodes, mm.
    pub(in super::super) opened: Vec<f64>,
    /// Derivatives by the pressures, mm/MPa, and by the magnitudes of the slips, -.
    pub(in super::super) per_pressure: Band,
    pub(in super::super) per_slip: Band,
    /// Recession of the nodes of both sides in the coupled range, mm.
    pub(super) recession: Sides<Vec<f64>>,
    /// n dy at the coupled nodes, and its derivatives by pressure and slip.
    increase: Sides<[Vec<f64>; 3]>,
    /// Increase at the nodes of a side, and the depth per increase there.
    own: Vec<f64>,
    ends: Sides<Vec<f64>>,
    transfer: Band,
}

/// Surface of one side before the increment.
#[derive(Clone, Copy)]
struct Surface<'a> {
    side: Side,
    wear: Option<SurfaceWear>,
    /// Depth of the nodes in the coupled range, mm.
    depth: &'a [f64],
}

impl PowerOpening {
    /// Linearises the opening about the pressures and slips of the coupled nodes; `depth` before the increment of both sides.
    pub(super) fn linearise(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        wear: &Sides<Option<SurfaceWear>>,
        depth: &Sides<Vec<f64>>,
        cycles: f64,
        states: &(impl Iterator<Item = LocalState> + Clone),
    ) {
        self.opened.clear();
        self.opened.resize(coupling.len(), 0.0);
        self.transfer.reset(coupling.len(), 0);
        for side in Side::BOTH {
            let surface = Surface {
                side,
                wear: *wear.of(side),
                depth: depth.of(side),
            };
            self.recede(coupling, pair, surface, cycles, states);
        }
        let slave = pair.interface.slave;
        let (own, far) = (self.increase.of(slave), self.increase.of(slave.other()));
        let ends = self.ends.of(slave);
        for (kind, matrix) in [(1, &mut self.per_pressure), (2, &mut self.per_slip)] {
            self.transfer
                .combine(|l| far[kind][l], |l| ends[l] * own[kind][l], matrix);
        }
    }

    /// Recedes one side, and adds the gap that this opens.
    fn recede(
        &mut self,
        coupling: &Coupling,
        pair: &Pair<'_>,
        surface: Surface<'_>,
        cycles: f64,
        states: &(impl Iterator<Item = LocalState> + Clone),
    ) {
        let Surface { side, wear, depth } = surface;
        let (recession, ends) = (self.recession.of_mut(side), self.ends.of_mut(side));
        let increase = self.increase.of_mut(side);
        recession.clear();
        ends.clear();
        for values in increase.iter_mut() {
            values.clear();
        }
        let Some(SurfaceWear::ByPower { law, during }) = wear else {
            ends.resize(coupling.len(), 0.0);
            for values in increase {
                values.resize(coupling.len(), 0.0);
            }
            return;
        };
        for at in states.clone() {
            let of_node = during.increase(at.pressure, at.slip);
            for (values, value) in increase.iter_mut().zip(of_node) {
                values.push(cycles * value);
            }
        }
        let is_slave = side == pair.interface.slave;
        if is_slave {
            self.own.clone_from(&increase[0]);
        } else {
            let widths = &pair.master().widths;
            transfer_path(coupling, widths, &increase[0], &mut self.own);
        }
        for (depth, increase) in depth.iter().zip(&self.own) {
            let (worn, end) = law.recession(*depth, *increase);
            recession.push(worn);
            ends.push(end);
        }
        if is_slave {
            for (opened, worn) in self.opened.iter_mut().zip(&*recession) {
                *opened += worn;
            }
            return;
        }
        let begin = coupling.master_range.0;
        for (i, opened) in self.opened.iter_mut().enumerate() {
            let (from, averages) = coupling.dual_row(coupling.first + i);
            let worn = recession[from - begin..].iter().zip(averages);
            *opened += worn.map(|(worn, average)| worn * average).sum::<f64>();
        }
        let widths = &pair.master().widths;
        let receding = |shared: f64, j: usize| shared * ends[j - begin] / widths[j];
        assemble_transfer(coupling, receding, &mut self.transfer);
    }
}
