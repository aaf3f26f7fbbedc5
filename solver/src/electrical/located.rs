//! Where in a computed cycle something happens to the contact: the first part of the cycle after which it has.

use super::{ElectricalState, Evaluation, Touching};
use crate::change::Change;
use crate::sides::Side;

/// Halvings of the cycle: to 1e-9 of it.
const HALVINGS: usize = 30;

impl Evaluation<'_> {
    /// Notes since when metals are exposed that the present contact is the first to show.
    pub(super) fn note_exposure(
        &self,
        state: &mut ElectricalState,
        now: &Touching,
        during: impl Fn(f64) -> Touching,
    ) {
        for side in Side::BOTH {
            let since = state.exposed_since_s.of_mut(side);
            since.resize(self.electrical.metals.of(side).len(), None);
            for patch in &now.patches {
                let metal = *patch.metal.of(side);
                since[metal].get_or_insert_with(|| {
                    let part = first(|part| during(part).shows(side, metal));
                    during(part).time_s
                });
            }
        }
    }

    /// The part of a computed cycle after which the resistance is at a limit that it has at the end, mOhm, by the change of the state in it.
    pub(crate) fn part_at(
        &self,
        limit_mohm: f64,
        change: Change<&ElectricalState>,
        during: impl Fn(f64) -> Touching,
    ) -> f64 {
        let mut state = ElectricalState {
            exposed_since_s: change.after.exposed_since_s.clone(),
            ..change.before.clone()
        };
        first(|part| {
            self.take(&mut state, during(part));
            state.total_mohm().is_some_and(|total| total >= limit_mohm)
        })
    }
}

/// The first part for which something holds that holds for all of it.
fn first(mut holds: impl FnMut(f64) -> bool) -> f64 {
    if holds(0.0) {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
