//! The load on the unworn bodies: cycle 0.

use std::ops::ControlFlow;

use super::contact::{Bodies, Contact, RunOf, RunOfContact};
use super::resistance::Resistance;
use super::step::required_after;
use crate::SolveError;
use crate::checkpoint::{EarlierRuns, Run};
use crate::effects::EffectsPlan;
use crate::electrical::ElectricalState;
use crate::observer::{Event, Observer, Restart};
use crate::record::{Compared, CycleReport, Initial, Life, Snapshot};
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
        let at_rest = unworn_at_rest::<B>(scene, &plan).transpose();
        let loaded = at_rest.and_then(|at_rest| {
            let contact = &mut bodies.contact(&blocks[0]);
            load(scene, &plan, contact, at_rest, observer)
        });
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

/// The unworn contact as it is reported.
struct Unworn {
    report: CycleReport,
    snapshot: Snapshot,
    initial: Initial,
}

impl Unworn {
    /// Reports a loaded contact.
    fn of<C: Contact>(
        scene: &Scene,
        contact: &C,
        state: &C::State,
        electrical: &ElectricalState,
    ) -> Result<Self, SolveError> {
        let worn = contact.worn(state);
        let report = contact.report(scene, state, &worn, electrical.resistance.as_ref());
        Ok(Self {
            initial: Initial {
                peak_pressure_mpa: report.peak_pressure_mpa,
                contact_half_width_mm: report.contact_half_width_mm,
                contact_resistance_mohm: electrical.total_mohm(),
            },
            snapshot: contact.snapshot(scene, state, &worn)?,
            report,
        })
    }
}

/// Observes nothing: the contact at rest is part of the load.
struct Silent;

impl Observer for Silent {
    fn on(&mut self, _: Event<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// The unworn contact on a mesh that resolves it, where that of the run does not.
fn unworn_at_rest<B: Bodies>(
    scene: &Scene,
    plan: &EffectsPlan,
) -> Option<Result<Unworn, SolveError>> {
    let at_rest = scene.at_rest()?;
    let loaded = || {
        let mut bodies = B::unworn(&at_rest, plan, &mut Silent)?;
        let mut contact = bodies.contact(&at_rest);
        let mut state = contact.load()?;
        let electrical = Resistance::of(scene, plan).of_unworn(&contact, &mut state);
        Unworn::of(scene, &contact, &state, &electrical)
    };
    Some(loaded())
}

/// Cycle 0: the unworn, loaded state, reported as on a mesh of its own if there is one.
fn load<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &mut C,
    at_rest: Option<Unworn>,
    observer: &mut dyn Observer,
) -> Result<(RunOfContact<C>, ControlFlow<()>), SolveError> {
    let mut state = contact.load()?;
    let electrical = Resistance::of(scene, plan).of_unworn(contact, &mut state);
    let Unworn {
        report,
        snapshot,
        initial,
    } = match at_rest {
        Some(at_rest) => at_rest,
        None => Unworn::of(scene, contact, &state, &electrical)?,
    };
    let mut compared = Compared::default();
    compared.push(&report);
    let mut flow = observer.on(Event::Cycle(&report));
    if flow.is_continue() {
        flow = observer.on(Event::Snapshot(&snapshot));
    }
    if flow.is_continue() {
        contact.initial_quarter(&mut state)?;
    }
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
