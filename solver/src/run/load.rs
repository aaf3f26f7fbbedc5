//! The load on the unworn bodies: cycle 0.

use std::ops::ControlFlow;

use super::contact::{Bodies, Contact, RunOf, RunOfContact};
use super::resistance::Resistance;
use super::step::required_after;
use crate::SolveError;
use crate::checkpoint::{EarlierRuns, Run};
use crate::effects::EffectsPlan;
use crate::observer::{Event, Observer, Restart};
use crate::record::{Compared, Initial, Life};
use crate::scene::Scene;
use crate::schedule::mission_state::MissionState;

/// The loaded, unworn bodies, and the plan that their load required.
pub(super) struct Loaded<B: Bodies> {
    pub(super) plan: EffectsPlan,
    pub(super) bodies: B,
    pub(super) run: RunOf<B>,
    /// `Break` if the observer has stopped the run.
    pub(super) flow: ControlFlow<()>,
}

/// Loads the unworn bodies: with wider zones where the contact is too wide for them, and with effects that were skipped where it has no
/// solution without them.
pub(super) fn load_unworn<B: Bodies>(
    scene: &Scene,
    plan: &EffectsPlan,
    observer: &mut dyn Observer,
) -> Result<Loaded<B>, SolveError> {
    let (mut plan, mut crossings) = (plan.clone(), Vec::new());
    let mut bodies = B::unworn(scene, &plan, observer)?;
    let blocks = scene.blocks();
    loop {
        let loaded = load(scene, &plan, &mut bodies.contact(&blocks[0]), observer);
        let error = match loaded {
            Ok((mut run, flow)) => {
                run.crossings = crossings;
                return Ok(Loaded {
                    plan,
                    bodies,
                    run,
                    flow,
                });
            }
            Err(error) => error,
        };
        let required = required_after(&error, &plan, 0);
        let restart = match required.first() {
            _ if error.needs_wider_zones() => Restart::WiderZones(&error),
            Some(first) => Restart::Without(first.effect, &error),
            None => return Err(error),
        };
        if observer.on(Event::Restart(restart)).is_break() {
            return Err(error);
        }
        bodies = if error.needs_wider_zones() {
            bodies.widened(scene)?
        } else {
            crossings.extend(required);
            plan = plan.after(&crossings);
            bodies.with_effects(scene, &plan, None, observer)?
        };
    }
}

/// Cycle 0: the unworn, loaded state.
fn load<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &mut C,
    observer: &mut dyn Observer,
) -> Result<(RunOfContact<C>, ControlFlow<()>), SolveError> {
    let mut state = contact.load()?;
    let electrical = Resistance::of(scene, plan).of_unworn(contact, &mut state);
    let worn = contact.worn(&state);
    let report = contact.report(scene, &state, &worn, electrical.resistance.as_ref());
    let mut compared = Compared::default();
    compared.push(&report);
    let mut flow = observer.on(Event::Cycle(&report));
    if flow.is_continue() {
        let snapshot = contact.snapshot(scene, &state, &worn)?;
        flow = observer.on(Event::Snapshot(&snapshot));
    }
    if flow.is_continue() {
        contact.initial_quarter(&mut state)?;
    }
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
        contact_resistance_mohm: electrical.total_mohm(),
    };
    let mission = scene.mission.as_ref();
    let run = Run {
        mission: mission.map(|mission| MissionState::new(scene, mission, contact.totals(&state))),
        state,
        initial,
        crossings: Vec::new(),
        compared,
        life: Life::default(),
        electrical,
        earlier: EarlierRuns::default(),
    };
    Ok((run, flow))
}
