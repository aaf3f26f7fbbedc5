//! Coefficient of friction at the nodes of an increment.
//!
//! It is one value, or one at each node of the slave: the mean of what both surfaces have there (`law::friction`), the master's
//! interpolated at the position of the increment. It does not change within the increment, so that Newton's Jacobian is exact.

use super::pair::{Pair, Surfaces};
use crate::law::friction::of_both;
use crate::sides::Sides;

/// Coefficient of friction at the coupled nodes, -.
#[derive(Debug, Clone, Copy)]
pub(super) enum Coefficient<'a> {
    /// The same at all of them.
    Uniform(f64),
    /// That of each, from the first coupled node on.
    Nodal(&'a [f64]),
}

impl<'a> Coefficient<'a> {
    /// The law's, from the coefficients of [`interpolate`] where these differ.
    pub(super) fn of(pair: &Pair<'_>, surfaces: &Surfaces<'_>, nodal: &'a [f64]) -> Self {
        if surfaces.has_uniform_friction() {
            Self::Uniform(pair.interface.friction)
        } else {
            Self::Nodal(nodal)
        }
    }

    /// That of a coupled node.
    #[inline]
    pub(super) fn at(self, node: usize) -> f64 {
        match self {
            Self::Uniform(coefficient) => coefficient,
            Self::Nodal(coefficients) => coefficients[node],
        }
    }

    /// The largest of all coupled nodes.
    pub(super) fn largest(self) -> f64 {
        match self {
            Self::Uniform(coefficient) => coefficient,
            Self::Nodal(coefficients) => coefficients.iter().fold(0.0, |most, mu| mu.max(most)),
        }
    }
}

/// Writes the coefficients at the slave's nodes from number `first` to before `end`; none where all places have the same.
pub(super) fn interpolate(
    pair: &Pair<'_>,
    surfaces: &Surfaces<'_>,
    pairing_x: f64,
    (first, end): (usize, usize),
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
    for node in first..end {
        let mut both = Sides::default();
        *both.of_mut(slave) = own.map(|own| own[node]);
        *both.of_mut(slave.other()) = far.map(|far| opposite(pair.slave().x[node] - offset, far));
        coefficients.extend(of_both(both));
    }
}
