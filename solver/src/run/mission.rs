//! Missions of a run.

use super::contact::{Contact, RunOfContact};
use crate::record::Exposed;
use crate::scene::Scene;
use crate::schedule::stops::StopQuantities;

/// Moves on to the next block of a mission.
pub(super) fn next_block<C: Contact>(
    scene: &Scene,
    contact: &C,
    run: &mut RunOfContact<C>,
    worn: &C::Worn,
) {
    let (state, Some(mission)) = (&mut run.state, &mut run.mission) else {
        return;
    };
    let rates = mission.end_block(scene, contact.totals(state));
    let now = StopQuantities {
        cycle: C::cycle(state),
        cycles_left: contact.cycles_left_at(state, rates),
        fastest_rate: rates.map(|rates| rates.iter().fold(0.0, |m: f64, rate| m.max(*rate))),
        worn_through: contact.is_worn_through(state),
        exceeds_resistance: false,
    };
    let leaves = C::take_history(state);
    let depth = |side, part| contact.surface(state, worn, side).depth_of_part(part);
    if let Some(history) = mission.begin_block(scene, now, depth, leaves) {
        C::continue_motion(state, history);
    }
}
