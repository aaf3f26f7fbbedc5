//! The resistance of the contact in a run.

use super::contact::{Contact, Moment, RunOfContact};
use crate::change::Change;
use crate::effects::{Crossing, EffectsPlan};
use crate::electrical::{ElectricalState, Evaluation};
use crate::record::{CycleRange, unreached};
use crate::scene::{Effect, Scene};
use crate::schedule::stops;
use crate::sides::Sides;

/// No limit of the depth, mm.
const UNLIMITED: Sides<f64> = Sides {
    slider: f64::INFINITY,
    receptacle: f64::INFINITY,
};

/// The resistance of a scene by a plan.
pub(super) struct Resistance<'a> {
    scene: &'a Scene,
    plan: &'a EffectsPlan,
    /// `None` where it is not simulated.
    evaluation: Option<Evaluation<'a>>,
}

/// Action of the run that the resistance after a computed cycle requires.
pub(super) enum RequiredAction {
    /// Go to a cycle instead: a limit of the resistance was passed in too long a step.
    GoTo(u64),
    /// Simulate effects that were skipped.
    Effects(Vec<Crossing>),
}

impl<'a> Resistance<'a> {
    pub(super) fn of(scene: &'a Scene, plan: &'a EffectsPlan) -> Self {
        let known = scene.conduction.known();
        let simulated = known.filter(|_| plan.simulates(Effect::Resistance));
        Self {
            scene,
            plan,
            evaluation: simulated.map(Evaluation::new),
        }
    }

    /// The resistance of the unworn contact, which its state takes.
    pub(super) fn of_unworn<C: Contact>(
        &self,
        contact: &C,
        state: &mut C::State,
    ) -> ElectricalState {
        let mut electrical = ElectricalState::default();
        let unworn = Change {
            before: &*state,
            after: &*state,
        };
        self.evaluate(contact, unworn, &mut electrical);
        C::follow_resistance(state, &electrical);
        electrical
    }

    /// Takes a computed cycle after a state into the resistance, by the one before.
    pub(super) fn update<C: Contact>(
        &self,
        contact: &C,
        run: &mut RunOfContact<C>,
        before: &C::State,
        electrical: &ElectricalState,
    ) -> Option<RequiredAction> {
        let states = Change {
            before,
            after: &run.state,
        };
        self.evaluate(contact, states, &mut run.electrical);
        let change = Change {
            before: electrical,
            after: &run.electrical,
        };
        let required = self.required_action(cycles::<C>(states), change);
        if required.is_none() {
            C::follow_resistance(&mut run.state, &run.electrical);
        }
        required
    }

    fn evaluate<C: Contact>(
        &self,
        contact: &C,
        states: Change<&C::State>,
        electrical: &mut ElectricalState,
    ) {
        let Some(evaluation) = &self.evaluation else {
            return;
        };
        evaluation.update(electrical, |part| {
            let moment = self.moment(cycles::<C>(states), part, UNLIMITED);
            contact.touching(self.scene, evaluation, states, moment)
        });
    }

    /// The moment after a part of the cycles, at which no place is deeper than these limits, mm.
    fn moment(&self, cycles: CycleRange, part: f64, deepest: Sides<f64>) -> Moment {
        let (_, time_s) = self.scene.elapsed(cycles.after(part));
        Moment {
            part,
            time_s: time_s.unwrap_or_default(),
            deepest,
        }
    }

    /// The action that the resistances before and after a computed cycle require, if any.
    fn required_action(
        &self,
        CycleRange { from, to }: CycleRange,
        change: Change<&ElectricalState>,
    ) -> Option<RequiredAction> {
        let electrical = self.scene.conduction.known()?;
        let resistance = change.total_mohm()?;
        if let Some(sooner) = stops::resistance_passed(electrical, from, to, resistance) {
            return Some(RequiredAction::GoTo(sooner));
        }
        let crossed = self.plan.crossed_by_current(self.scene, from, change.after);
        (!crossed.is_empty()).then_some(RequiredAction::Effects(crossed))
    }

    /// Takes a computed cycle into the lives by the resistance, after those by the depth: a limit that is passed in it is located among its
    /// contacts, in none of which a place is deeper than a criterion that is reached later.
    pub(super) fn push_life<C: Contact>(
        &self,
        contact: &C,
        run: &mut RunOfContact<C>,
        before: &C::State,
        electrical: &ElectricalState,
    ) {
        let limits = self.scene.conduction.known().map(|known| &known.life_mohm);
        let states = Change {
            before,
            after: &run.state,
        };
        let change = Change {
            before: electrical,
            after: &run.electrical,
        };
        let (Some(evaluation), Some(limits), Some(resistance)) =
            (&self.evaluation, limits, change.total_mohm())
        else {
            return;
        };
        let cycles = cycles::<C>(states);
        let life = &mut run.life;
        life.push_resistance(limits, cycles, resistance, |limit, criteria| {
            evaluation.part_at(limit, change, |part| {
                let deepest = unreached(self.scene, criteria, cycles.after(part));
                let moment = self.moment(cycles, part, deepest);
                contact.touching(self.scene, evaluation, states, moment)
            })
        });
    }
}

/// The cycles between two states.
fn cycles<C: Contact>(states: Change<&C::State>) -> CycleRange {
    CycleRange {
        from: C::cycle(states.before),
        to: C::cycle(states.after),
    }
}

/// Returns `true` if the resistance has reached a limit that ends the run.
pub(super) fn exceeds_limit(scene: &Scene, electrical: &ElectricalState) -> bool {
    let limits = scene.conduction.known().map(|known| &known.stop_mohm);
    let exceeds = |limit: &f64| electrical.total_mohm().is_some_and(|total| total >= *limit);
    limits.into_iter().flatten().any(exceeds)
}
