//! One increment as a nonlinear problem, and an iterate of its solution.

use super::friction::Coefficient;
use super::mortar::Coupling;
use super::pair::{Pair, Zones};
use super::status::Status;
use crate::law::wear::LocalState;

/// Most Newton iterations of one increment before it is halved, or solved as a complementarity problem.
pub(crate) const MOST_ITERATIONS: usize = 60;

/// Gap residual over the largest indentation at which the iteration has converged. The last Newton step squares an
/// error of the order 1e-6, so this is reached by round-off or not at all.
pub(crate) const GAP_TOLERANCE: f64 = 1e-11;

/// Data of one increment over the coupled nodes.
pub(super) struct Problem<'a> {
    pub(super) pair: &'a Pair<'a>,
    pub(super) zones: Zones<'a>,
    pub(super) coupling: &'a Coupling,
    /// Gap of the worn, undeformed bodies at height 0, mm.
    pub(super) gap: &'a [f64],
    /// Projected widths of the coupled nodes, mm.
    pub(super) width: &'a [f64],
    /// Slopes of the interface and of the master's surface.
    pub(super) slope: &'a [f64],
    pub(super) master_slope: &'a [f64],
    /// Coefficient of the friction that acts on the bodies, -.
    pub(super) friction: Coefficient<'a>,
    /// True if each node sticks or slips by the deformation; each slips as imposed otherwise.
    pub(super) tracks_slip: bool,
    /// Vertical load at height 0, N/mm, and its increase per mm of height.
    pub(super) load: f64,
    pub(super) spring: f64,
    /// Gap that the slider opens by deforming under its far-face load as the height grows, mm per mm.
    pub(super) sag: &'a [f64],
    /// Slip of each node before the new forces and the new height are known, mm.
    pub(super) fixed_slip: &'a [f64],
    /// True if anything wears in this increment.
    pub(super) wears: bool,
    /// Displacement of the contact over the slave in this increment, mm.
    pub(super) travel: f64,
    /// True if nothing was loaded before.
    pub(super) first_load: bool,
    /// Imposed slip: the displacement and the additional slip of the slider's surface, mm.
    pub(super) step: f64,
    /// Imposed slip along the line over each node, per projected length, mm; none at all if absent.
    pub(super) along: &'a [f64],
    /// The height of the slider if it is given, mm: `spring` times it less the height is then the vertical residual.
    pub(super) height: Option<f64>,
}

impl Problem<'_> {
    /// Weight of the vertical forces in the equation for the height, which does not depend on them where it is given.
    pub(super) fn force_weight(&self) -> f64 {
        if self.height.is_some() { 0.0 } else { 1.0 }
    }

    /// Magnitude of the imposed slip at a node, mm.
    pub(super) fn imposed_slip(&self, node: usize) -> f64 {
        let along = self.along.get(node).copied().unwrap_or(0.0);
        magnitude(self.step.abs(), along)
    }
}

/// Mean slope under pressures of nodes of these widths and slopes.
pub(super) fn mean_slope(pressures: &[f64], widths: &[f64], slopes: &[f64]) -> f64 {
    let (mut load, mut moment) = (0.0, 0.0);
    for ((p, width), slope) in pressures.iter().zip(widths).zip(slopes) {
        load += width * p;
        moment += width * p * slope;
    }
    if load > 0.0 { moment / load } else { 0.0 }
}

/// Iterate of the Newton method over the coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Iterate {
    pub(super) status: Vec<Status>,
    pub(super) pressure: Vec<f64>,
    pub(super) shear: Vec<f64>,
    /// Tangential slip in this increment, mm.
    pub(super) slip: Vec<f64>,
    /// p |sigma| of this increment, MPa mm.
    pub(super) path: Vec<f64>,
    /// Gap with deformation and wear, mm.
    pub(super) gap: Vec<f64>,
    pub(super) height: f64,
    pub(super) indentation: f64,
    /// Gap residual over the indentation at which the iteration has converged.
    pub(super) tolerance: f64,
    /// Imposed slip along the line over each node, per projected length, mm.
    pub(super) along: Vec<f64>,
}

impl Iterate {
    /// Sets the shears that follow from the pressures of slipping nodes under a coefficient of friction.
    pub(super) fn apply_friction(&mut self, coefficient: Coefficient<'_>) {
        let nodes = self.shear.iter_mut().zip(&self.pressure).zip(&self.status);
        for (node, ((shear, pressure), status)) in nodes.enumerate() {
            *shear = status.direction() * coefficient.at(node) * pressure;
        }
    }

    /// Pressure and slip of a node in a status as a wear law takes them.
    pub(super) fn local_state(&self, node: usize, status: Status) -> LocalState {
        LocalState {
            pressure: self.pressure[node],
            slip: match status {
                Status::Open | Status::Stick => 0.0,
                Status::SlipRight | Status::SlipLeft => {
                    magnitude(self.slip_across(node, status), self.along[node])
                }
            },
            ..LocalState::default()
        }
    }

    /// Change of the magnitude of a node's slip in a status per slip across the line.
    pub(super) fn slip_direction(&self, node: usize, status: Status) -> f64 {
        let (direction, along) = (status.direction(), self.along[node]);
        if along == 0.0 {
            return direction;
        }
        let across = self.slip_across(node, status);
        direction * across / magnitude(across, along)
    }

    /// Slip of a node across the line in the direction of a status, mm: none against it, unless it slips along the line anyway.
    fn slip_across(&self, node: usize, status: Status) -> f64 {
        let across = status.direction() * self.slip[node];
        if self.along[node] == 0.0 {
            across.max(0.0)
        } else {
            across
        }
    }
}

/// Magnitude of a slip by its components across the line and along it.
fn magnitude(across: f64, along: f64) -> f64 {
    if along == 0.0 {
        across
    } else {
        (across * across + along * along).sqrt()
    }
}
