//! The resistance of the contact in a run.

use crate::checkpoint::SectionRun;
use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::effects::{Crossing, Effect, EffectsPlan};
use crate::electrical::{Contact, ElectricalState, Evaluation, Surface};
use crate::model::Model;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::schedule::stops;
use crate::sides::Sides;

/// What evaluates the resistance of the contact, if the plan has it.
pub(super) fn evaluation<'a>(scene: &'a Scene, plan: &EffectsPlan) -> Option<Evaluation<'a>> {
    let electrical = scene.conduction.known()?;
    plan.simulates(Effect::Resistance)
        .then(|| Evaluation::new(electrical))
}

/// The contact at the last passage of the neutral position.
pub(super) fn contact<'a>(
    scene: &Scene,
    (model, condensed): (&'a Model, &Condensed),
    state: &'a CycleState,
) -> Contact<'a> {
    let neutral = state.neutral;
    let span = (
        neutral.middle - neutral.half_width,
        neutral.middle + neutral.half_width,
    );
    Contact {
        load_n_per_mm: neutral.load,
        span,
        surfaces: Sides::from_fn(|side| Surface {
            x: model.bodies.of(side).contact_x(),
            depth: state.depth.of(side),
        }),
        time_s: elapsed_s(scene, state.cycle),
        spreading: condensed.spreading_ratios(span),
    }
}

/// Time after a number of cycles, s; 0 of a continuous motion.
pub(super) fn elapsed_s(scene: &Scene, cycles: u64) -> f64 {
    scene.elapsed(real_cycles(cycles)).1.unwrap_or_default()
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
    let contact = contact(scene, (model, condensed), &run.state);
    evaluation.update(&mut run.electrical, &contact);
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

/// Limits of the resistance whose life is recorded, mOhm, with the resistances before and after a computed cycle.
pub(super) fn of_life<'a>(
    scene: &'a Scene,
    (before, after): (&ElectricalState, &ElectricalState),
) -> Option<(&'a [f64], (f64, f64))> {
    let electrical = scene.conduction.known()?;
    let resistances = (before.total_mohm()?, after.total_mohm()?);
    Some((&electrical.life_mohm, resistances))
}

/// Whether the resistance has reached a limit that ends the run.
pub(super) fn exceeds_limit(scene: &Scene, electrical: &ElectricalState) -> bool {
    let limits = scene.conduction.known().map(|known| &known.stop_mohm);
    let exceeds = |limit: &f64| electrical.total_mohm().is_some_and(|total| total >= *limit);
    limits.into_iter().flatten().any(exceeds)
}
