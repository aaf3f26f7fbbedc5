//! Coefficient of friction at the nodes of an increment.
//!
//! The coefficient is one value, or one at each slave node: the mean of both surfaces there (`law::friction`), the master's
//! interpolated at the position of the increment. It does not change within the increment, so that Newton's Jacobian is exact.
//!
//! Friction opposes the slip in the tangent plane, |q| = mu p. With slip along the line besides, which is imposed, its part across the line is
//! that of a slider which follows the surface there (`slip_along`).

use super::pair::{Pair, Surfaces};
use super::state::ContactState;
use crate::law::friction::{Coefficients, of_both, weighted_mean};
use crate::model::{Interface, Tangential};
use crate::sides::Sides;
use std::ops::Range;

/// Coefficient of friction at the coupled nodes, -.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coefficient<'a> {
    /// Coefficients of the nodes from the first coupled one on.
    nodes: Coefficients<'a>,
    /// Components of the direction of friction across the line and along it at each of them, -; across it if absent.
    directions: &'a [[f64; 2]],
}

impl<'a> Coefficient<'a> {
    /// No friction.
    pub(super) const NONE: Self = Self {
        nodes: Coefficients::Uniform(0.0),
        directions: &[],
    };

    /// The law's in these directions, from the coefficients of [`interpolate`] where these differ.
    pub(super) fn of(
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        nodal: &'a [f64],
        directions: &'a [[f64; 2]],
    ) -> Self {
        let nodes = if surfaces.has_uniform_friction() {
            Coefficients::Uniform(pair.interface.friction)
        } else {
            Coefficients::Local(nodal)
        };
        Self { nodes, directions }
    }

    /// Friction across the line over the pressure of a coupled node.
    #[inline]
    pub(super) fn at(self, node: usize) -> f64 {
        self.direction(node)[0] * self.nodes.at(node)
    }

    /// Friction along the line over the pressure of a coupled node.
    pub(super) fn along(self, node: usize) -> f64 {
        self.direction(node)[1] * self.nodes.at(node)
    }

    #[inline]
    fn direction(self, node: usize) -> [f64; 2] {
        self.directions.get(node).copied().unwrap_or([1.0, 0.0])
    }

    /// The largest friction across the line over the pressure of all coupled nodes.
    pub(super) fn largest(self) -> f64 {
        if self.directions.is_empty() {
            return self.nodes.largest();
        }
        let nodes = self.directions.len();
        (0..nodes).fold(0.0, |most, node| self.at(node).max(most))
    }

    /// The mean friction across the line over the pressure, weighted by normal forces.
    pub(super) fn mean(self, forces: impl Iterator<Item = f64>) -> f64 {
        if self.directions.is_empty() {
            return self.nodes.mean(forces);
        }
        let forces: Vec<f64> = forces.collect();
        let across: Vec<f64> = (0..forces.len()).map(|node| self.at(node)).collect();
        weighted_mean(&across, forces.into_iter())
    }
}

/// Coefficient of the friction that acts on the bodies in a step of the slider; an imposed slip of zero has no direction.
pub(super) fn acting<'a>(
    interface: &Interface,
    friction: Coefficient<'a>,
    step: f64,
) -> Coefficient<'a> {
    match interface.tangential {
        Tangential::StickSlip => friction,
        Tangential::ImposedSlip if step != 0.0 => friction,
        Tangential::ImposedSlip | Tangential::Omitted => Coefficient::NONE,
    }
}

/// Writes the coefficients at these nodes of the slave; none where all places have the same.
pub(in crate::contact) fn interpolate(
    pair: &Pair<'_>,
    surfaces: &Surfaces<'_>,
    pairing_x: f64,
    nodes: Range<usize>,
    coefficients: &mut Vec<f64>,
) {
    coefficients.clear();
    if surfaces.has_uniform_friction() {
        return;
    }
    let slave = pair.interface.slave;
    let (own, far) = (
        *surfaces.friction.of(slave),
        *surfaces.friction.of(slave.other()),
    );
    let x = &pair.master().x;
    let offset = pair.offset(pairing_x);
    let mut next = 1;
    let mut opposite = |at: f64, far: &[f64]| {
        while next < x.len() - 1 && x[next] < at {
            next += 1;
        }
        let share = ((at - x[next - 1]) / (x[next] - x[next - 1])).clamp(0.0, 1.0);
        far[next - 1] + share * (far[next] - far[next - 1])
    };
    for node in nodes {
        let mut both = Sides::default();
        *both.of_mut(slave) = own.map(|own| own[node]);
        *both.of_mut(slave.other()) = far.map(|far| opposite(pair.slave().x[node] - offset, far));
        coefficients.extend(of_both(both));
    }
}

/// Coefficients at the nodes of a solved contact from the first one that touches to the last, -, whatever the direction of the slip.
pub(crate) fn coefficients_in_contact(
    pair: &Pair<'_>,
    surfaces: &Surfaces<'_>,
    contact: &ContactState,
) -> Vec<f64> {
    let (first, end) = contact.active_range().unwrap_or_default();
    if surfaces.has_uniform_friction() {
        return vec![pair.interface.friction; end - first];
    }
    let mut coefficients = Vec::new();
    interpolate(
        pair,
        surfaces,
        contact.pairing_x,
        first..end,
        &mut coefficients,
    );
    coefficients
}
