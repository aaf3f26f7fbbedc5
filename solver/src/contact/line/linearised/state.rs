//! Contact states of a linearised contact.

use super::super::friction::Coefficient;
use super::super::outcome::{self, Solution};
use super::super::state::ContactState;
use super::{LinearisedContact, Place};

impl LinearisedContact {
    /// Writes the last solution to a state that follows another one.
    pub(crate) fn write(&mut self, place: Place<'_>, last: &ContactState, next: &mut ContactState) {
        let friction = Coefficient::of(place.pair, &place.surfaces, &[], &[]);
        let it = &mut self.iterate;
        it.shear.fill(0.0);
        it.apply_friction(friction);
        let solution = Solution {
            geometry: &self.geometry,
            iterate: it,
            friction,
        };
        outcome::write(solution, place.pair, last, place.setting(), next);
    }
}
