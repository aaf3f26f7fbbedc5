//! The resistance of the contacts of half-spaces in a run.

use super::contact::Contact;
use crate::change::Change;
use crate::checkpoint::Run;
use crate::electrical::{ElectricalState, Evaluation};
use crate::record::CycleRange;
use crate::run::section::computed::{UNLIMITED, elapsed_s};
use crate::run::section::resistance;
use crate::scene::Scene;

/// Takes the contact after a computed cycle into the resistance, if it is evaluated; from the states before and after the cycle.
pub(super) fn update_resistance<C: Contact>(
    scene: &Scene,
    evaluation: Option<&Evaluation<'_>>,
    before: &C::State,
    after: &C::State,
    electrical: &mut ElectricalState,
) {
    let (Some(evaluation), Some(areas)) = (evaluation, C::areas(before, after)) else {
        return;
    };
    let cycles = range::<C>(before, after);
    evaluation.update(electrical, |part| {
        let time_s = elapsed_s(scene, cycles.after(part));
        evaluation.area(&areas(part, UNLIMITED), time_s)
    });
}

/// Takes a computed cycle into the lives by the resistance, if it is evaluated; from the states before the cycle.
pub(super) fn push_life_by_resistance<C: Contact>(
    scene: &Scene,
    evaluation: Option<&Evaluation<'_>>,
    before: &C::State,
    electrical: &ElectricalState,
    run: &mut Run<C::State, ()>,
) {
    let (Some(evaluation), Some(areas)) = (evaluation, C::areas(before, &run.state)) else {
        return;
    };
    let cycles = range::<C>(before, &run.state);
    let change = Change {
        before: electrical,
        after: &run.electrical,
    };
    let contact = |part, limits| {
        let time_s = elapsed_s(scene, cycles.after(part));
        evaluation.area(&areas(part, limits), time_s)
    };
    resistance::push_life(scene, evaluation, cycles, change, &mut run.life, contact);
}

/// The cycles between two states.
pub(super) fn range<C: Contact>(before: &C::State, after: &C::State) -> CycleRange {
    CycleRange {
        from: C::cycle(before),
        to: C::cycle(after),
    }
}
