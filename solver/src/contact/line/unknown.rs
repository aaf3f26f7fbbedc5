//! Unknowns of an increment: tractions at coupled nodes.

use super::problem::{Iterate, Problem};
use super::status::Status;

/// A traction that is solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unknown {
    /// The pressure at a node, together with the friction that it causes in a status.
    Pressure(usize, Status),
    /// The shear traction at a node.
    Shear(usize),
}

impl Unknown {
    /// The pressure of a node, without friction where its shear is an unknown of its own.
    pub(super) fn pressure(problem: &Problem<'_>, node: usize) -> Self {
        let status = if problem.tracks_slip {
            Status::Stick
        } else {
            Status::slip(problem.step)
        };
        Self::Pressure(node, status)
    }

    /// Node.
    pub(super) fn node(self) -> usize {
        match self {
            Self::Pressure(node, _) | Self::Shear(node) => node,
        }
    }

    /// Force on the slider (x, y) per unit of it, mm: p N - q T over the node's width, with N = (-s, 1) and T = (1, s).
    pub(super) fn force(self, problem: &Problem<'_>) -> [f64; 2] {
        let (width, slope) = (problem.width[self.node()], problem.slope[self.node()]);
        let (normal, tangential) = match self {
            Self::Pressure(node, status) => {
                let friction = problem.friction.at(node);
                (width, -status.direction() * friction * width)
            }
            Self::Shear(_) => (0.0, -width),
        };
        [tangential - slope * normal, normal + slope * tangential]
    }

    /// Value in an iterate, MPa.
    pub(super) fn value(self, it: &Iterate) -> f64 {
        match self {
            Self::Pressure(node, _) => it.pressure[node],
            Self::Shear(node) => it.shear[node],
        }
    }
}
