//! The resistance of the contact in a run.

use crate::checkpoint::SectionRun;
use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::effects::{Crossing, Effect, EffectsPlan};
use crate::electrical::{ElectricalState, Evaluation, Touching};
use crate::model::Model;
use crate::record::{Life, unreached};
use crate::run::computed::{Computed, UNLIMITED, cycle_after};
use crate::scene::Scene;
use crate::schedule::stops;
use crate::sides::Sides;

/// What evaluates the resistance of the contact, if the plan has it.
pub(super) fn evaluation<'a>(scene: &'a Scene, plan: &EffectsPlan) -> Option<Evaluation<'a>> {
    let electrical = scene.conduction.known()?;
    plan.simulates(Effect::Resistance)
        .then(|| Evaluation::new(electrical))
}

/// What the resistance after a computed cycle has the run do.
pub(super) enum Consequence {
    /// Go to a cycle instead: a limit of the resistance was passed in too long a step.
    GoTo(u64),
    /// Simulate effects that were skipped.
    Effects(Vec<Crossing>),
}

/// Takes a computed cycle after a state into the resistance; where that has the run do something else, the run is as before it, but for
/// its state where skipped effects are called for.
pub(super) fn update(
    evaluation: &Evaluation<'_>,
    (scene, plan): (&Scene, &EffectsPlan),
    (model, condensed): (&Model, &Condensed),
    (run, before): (&mut SectionRun, &CycleState),
) -> Option<Consequence> {
    let electrical = run.electrical.clone();
    let computed = Computed {
        before,
        after: &run.state,
    };
    evaluation.update(&mut run.electrical, |part| {
        computed.contact((evaluation, scene), (model, condensed), (part, UNLIMITED))
    });
    let cycles = (before.cycle, run.state.cycle);
    let found = consequence(scene, plan, cycles, (&electrical, &run.electrical));
    match &found {
        None => run.state.constriction_mohm = run.electrical.constriction_mohm(),
        Some(Consequence::GoTo(_)) => {
            run.state = CycleState {
                work: run.state.work,
                ..before.clone()
            };
            run.electrical = electrical;
        }
        Some(Consequence::Effects(_)) => run.electrical = electrical,
    }
    found
}

/// The consequence of the resistances before and after a computed cycle, if there is one.
pub(super) fn consequence(
    scene: &Scene,
    plan: &EffectsPlan,
    cycles: (u64, u64),
    (before, after): (&ElectricalState, &ElectricalState),
) -> Option<Consequence> {
    let electrical = scene.conduction.known()?;
    let resistances = (before.total_mohm()?, after.total_mohm()?);
    if let Some(sooner) = stops::resistance_passed(electrical, cycles, resistances) {
        return Some(Consequence::GoTo(sooner));
    }
    let called_for = plan.crossed_by_current(scene, cycles.0, after);
    (!called_for.is_empty()).then_some(Consequence::Effects(called_for))
}

/// Takes a computed cycle into the lives by the resistance, after those by the depth: a limit that is passed in it is located among its
/// contacts, in none of which a place is deeper than a criterion that is reached later. `contact` is the one after a part of the cycle.
pub(super) fn push_life(
    (scene, evaluation): (&Scene, &Evaluation<'_>),
    cycles: (u64, u64),
    (before, after): (&ElectricalState, &ElectricalState),
    life: &mut Life,
    contact: impl Fn(f64, Sides<f64>) -> Touching,
) {
    let limits = scene.conduction.known().map(|known| &known.life_mohm[..]);
    let resistances = before.total_mohm().zip(after.total_mohm());
    let (Some(limits), Some(resistances)) = (limits, resistances) else {
        return;
    };
    life.push_resistance(limits, cycles, resistances, |limit, criteria| {
        evaluation.part_at(limit, (before, after), |part| {
            let at = cycle_after(cycles, part);
            contact(part, unreached(scene, criteria, at))
        })
    });
}

/// The same of a section, from the states before the computed cycle.
pub(super) fn push_life_of_section(
    (evaluation, scene): (&Evaluation<'_>, &Scene),
    bodies: (&Model, &Condensed),
    (run, before, electrical): (&mut SectionRun, &CycleState, &ElectricalState),
) {
    let computed = Computed {
        before,
        after: &run.state,
    };
    let cycles = (before.cycle, run.state.cycle);
    let states = (electrical, &run.electrical);
    push_life(
        (scene, evaluation),
        cycles,
        states,
        &mut run.life,
        |part, limits| computed.contact((evaluation, scene), bodies, (part, limits)),
    );
}

/// Whether the resistance has reached a limit that ends the run.
pub(super) fn exceeds_limit(scene: &Scene, electrical: &ElectricalState) -> bool {
    let limits = scene.conduction.known().map(|known| &known.stop_mohm);
    let exceeds = |limit: &f64| electrical.total_mohm().is_some_and(|total| total >= *limit);
    limits.into_iter().flatten().any(exceeds)
}
