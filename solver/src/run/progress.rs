//! Progress of a run: its next cycle, its end, and the quantities of its stops.

use super::contact::{Contact, RunOfContact};
use super::resistance;
use crate::record::{Exposed, Outcome};
use crate::scene::Scene;
use crate::schedule::stops::{self, StopQuantities};

/// Cycle up to which the next computed one may stand for the cycles.
pub(super) struct NextCycle {
    pub(super) cycle: u64,
    /// True if the state after it may be reported in detail.
    pub(super) is_reported: bool,
}

/// The next cycle that a run must hit exactly, within the present block of a mission and up to `until_limit`.
pub(super) fn next_cycle<C: Contact>(
    scene: &Scene,
    contact: &C,
    run: &RunOfContact<C>,
    worn: &C::Worn,
    until_limit: u64,
) -> NextCycle {
    let depth = |side, part| contact.surface(&run.state, worn, side).depth_of_part(part);
    let rate = |side, limit| C::rate_toward(&run.state, side, limit);
    let next = stops::next_at(scene, now(scene, contact, run), depth, rate).min(until_limit);
    let position = run.mission.as_ref().map(|mission| mission.position);
    let (cycle, is_reported) =
        position.map_or((next, true), |position| position.next_reported(scene, next));
    NextCycle { cycle, is_reported }
}

/// The outcome of a run that ends here.
pub(super) fn end<C: Contact>(
    scene: &Scene,
    contact: &C,
    run: &RunOfContact<C>,
    worn: &C::Worn,
) -> Option<Outcome> {
    let depth = |side, part| contact.surface(&run.state, worn, side).depth_of_part(part);
    let end = stops::end(scene, now(scene, contact, run), depth);
    end.or_else(|| contact.ending())
}

/// Progress for its stops.
fn now<C: Contact>(scene: &Scene, contact: &C, run: &RunOfContact<C>) -> StopQuantities {
    StopQuantities {
        cycle: C::cycle(&run.state),
        cycles_left: contact.cycles_left(&run.state),
        fastest_rate: C::fastest_rate(&run.state),
        worn_through: contact.is_worn_through(&run.state),
        exceeds_resistance: resistance::exceeds_limit(scene, &run.electrical),
    }
}
