//! What a computed cycle records besides the state: contacts at named positions and the friction loop.

use super::bodies::Bodies;
use crate::contact::ContactState;
use crate::cycle::{FrictionLoop, Neutral};
use crate::schedule::step::Position;

/// Contacts of all planes at a named position.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) position: Position,
    pub(super) slider_x: f64,
    pub(super) contacts: Vec<ContactState>,
    /// Their loads, pressures and widths.
    pub(super) found: Vec<Neutral>,
    /// |vertical force with the normals as worn there - load| over the load.
    pub(super) imbalance: f64,
}

/// Record of a computed cycle.
#[derive(Debug, Default)]
pub(super) struct CycleRecord {
    /// Force of the slider along the motion per width, N/mm, and that on the whole width, N.
    pub(super) friction_loop: FrictionLoop,
    pub(super) placed: Vec<Placed>,
}

impl CycleRecord {
    /// Appends a point of the loop.
    pub(super) fn push(&mut self, displacement: f64, force: f64, bodies: &Bodies) {
        let width = 2.0 * bodies.planes.lengths().iter().sum::<f64>();
        let found = &mut self.friction_loop;
        found.displacement_mm.push(displacement);
        found.tangential_force_n_per_mm.push(force);
        found.tangential_force_n.push(force * width);
    }
}
