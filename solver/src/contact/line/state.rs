//! Contact state: position of the bodies and the tractions between them.

use serde::{Deserialize, Serialize};

use super::status::Status;
use crate::condensation::Operators;
use crate::model::{Interface, Tangential};
use crate::sides::{Side, Sides};
use std::ops::Range;

/// Position of the bodies and the tractions between them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x: f64,
    /// Displacement at which the surfaces are paired: without the part that is elastic deformation, mm.
    pub pairing_x: f64,
    /// Rigid height of the slider over its place at first touch of the unworn bodies, mm.
    pub height: f64,
    /// Status of each node of the slave.
    pub status: Vec<Status>,
    /// Pressure p at each node of the slave, MPa.
    pub pressure: Vec<f64>,
    /// Shear traction q on the receptacle at each node of the slave, MPa.
    pub shear: Vec<f64>,
    /// Forces that act on the slider (x, y), at the nodes of each side, N/mm; the receptacle carries the reaction.
    pub force: Sides<Vec<f64>>,
    /// Nodes of the slave from the first one in contact to the last.
    active: Range<usize>,
    /// Nodes of each side from the first loaded one to the last.
    loaded: Sides<Range<usize>>,
    /// Largest indentation of the last increment, mm: the scale of gaps.
    pub indentation: f64,
    /// Height of the loaded, unworn contact, the reference of a spring in the load; `None` before the first load.
    pub reference_height: Option<f64>,
    /// Mean coefficient of friction over the contact, weighted by its pressure, -: the limit of Q/P in gross slip.
    pub friction: f64,
}

impl ContactState {
    /// Bodies that touch without load at the neutral position.
    pub fn untouched(operators: &Operators, slave: Side) -> Self {
        let n = operators.of(slave).x.len();
        Self {
            slider_x: 0.0,
            pairing_x: 0.0,
            height: 0.0,
            status: vec![Status::Open; n],
            pressure: vec![0.0; n],
            shear: vec![0.0; n],
            force: operators.as_ref().map(|body| vec![0.0; 2 * body.x.len()]),
            active: 0..0,
            loaded: Sides::default(),
            indentation: 0.0,
            reference_height: None,
            friction: 0.0,
        }
    }

    /// Resets to an open contact with the slider at a displacement, paired at another one.
    pub(in crate::contact) fn reset_open(&mut self, last: &Self, slider_x: f64, pairing_x: f64) {
        self.slider_x = slider_x;
        self.pairing_x = pairing_x;
        self.height = last.height;
        self.indentation = last.indentation;
        self.reference_height = last.reference_height;
        self.friction = last.friction;
        // Open nodes have no tractions.
        let active = std::mem::take(&mut self.active);
        self.status[active.clone()].fill(Status::Open);
        for values in [&mut self.pressure, &mut self.shear] {
            values[active.clone()].fill(0.0);
        }
        for side in Side::BOTH {
            let loaded = std::mem::take(self.loaded.of_mut(side));
            self.force.of_mut(side)[2 * loaded.start..2 * loaded.end].fill(0.0);
        }
    }

    /// Writes the statuses of nodes from `first` on; all others are open.
    pub(crate) fn set_statuses(&mut self, first: usize, status: &[Status]) {
        self.status[first..first + status.len()].copy_from_slice(status);
        let is_closed = |status: &Status| *status != Status::Open;
        let begin = status.iter().position(is_closed);
        let last = status.iter().rposition(is_closed);
        self.active = begin
            .zip(last)
            .map_or(0..0, |(begin, last)| first + begin..first + last + 1);
    }

    /// Determines which of these nodes of a side are loaded; no others are.
    pub(in crate::contact) fn set_loaded(&mut self, side: Side, nodes: Range<usize>) {
        let (forces, _) = self.force.of(side)[2 * nodes.start..2 * nodes.end].as_chunks::<2>();
        let mut forces = forces.iter();
        let is_loaded = |f: &[f64; 2]| f[0] != 0.0 || f[1] != 0.0;
        let first = forces.clone().position(is_loaded);
        let last = forces.rposition(is_loaded);
        *self.loaded.of_mut(side) = first.zip(last).map_or(0..0, |(first, last)| {
            nodes.start + first..nodes.start + last + 1
        });
    }

    /// First node in contact and one past the last.
    pub(crate) fn active_range(&self) -> Option<(usize, usize)> {
        (!self.active.is_empty()).then_some((self.active.start, self.active.end))
    }

    /// Contact nodes of a side between the first loaded one and the last.
    pub fn loaded(&self, side: Side) -> Range<usize> {
        self.loaded.of(side).clone()
    }

    /// Force of the slider on the receptacle along x, N/mm; with that of the shear which acts on neither body. Widths of the
    /// slave's nodes in mm.
    pub(crate) fn tangential_force(&self, interface: &Interface, widths: &[f64]) -> f64 {
        let loaded = self.loaded(Side::Receptacle);
        let forces = &self.force.receptacle[2 * loaded.start..2 * loaded.end];
        let acting = -forces.iter().step_by(2).sum::<f64>();
        if interface.tangential != Tangential::Omitted {
            return acting;
        }
        let active = self.active.clone();
        let widths = &widths[active.clone()];
        let shears = self.shear[active].iter().zip(widths);
        acting + shears.map(|(q, width)| q * width).sum::<f64>()
    }

    /// |sum of shear forces| over the largest that friction allows, the mean coefficient times the sum of normal ones, in the frame
    /// of the surface; at most 1.
    pub fn friction_use(&self, widths: &[f64]) -> f64 {
        let (mut normal, mut shear) = (0.0, 0.0);
        let (first, end) = self.active_range().unwrap_or_default();
        for ((width, p), q) in widths[first..end]
            .iter()
            .zip(&self.pressure[first..end])
            .zip(&self.shear[first..end])
        {
            normal += width * p;
            shear += width * q;
        }
        if normal > 0.0 && self.friction > 0.0 {
            shear.abs() / normal / self.friction
        } else {
            0.0
        }
    }

    /// Normal load at the present height, reduced by the spring, N/mm; not negative, since round-off below zero is no
    /// load.
    pub fn load(&self, interface: &Interface) -> f64 {
        self.equilibrium_load(interface).max(0.0)
    }

    /// The load of the vertical balance, which round-off may make negative.
    pub(super) fn equilibrium_load(&self, interface: &Interface) -> f64 {
        interface.load
            + self
                .reference_height
                .map_or(0.0, |h| interface.spring * (self.height - h))
    }

    /// Highest pressure, MPa.
    pub fn peak_pressure(&self) -> f64 {
        let (first, end) = self.active_range().unwrap_or_default();
        let pressures = self.pressure[first..end].iter();
        pressures.fold(0.0, |m: f64, p| m.max(*p))
    }

    /// Half the distance between the edges of the contact, mm.
    ///
    /// An edge lies between the last loaded node and the next one, where the parabola through the squares of the
    /// last two pressures vanishes: exact for Hertz, where p^2 falls linearly at the edge.
    pub fn half_width(&self, x: &[f64]) -> f64 {
        let Some((first, end)) = self.active_range() else {
            return 0.0;
        };
        let last = end - 1;
        if first == last {
            return 0.25 * (x[(last + 1).min(x.len() - 1)] - x[last.saturating_sub(1)]);
        }
        let (left, right) = self.edges(x, first, last);
        0.5 * (right - left)
    }

    /// Middle between the edges of the contact, mm; 0 of an open one.
    pub fn middle(&self, x: &[f64]) -> f64 {
        let Some((first, end)) = self.active_range() else {
            return 0.0;
        };
        let last = end - 1;
        if first == last {
            return x[last];
        }
        let (left, right) = self.edges(x, first, last);
        0.5 * (left + right)
    }

    /// The edges of a contact from one loaded node to another, mm.
    fn edges(&self, x: &[f64], first: usize, last: usize) -> (f64, f64) {
        let edge = |last: usize, inner: usize, outer: usize| -> f64 {
            let (p, q) = (self.pressure[last].powi(2), self.pressure[inner].powi(2));
            let step = x[last] - x[inner];
            let fall = q - p;
            let beyond = if fall > 0.0 {
                p / fall * step.abs()
            } else {
                f64::INFINITY
            };
            x[last] + step.signum() * beyond.min((x[outer] - x[last]).abs())
        };
        let right = edge(last, last - 1, (last + 1).min(x.len() - 1));
        let left = edge(first, first + 1, first.saturating_sub(1));
        (left, right)
    }
}
