//! Plane contact along a line: large sliding with friction between two condensed bodies, wear inside the solve.
//!
//! Both surfaces are graphs over x. On the receptacle's surface (the slave side) with slope s the vectors
//! N = (-s, 1) and T = (1, s) are normal and tangent of an element of *projected* length dx, so that
//! integrals over the surface are integrals over x and nodal widths never change:
//!
//! * traction on the slider per dx: p N - q T, with the true pressure p and the true shear q on the receptacle;
//! * vertical gap g and tangential slip sigma = T . (relative displacement since the last increment);
//! * Archard per dx: vertical recession = k p |sigma|, energy = |q sigma|.
//!
//! A jump u of the surfaces changes the gap at a point of the receptacle by (-s', 1) . u with the slope s' of the
//! *slider*, whose arc is shifted by the jump: a sticking contact stays at its position on the receptacle although the
//! imposed displacement has increased.
//!
//! The dual mortar method couples nodal averages: jump_i = sum_j Mhat_ij u_j(slider) - u_i(receptacle), and the response
//! to nodal forces F is jump = (Mhat C_s Mhat^T + C_r) F with the condensed compliances.

mod active_window;
mod complementarity;
mod increment;
mod mortar;
mod newton;
mod predictor;
mod problem;
mod response;
mod status;
mod wear_coupling;

use serde::{Deserialize, Serialize};

use crate::condensation::{BodyOperators, Operators};
use crate::model::Interface;
use crate::sides::{Side, Sides};

pub(crate) use active_window::CANDIDATE_GAP;
pub use increment::{Increment, Solver};
pub use status::Status;

/// Most Newton iterations of one increment before it is halved, or solved as a complementarity problem.
pub const MOST_ITERATIONS: usize = 60;

/// Gap residual over the largest indentation at which the iteration has converged. The last Newton step squares an error
/// of the order 1e-6, so this is reached by round-off or not at all.
pub const GAP_TOLERANCE: f64 = 1e-11;

/// Why an increment could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The active set did not converge.
    #[error(
        "no contact state after {iterations} iterations at x = {slider_x_mm:.6} mm: relative gap residual {residual:.1e} (tolerance {tolerance:.1e}), {changes} nodes still changing"
    )]
    NotConverged {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Iterations done.
        iterations: usize,
        /// Relative gap residual.
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
    /// The active set did not converge where friction holds the slider against a wall.
    #[error(
        "jammed at x = {slider_x_mm:.6} mm: the load stands on a slope of {slope:.2}, and friction lets nothing climb beyond {limit:.2}"
    )]
    Jammed {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Mean slope under the load.
        slope: f64,
        /// 1 / mu: beyond it only wear or yielding lets a contact climb.
        limit: f64,
    },
    /// An increment removes more than implicit wear can integrate.
    #[error(
        "the step to x = {slider_x_mm:.6} mm wears off {share:.2} of what is left of a body (at most {limit})"
    )]
    TooMuchWear {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Wear of the increment over the remaining height there.
        share: f64,
        /// Largest accepted value.
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

/// Imposed displacement of one increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement {
    /// Displacement of the slider at the end of the increment, mm.
    pub slider_x: f64,
    /// Additional slip of the slider's surface that does not move the contact, mm.
    pub surface_slip: f64,
    /// Number of equal slips that each slip represents in the wear.
    pub cycles: f64,
    /// Whether Lemke's method is tried where Newton's method does not converge: reliable, but far more expensive than
    /// two half increments.
    pub lemke: bool,
}

/// Worn surfaces, at the contact nodes.
#[derive(Debug, Clone, Copy)]
pub struct Surfaces<'a> {
    /// Vertical worn depth, mm.
    pub depth: Sides<&'a [f64]>,
    /// Slope dy/dx; normals are those of the receptacle's surface.
    pub slope: Sides<&'a [f64]>,
}

/// Slopes dy/dx of a body's contact surface that has receded by `depth`: of the unworn shape exactly, of the depth by
/// central differences.
pub fn slopes(body: &BodyOperators, depth: &[f64], side: Side) -> Vec<f64> {
    let x = &body.x;
    (0..x.len())
        .map(|i| {
            let (left, right) = (i.saturating_sub(1), (i + 1).min(x.len() - 1));
            let worn = (depth[right] - depth[left]) / (x[right] - x[left]);
            body.profile.slope(x[i]) + side.recession() * worn
        })
        .collect()
}

/// Position of the bodies and the tractions between them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x: f64,
    /// Rigid height of the slider over its place at first touch of the unworn bodies, mm.
    pub height: f64,
    /// Status of each node of the receptacle.
    pub status: Vec<Status>,
    /// Pressure p at each node of the receptacle, MPa.
    pub pressure: Vec<f64>,
    /// Shear traction q on the receptacle, MPa.
    pub shear: Vec<f64>,
    /// Forces that act on the slider (x, y), at the nodes of each side, N/mm; the receptacle carries the reaction.
    pub force: Sides<Vec<f64>>,
    /// Largest indentation of the last increment, mm: the scale of gaps.
    pub indentation: f64,
    /// Height of the loaded, unworn contact, the reference of a spring in the load; `None` before the first load.
    pub reference_height: Option<f64>,
}

impl ContactState {
    /// Bodies that touch without load at the neutral position.
    pub fn untouched(operators: &Operators) -> Self {
        let (n, m) = (operators.receptacle.x.len(), operators.slider.x.len());
        Self {
            slider_x: 0.0,
            height: 0.0,
            status: vec![Status::Open; n],
            pressure: vec![0.0; n],
            shear: vec![0.0; n],
            force: Sides {
                slider: vec![0.0; 2 * m],
                receptacle: vec![0.0; 2 * n],
            },
            indentation: 0.0,
            reference_height: None,
        }
    }

    /// Resets to an open contact with the slider at a position.
    fn reset_open(&mut self, last: &Self, slider_x: f64) {
        self.slider_x = slider_x;
        self.height = last.height;
        self.indentation = last.indentation;
        self.reference_height = last.reference_height;
        self.status.fill(Status::Open);
        for values in [
            &mut self.pressure,
            &mut self.shear,
            &mut self.force.receptacle,
            &mut self.force.slider,
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
        -self.force.receptacle.iter().step_by(2).sum::<f64>()
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

    /// Normal load at the present height, reduced by the spring, N/mm; not negative, since round-off below zero is no
    /// load.
    pub fn load(&self, interface: &Interface) -> f64 {
        self.equilibrium_load(interface).max(0.0)
    }

    /// The load of the vertical balance, which round-off may make negative.
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
