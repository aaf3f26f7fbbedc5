//! Record of a computed cycle of sections along a line besides its state: contacts at named positions and the friction loop.

use crate::contact::ContactState;
use crate::cycle::{FrictionLoop, Neutral};
use crate::schedule::step::Position;

/// Contacts of all sections at a named position.
#[derive(Debug, Clone)]
pub(crate) struct PositionContacts {
    pub(crate) position: Position,
    pub(crate) slider_x: f64,
    pub(crate) contacts: Vec<ContactState>,
    /// Coefficients of friction at the nodes of each of them from the first in contact to the last, -.
    pub(crate) friction: Vec<Vec<f64>>,
    /// Their loads, pressures, widths and mean coefficients of friction.
    pub(crate) found: Vec<Neutral>,
    /// |sum of vertical forces with the normals as worn there - force| over the force.
    pub(crate) imbalance: f64,
}

impl PositionContacts {
    /// Removes the contacts at a position from others, if they are among them.
    pub(crate) fn take(others: &mut Vec<Self>, position: Position) -> Option<Self> {
        let found = others.iter().position(|at| at.position == position);
        found.map(|found| others.swap_remove(found))
    }
}

/// The contact of a section at a named position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SectionContact<'a> {
    pub(crate) position: Position,
    /// Displacement of the slider, mm.
    pub(crate) slider_x_mm: f64,
    pub(crate) contact: &'a ContactState,
    /// Coefficients of friction at its nodes from the first in contact to the last, -.
    pub(crate) friction: &'a [f64],
}

/// Record of a computed cycle.
#[derive(Debug, Default)]
pub(crate) struct LineRecord {
    /// Force of the slider along the motion, N, and that over the length of the line.
    pub(crate) friction_loop: FrictionLoop,
    pub(crate) positions: Vec<PositionContacts>,
}

impl LineRecord {
    /// Appends a point of the loop.
    pub(crate) fn push(&mut self, displacement: f64, force_n: f64, length_mm: f64) {
        let found = &mut self.friction_loop;
        found.displacement_mm.push(displacement);
        found.tangential_force_n_per_mm.push(force_n / length_mm);
        found.tangential_force_n.push(force_n);
    }

    /// Increments of the cycle.
    pub(crate) fn increments(&self) -> usize {
        self.friction_loop.displacement_mm.len()
    }

    /// The contacts at the neutral position of each section, where it was passed.
    pub(crate) fn neutral(&self) -> &[Neutral] {
        let mut positions = self.positions.iter();
        let neutral = positions.find(|contacts| contacts.position == Position::Neutral);
        neutral.map_or(&[], |contacts| &contacts.found)
    }
}
