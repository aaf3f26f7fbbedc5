//! The resistance of the contact in a run.

use super::computed::{Computed, UNLIMITED};
use crate::change::Change;
use crate::checkpoint::SectionRun;
use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::effects::{Crossing, EffectsPlan};
use crate::electrical::{ElectricalState, Evaluation, Touching};
use crate::model::Model;
use crate::record::{CycleRange, Life, unreached};
use crate::scene::Effect;
use crate::scene::Scene;
use crate::schedule::stops;
use crate::sides::Sides;

/// Prepares the evaluation of the contact resistance, if the plan has it.
pub(super) fn evaluation<'a>(scene: &'a Scene, plan: &EffectsPlan) -> Option<Evaluation<'a>> {
    let electrical = scene.conduction.known()?;
    plan.simulates(Effect::Resistance)
        .then(|| Evaluation::new(electrical))
}

/// Action of the run that the resistance after a computed cycle requires.
pub(super) enum RequiredAction {
    /// Go to a cycle instead: a limit of the resistance was passed in too long a step.
    GoTo(u64),
    /// Simulate effects that were skipped.
    Effects(Vec<Crossing>),
}

/// Takes a computed cycle after a state into the resistance; where that has the run do something else, the run is as before it, but for
/// its state where skipped effects are required.
pub(super) fn update(
    evaluation: &Evaluation<'_>,
    scene: &Scene,
    plan: &EffectsPlan,
    model: &Model,
    condensed: &Condensed,
    run: &mut SectionRun,
    before: &CycleState,
) -> Option<RequiredAction> {
    let electrical = run.electrical.clone();
    let computed = Computed {
        evaluation,
        scene,
        model,
        condensed,
        before,
        after: &run.state.cycle_state,
    };
    evaluation.update(&mut run.electrical, |part| {
        computed.contact(part, UNLIMITED)
    });
    let change = Change {
        before: &electrical,
        after: &run.electrical,
    };
    let found = required_action(scene, plan, computed.cycles(), change);
    match &found {
        None => run.state.cycle_state.constriction_mohm = run.electrical.constriction_mohm(),
        Some(RequiredAction::GoTo(_)) => {
            run.state.cycle_state = CycleState {
                work: run.state.cycle_state.work,
                ..before.clone()
            };
            run.electrical = electrical;
        }
        Some(RequiredAction::Effects(_)) => run.electrical = electrical,
    }
    found
}

/// The action that the resistances before and after a computed cycle require, if any.
pub(super) fn required_action(
    scene: &Scene,
    plan: &EffectsPlan,
    CycleRange { from, to }: CycleRange,
    change: Change<&ElectricalState>,
) -> Option<RequiredAction> {
    let electrical = scene.conduction.known()?;
    let resistance = change.total_mohm()?;
    if let Some(sooner) = stops::resistance_passed(electrical, from, to, resistance) {
        return Some(RequiredAction::GoTo(sooner));
    }
    let required = plan.crossed_by_current(scene, from, change.after);
    (!required.is_empty()).then_some(RequiredAction::Effects(required))
}

/// Takes a computed cycle into the lives by the resistance, after those by the depth: a limit that is passed in it is located among its
/// contacts, in none of which a place is deeper than a criterion that is reached later. `contact` is the one after a part of the cycle.
pub(super) fn push_life(
    scene: &Scene,
    evaluation: &Evaluation<'_>,
    cycles: CycleRange,
    change: Change<&ElectricalState>,
    life: &mut Life,
    contact: impl Fn(f64, Sides<f64>) -> Touching,
) {
    let limits = scene.conduction.known().map(|known| &known.life_mohm[..]);
    let (Some(limits), Some(resistance)) = (limits, change.total_mohm()) else {
        return;
    };
    life.push_resistance(limits, cycles, resistance, |limit, criteria| {
        evaluation.part_at(limit, change, |part| {
            contact(part, unreached(scene, criteria, cycles.after(part)))
        })
    });
}

/// The same of a section.
pub(super) fn push_life_of_section(
    computed: Computed<'_>,
    change: Change<&ElectricalState>,
    life: &mut Life,
) {
    let Computed {
        scene, evaluation, ..
    } = computed;
    let contact = |part, limits| computed.contact(part, limits);
    push_life(scene, evaluation, computed.cycles(), change, life, contact);
}

/// Returns `true` if the resistance has reached a limit that ends the run.
pub(super) fn exceeds_limit(scene: &Scene, electrical: &ElectricalState) -> bool {
    let limits = scene.conduction.known().map(|known| &known.stop_mohm);
    let exceeds = |limit: &f64| electrical.total_mohm().is_some_and(|total| total >= *limit);
    limits.into_iter().flatten().any(exceeds)
}
