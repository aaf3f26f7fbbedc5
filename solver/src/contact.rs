//! Large-sliding frictional contact between two condensed bodies, with wear inside the solve.
//!
//! Both surfaces are graphs over x. On the receptacle's surface (the slave side) with slope s the vectors
//! N = (-s, 1) and T = (1, s) stand for normal and tangent of an element of *projected* length dx, so that
//! integrals over the surface are integrals over x and nodal widths never change:
//!
//! * traction on the slider per dx: p N - q T, with the true pressure p and the true shear q on the receptacle;
//! * vertical gap g and tangential slip sigma = T . (relative displacement since the last increment);
//! * Archard per dx: vertical recession = k p |sigma|, energy = |q sigma|.
//!
//! A jump u of the surfaces changes the gap at a point of the receptacle by (-s', 1) . u with the slope s' of the
//! *slider*, whose arc the jump shifts along: a contact that sticks stays where it is on the receptacle although the
//! imposed displacement has moved on.
//!
//! The dual mortar couples nodal averages: jump_i = sum_j Mhat_ij u_j(slider) - u_i(receptacle), and the response
//! to nodal forces F is jump = (Mhat C_s Mhat^T + C_r) F with the condensed compliances. Contact knows operators,
//! not meshes.

mod guess;
mod increment;
mod mortar;
mod newton;
mod pivoting;
mod range;
mod recession;
mod response;
mod status;

use serde::{Deserialize, Serialize};

use crate::condensation::{BodyOperators, Operators};
use crate::model::Interface;

pub use increment::{Increment, Solver};
pub(crate) use range::WATCHED;
pub use status::Status;

/// Most primal-dual iterations of one increment before it is halved, or pivoted.
pub const MOST_ITERATIONS: usize = 60;

/// Gap residual, over the largest indentation, that ends the iteration. Newton's last step squares an error of the
/// order 1e-6, so this is met by round-off or not at all.
pub const GAP_TOLERANCE: f64 = 1e-11;

/// Why an increment could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The active set did not settle.
    #[error(
        "no contact state after {iterations} iterations at x = {slider_x_mm:.6} mm: relative gap residual {residual:.1e} (tolerance {tolerance:.1e}), {changes} nodes still changing"
    )]
    NotConverged {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Iterations that were made.
        iterations: usize,
        /// Gap residual over its scale.
        residual: f64,
        /// Its tolerance.
        tolerance: f64,
        /// Nodes whose status changed in the last iteration.
        changes: usize,
    },
    /// The linear system has no finite solution: sliding up a wall that is too steep, or no load at all.
    #[error("no equilibrium at x = {slider_x_mm:.6} mm with {active} nodes in contact")]
    NoEquilibrium {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Nodes in contact.
        active: usize,
    },
    /// The active set did not settle where friction holds the slider against a wall.
    #[error(
        "jammed at x = {slider_x_mm:.6} mm: the load stands on a slope of {slope:.2}, and friction lets nothing climb beyond {limit:.2}"
    )]
    Jammed {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Slope that the load stands on, in the mean.
        slope: f64,
        /// 1 / mu: beyond it only wear or yielding lets a contact climb.
        limit: f64,
    },
    /// More wears off at once than implicit wear can follow.
    #[error(
        "the step to x = {slider_x_mm:.6} mm wears off {share:.2} of what is left of a body (at most {limit})"
    )]
    TooMuchWear {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Wear of the step over what is left of the body there.
        share: f64,
        /// Its limit.
        limit: f64,
    },
}

/// The interface between two bodies: operators and laws.
#[derive(Debug, Clone, Copy)]
pub struct Pair<'a> {
    /// Condensed bodies.
    pub operators: &'a Operators,
    /// Friction, wear, load.
    pub interface: Interface,
}

/// Where an increment goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Imposed displacement of the slider at its end, mm.
    pub slider_x: f64,
    /// How far the slider's surface runs past besides, without moving the contact, mm.
    pub run: f64,
    /// How many equal slips each slip stands for in the wear.
    pub cycles: f64,
    /// Whether to pivot where Newton's method does not settle: sure, but by far dearer than two halves of the move.
    pub pivots: bool,
}

/// Worn surfaces, at the contact nodes.
#[derive(Debug, Clone, Copy)]
pub struct Surfaces<'a> {
    /// Vertical worn depth of the receptacle, mm.
    pub receptacle_depth: &'a [f64],
    /// Vertical worn depth of the slider, mm.
    pub slider_depth: &'a [f64],
    /// Slope dy/dx of the receptacle's surface that normals are taken from.
    pub slope: &'a [f64],
    /// Slope dy/dx of the slider's surface at its contact nodes.
    pub slider_slope: &'a [f64],
}

/// Slopes dy/dx of a body's contact surface that has receded by `depth` (`outward` is -1 below, +1 above the contact):
/// of the unworn shape exactly, of the depth by central differences.
pub fn slopes(body: &BodyOperators, depth: &[f64], outward: f64) -> Vec<f64> {
    let x = &body.x;
    (0..x.len())
        .map(|i| {
            let (left, right) = (i.saturating_sub(1), (i + 1).min(x.len() - 1));
            let worn = (depth[right] - depth[left]) / (x[right] - x[left]);
            body.profile.slope(x[i]) + outward * worn
        })
        .collect()
}

/// Where the bodies are and what they transmit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x: f64,
    /// Rigid height of the slider over its place at first touch of the unworn bodies, mm.
    pub height: f64,
    /// What each node of the receptacle does.
    pub status: Vec<Status>,
    /// Pressure p at each node of the receptacle, MPa.
    pub pressure: Vec<f64>,
    /// Shear traction q on the receptacle, MPa.
    pub shear: Vec<f64>,
    /// Forces on the receptacle's nodes as they act on the slider (x, y), N/mm.
    pub receptacle_force: Vec<f64>,
    /// Forces on the slider's nodes (x, y), N/mm.
    pub slider_force: Vec<f64>,
    /// Largest indentation of the last increment, mm: the scale of gaps.
    pub indentation: f64,
    /// Height of the loaded, unworn contact, from which a spring in the load counts; `None` before the first load.
    pub reference_height: Option<f64>,
}

impl ContactState {
    /// Bodies that just touch, unloaded, at the neutral position.
    pub fn untouched(operators: &Operators) -> Self {
        let (n, m) = (operators.receptacle.x.len(), operators.slider.x.len());
        Self {
            slider_x: 0.0,
            height: 0.0,
            status: vec![Status::Open; n],
            pressure: vec![0.0; n],
            shear: vec![0.0; n],
            receptacle_force: vec![0.0; 2 * n],
            slider_force: vec![0.0; 2 * m],
            indentation: 0.0,
            reference_height: None,
        }
    }

    /// Takes on the place of the slider, and no contact.
    fn lift(&mut self, last: &Self, slider_x: f64) {
        self.slider_x = slider_x;
        self.height = last.height;
        self.indentation = last.indentation;
        self.reference_height = last.reference_height;
        self.status.fill(Status::Open);
        for values in [
            &mut self.pressure,
            &mut self.shear,
            &mut self.receptacle_force,
            &mut self.slider_force,
        ] {
            values.fill(0.0);
        }
    }

    /// First node in contact and one past the last.
    pub fn active_range(&self) -> Option<(usize, usize)> {
        let first = self.status.iter().position(|s| *s != Status::Open)?;
        let last = self.status.iter().rposition(|s| *s != Status::Open)?;
        Some((first, last + 1))
    }

    /// Force of the slider on the receptacle along x, N/mm.
    pub fn tangential_force(&self) -> f64 {
        -self.receptacle_force.iter().step_by(2).sum::<f64>()
    }

    /// |sum of shear forces| over the sum of normal ones, in the frame of the surface; at most mu.
    pub fn friction_use(&self, widths: &[f64]) -> f64 {
        let (mut normal, mut shear) = (0.0, 0.0);
        for (width, (p, q)) in widths.iter().zip(self.pressure.iter().zip(&self.shear)) {
            normal += width * p;
            shear += width * q;
        }
        if normal > 0.0 {
            shear.abs() / normal
        } else {
            0.0
        }
    }

    /// Normal load that the spring leaves at the present height, N/mm; without a contact it would hold up nothing, so
    /// that round-off below zero is none.
    pub fn load(&self, interface: &Interface) -> f64 {
        self.equilibrium_load(interface).max(0.0)
    }

    /// The same, as it stands in the equation of vertical balance.
    fn equilibrium_load(&self, interface: &Interface) -> f64 {
        interface.load
            + self
                .reference_height
                .map_or(0.0, |h| interface.spring * (self.height - h))
    }

    /// Highest pressure, MPa.
    pub fn peak_pressure(&self) -> f64 {
        self.pressure.iter().fold(0.0, |m: f64, p| m.max(*p))
    }

    /// Half the distance between the edges of the contact, mm.
    ///
    /// An edge lies between the last loaded node and the next one, where the parabola through the squares of the
    /// last two pressures vanishes: exact for Hertz, where p^2 falls linearly at the edge.
    pub fn half_width(&self, x: &[f64]) -> f64 {
        let Some((first, end)) = self.active_range() else {
            return 0.0;
        };
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
        let last = end - 1;
        if first == last {
            return 0.25 * (x[(last + 1).min(x.len() - 1)] - x[last.saturating_sub(1)]);
        }
        let right = edge(last, last - 1, (last + 1).min(x.len() - 1));
        let left = edge(first, first + 1, first.saturating_sub(1));
        0.5 * (right - left)
    }
}
