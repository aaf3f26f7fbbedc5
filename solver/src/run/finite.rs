//! The run of a contact of finite width, a point, a line or extruded bodies: cycles until it ends, with the events of the
//! run of a section. What its bodies are computed by is behind a trait.

mod conduction;
mod contact;
mod extruded;
mod line;
mod point;
mod sections;

use std::ops::ControlFlow;

use super::section::resistance::{self, RequiredAction};
use crate::SolveError;
use crate::change::Change;
use crate::checkpoint::{CheckpointMismatch, EarlierRuns, ExtrudedRun, LineRun, PointRun, Run};
use crate::effects::EffectsPlan;
use crate::electrical::ElectricalState;
use crate::extruded::ExtrudedIntegrator;
use crate::observer::{Event, Observer, Phase};
use crate::point::PointIntegrator;
use crate::record::{Compared, Exposed, Initial, Life, Outcome, Summary};
use crate::scene::{Dimension, Scene};
use crate::schedule::stops::{self, StopQuantities};
use crate::sides::Side;
use crate::station::LineIntegrator;
use conduction::{push_life_by_resistance, range, update_resistance};
use contact::Contact;

/// Solves a contact of finite width by a plan, after earlier runs of it.
pub(super) fn begin(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: EarlierRuns,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    match scene.dimension {
        Dimension::Line(_) => begin_contact::<LineIntegrator>(scene, plan, earlier, observer),
        Dimension::Extruded(_) => {
            begin_contact::<ExtrudedIntegrator>(scene, plan, earlier, observer)
        }
        Dimension::Point(_) | Dimension::PlaneStrain => {
            begin_contact::<PointIntegrator>(scene, plan, earlier, observer)
        }
    }
}

/// Solves a point contact by a plan from a checkpoint to its end.
pub(super) fn proceed_point(
    scene: &Scene,
    plan: &EffectsPlan,
    run: PointRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    proceed::<PointIntegrator>(scene, plan, run, observer)
}

/// Solves a contact along a line by a plan from a checkpoint to its end.
pub(super) fn proceed_line(
    scene: &Scene,
    plan: &EffectsPlan,
    run: LineRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    proceed::<LineIntegrator>(scene, plan, run, observer)
}

/// Solves extruded bodies by a plan from a checkpoint to their end.
pub(super) fn proceed_extruded(
    scene: &Scene,
    plan: &EffectsPlan,
    run: ExtrudedRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    proceed::<ExtrudedIntegrator>(scene, plan, run, observer)
}

fn begin_contact<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: EarlierRuns,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Cycles);
    let (contact, state) = C::start(scene, plan)?;
    let mut electrical = ElectricalState::default();
    let evaluation = resistance::evaluation(scene, plan);
    update_resistance::<C>(scene, evaluation.as_ref(), &state, &state, &mut electrical);
    let worn = contact.worn(&state);
    let report = contact.report(scene, &state, &worn, electrical.resistance.as_ref());
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
        contact_resistance_mohm: electrical.total_mohm(),
    };
    let snapshot = contact.snapshot(scene, &state, worn)?;
    let mut run = Run {
        state,
        mission: None,
        initial,
        crossings: Vec::new(),
        compared: Compared::default(),
        life: Life::default(),
        electrical,
        earlier,
    };
    run.compared.push(&report);
    let events = [Event::Cycle(&report), Event::Snapshot(&snapshot)];
    if events
        .into_iter()
        .any(|event| observer.on(event).is_break())
    {
        return Ok(summary(scene, plan, &contact, &run, Outcome::Stopped));
    }
    advance(scene, plan.clone(), contact, run, observer)
}

fn proceed<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    mut run: Run<C::State, ()>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let (cycle, cycles) = (C::cycle(&run.state), scene.cycles);
    if cycle > cycles {
        return Err(CheckpointMismatch::Beyond { cycle, cycles }.into());
    }
    observer.on_phase(Phase::Cycles);
    let plan = plan.after(&run.crossings);
    let contact = C::resume(scene, &plan, &mut run.state)?;
    advance(scene, plan, contact, run, observer)
}

/// Computes cycles until the run ends; where it requires an effect that was skipped, it continues from the cycle before with it.
fn advance<C: Contact>(
    scene: &Scene,
    mut plan: EffectsPlan,
    mut contact: C,
    mut run: Run<C::State, ()>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        let flow = integrate(scene, &plan, &mut contact, &mut run, observer)?;
        match flow {
            ControlFlow::Break(outcome) => {
                return Ok(summary(scene, &plan, &contact, &run, outcome));
            }
            ControlFlow::Continue(()) => plan = plan.after(&run.crossings),
        }
        contact = C::resume(scene, &plan, &mut run.state)?;
    }
}

/// Computes cycles until the run ends (`Break`) or requires an effect (`Continue`).
fn integrate<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &mut C,
    run: &mut Run<C::State, ()>,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let evaluation = resistance::evaluation(scene, plan);
    // Where a limit of the resistance was passed by too much.
    let mut until_limit = u64::MAX;
    let mut scars = C::scars(&contact.worn(&run.state));
    while C::cycle(&run.state) < scene.cycles {
        let before = run.state.clone();
        let now = progress(scene, contact, run);
        let until = stops::next(scene, now, |side, part| scars.of(side).depth_of_part(part));
        contact.compute_cycle(&mut run.state, until.min(until_limit))?;
        let (back_to, cycle) = (C::cycle(&before), C::cycle(&run.state));
        let required = plan.crossed(scene, back_to, cycle, C::max_depth_mm(&run.state));
        if !required.is_empty() {
            run.state = before;
            run.crossings.extend(required);
            return Ok(ControlFlow::Continue(()));
        }
        let electrical_before = run.electrical.clone();
        update_resistance::<C>(
            scene,
            evaluation.as_ref(),
            &before,
            &run.state,
            &mut run.electrical,
        );
        let change = Change {
            before: &electrical_before,
            after: &run.electrical,
        };
        let range = range::<C>(&before, &run.state);
        if let Some(RequiredAction::GoTo(sooner)) =
            resistance::required_action(scene, plan, range, change)
        {
            run.state = before;
            (run.electrical, until_limit) = (electrical_before, sooner);
            continue;
        }
        until_limit = u64::MAX;
        let worn = contact.worn(&run.state);
        scars = C::scars(&worn);
        let resistance = run.electrical.resistance.as_ref();
        let report = contact.report(scene, &run.state, &worn, resistance);
        run.compared.push(&report);
        run.life
            .push(scene, C::cycle(&run.state), |side| scars.of(side));
        push_life_by_resistance::<C>(scene, evaluation.as_ref(), &before, &electrical_before, run);
        if observer.on(Event::Cycle(&report)).is_break() {
            return Ok(STOPPED);
        }
        let depth = |side: Side, part| scars.of(side).depth_of_part(part);
        let end = stops::end(scene, progress(scene, contact, run), depth);
        let end = end.or_else(|| contact.ending());
        let cycle = C::cycle(&run.state);
        if end.is_some() || scene.output.snapshots_at_cycles.contains(&cycle) {
            let snapshot = contact.snapshot(scene, &run.state, worn)?;
            if observer.on(Event::Snapshot(&snapshot)).is_break() {
                return Ok(STOPPED);
            }
        }
        if let Some(outcome) = end {
            return Ok(ControlFlow::Break(outcome));
        }
        if observer.on(Event::Checkpoint(C::resumable(run))).is_break() {
            return Ok(STOPPED);
        }
    }
    Ok(ControlFlow::Break(Outcome::Completed))
}

/// Progress for its stops.
fn progress<C: Contact>(scene: &Scene, contact: &C, run: &Run<C::State, ()>) -> StopQuantities {
    let (cycles_left, worn_through) = contact.cycles_left();
    StopQuantities {
        cycle: C::cycle(&run.state),
        cycles_left,
        fastest_rate: C::fastest_rate(&run.state),
        worn_through,
        exceeds_resistance: resistance::exceeds_limit(scene, &run.electrical),
    }
}

/// The summary of a run with its outcome.
fn summary<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &C,
    run: &Run<C::State, ()>,
    outcome: Outcome,
) -> Summary {
    let worn = contact.worn(&run.state);
    Summary {
        outcome,
        initial: run.initial,
        resolution: contact.resolution(&run.state),
        checks: contact.checks(&run.state),
        last: contact.report(scene, &run.state, &worn, run.electrical.resistance.as_ref()),
        errors: None,
        warnings: Vec::new(),
        compared: run.compared.ended(plan.skipped_change(), &run.life),
        effects: plan.verdicts(),
        crossings: run.crossings.clone(),
        life: run.life.clone(),
        blocks: Vec::new(),
    }
}
