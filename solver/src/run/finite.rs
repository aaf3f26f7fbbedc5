//! The run of a contact of finite extent across the sliding direction, a point, a line or extruded bodies: cycles until it ends, with the events of the
//! run of a section. What its bodies are computed by is behind a trait.

mod extruded;
mod line;
mod point;
mod sections;

use std::ops::ControlFlow;

use super::computed::{UNLIMITED, cycle_after, elapsed_s};
use super::resistance::{self, Consequence};
use crate::SolveError;
use crate::checkpoint::{Earlier, ExtrudedRun, FiniteRun, LineRun, Misfit, PointRun, Resumable};
use crate::effects::EffectsPlan;
use crate::electrical::{AreaContact, ContactResistance, ElectricalState, Evaluation};
use crate::extruded::ExtrudedIntegrator;
use crate::observer::{Event, Observer, Phase};
use crate::point::PointIntegrator;
use crate::record::{
    Checks, Compared, CycleReport, Exposed, Initial, Life, Outcome, Resolution, Snapshot, Summary,
};
use crate::scene::{Dimension, Scene};
use crate::schedule::stops::{self, Progress};
use crate::sides::{Side, Sides};
use crate::station::LineIntegrator;

/// What computes the cycles of a contact of finite extent, with what a plan simulates.
trait Contact: Sized {
    /// State between two computed cycles.
    type State: Clone;
    /// Worn depths of both bodies, read once a cycle.
    type Worn;
    /// The scar of a body.
    type Scar: Exposed;

    /// The loaded contact before any wear.
    fn start(scene: &Scene, plan: &EffectsPlan) -> Result<(Self, Self::State), SolveError>;
    /// For a state, which takes the laws of the plan.
    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut Self::State,
    ) -> Result<Self, SolveError>;
    /// Computes the next cycle up to a number of them.
    fn compute_cycle(&mut self, state: &mut Self::State, until: u64) -> Result<(), SolveError>;

    fn cycle(state: &Self::State) -> u64;
    /// Largest worn depth of each side, mm.
    fn max_depth_mm(state: &Self::State) -> Sides<f64>;
    /// Largest wear of a place of each side per cycle, as equivalent depth, mm.
    fn fastest_rate(state: &Self::State) -> Sides<f64>;
    /// Cycles in which a body would be worn through, and whether one is.
    fn cycles_left(&self) -> (f64, bool);
    /// Why it cannot be worn on besides.
    fn ending(&self) -> Option<Outcome>;
    /// What its resistance depends on after a part of the cycles between two states, with no place deeper than limits, mm; none of a contact
    /// whose resistance is not computed.
    fn areas<'a>(
        before: &'a Self::State,
        after: &'a Self::State,
    ) -> Option<impl Fn(f64, Sides<f64>) -> AreaContact + 'a>;

    fn worn(&self, state: &Self::State) -> Self::Worn;
    fn scars(worn: &Self::Worn) -> Sides<Self::Scar>;
    fn report(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: &Self::Worn,
        resistance: Option<&ContactResistance>,
    ) -> CycleReport;
    fn snapshot(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: Self::Worn,
    ) -> Result<Snapshot, SolveError>;
    fn resolution(&self, state: &Self::State) -> Resolution;
    fn checks(&self, state: &Self::State) -> Checks;

    /// The run as that of a checkpoint.
    fn resumable(run: &FiniteRun<Self::State>) -> Resumable<'_>;
}

/// Solves a contact of finite extent by a plan, after earlier runs of it.
pub(super) fn begin(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: Earlier,
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
    earlier: Earlier,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Cycles);
    let (contact, state) = C::start(scene, plan)?;
    let mut electrical = ElectricalState::default();
    let evaluation = resistance::evaluation(scene, plan);
    let tools = (scene, evaluation.as_ref());
    update_resistance::<C>(tools, &mut electrical, (&state, &state));
    let worn = contact.worn(&state);
    let report = contact.report(scene, &state, &worn, electrical.resistance.as_ref());
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
        contact_resistance_mohm: electrical.total_mohm(),
    };
    let snapshot = contact.snapshot(scene, &state, worn)?;
    let mut run = FiniteRun {
        state,
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
        return Ok(summary((scene, plan, &contact), &run, Outcome::Stopped));
    }
    advance((scene, plan.clone()), contact, run, observer)
}

fn proceed<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    mut run: FiniteRun<C::State>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let (cycle, cycles) = (C::cycle(&run.state), scene.cycles);
    if cycle > cycles {
        return Err(Misfit::Beyond { cycle, cycles }.into());
    }
    observer.on_phase(Phase::Cycles);
    let plan = plan.after(&run.crossings);
    let contact = C::resume(scene, &plan, &mut run.state)?;
    advance((scene, plan), contact, run, observer)
}

/// Computes cycles until the run ends; where it calls for an effect that was skipped, it goes on from the cycle before with it.
fn advance<C: Contact>(
    (scene, mut plan): (&Scene, EffectsPlan),
    mut contact: C,
    mut run: FiniteRun<C::State>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        let flow = integrate((scene, &plan, &mut contact), &mut run, observer)?;
        match flow {
            ControlFlow::Break(outcome) => {
                return Ok(summary((scene, &plan, &contact), &run, outcome));
            }
            ControlFlow::Continue(()) => plan = plan.after(&run.crossings),
        }
        contact = C::resume(scene, &plan, &mut run.state)?;
    }
}

/// Computes cycles until the run ends (`Break`) or calls for an effect (`Continue`).
fn integrate<C: Contact>(
    (scene, plan, contact): (&Scene, &EffectsPlan, &mut C),
    run: &mut FiniteRun<C::State>,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let evaluation = resistance::evaluation(scene, plan);
    let tools = (scene, evaluation.as_ref());
    // Where a limit of the resistance was passed by too much.
    let mut until_limit = u64::MAX;
    let mut scars = C::scars(&contact.worn(&run.state));
    while C::cycle(&run.state) < scene.cycles {
        let before = run.state.clone();
        let now = progress(scene, contact, run);
        let until = stops::next(scene, now, |side, part| scars.of(side).depth_of_part(part));
        contact.compute_cycle(&mut run.state, until.min(until_limit))?;
        let cycles = (C::cycle(&before), C::cycle(&run.state));
        let called_for = plan.crossed(scene, cycles, C::max_depth_mm(&run.state));
        if !called_for.is_empty() {
            run.state = before;
            run.crossings.extend(called_for);
            return Ok(ControlFlow::Continue(()));
        }
        let electrical_before = run.electrical.clone();
        update_resistance::<C>(tools, &mut run.electrical, (&before, &run.state));
        let resistances = (&electrical_before, &run.electrical);
        if let Some(Consequence::GoTo(sooner)) =
            resistance::consequence(scene, plan, cycles, resistances)
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
        push_life_by_resistance::<C>(tools, run, (&before, &electrical_before));
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

/// Takes the contact after a computed cycle into the resistance, if it is evaluated; from the states before and after the cycle.
fn update_resistance<C: Contact>(
    (scene, evaluation): (&Scene, Option<&Evaluation<'_>>),
    electrical: &mut ElectricalState,
    (before, after): (&C::State, &C::State),
) {
    let (Some(evaluation), Some(areas)) = (evaluation, C::areas(before, after)) else {
        return;
    };
    let cycles = (C::cycle(before), C::cycle(after));
    evaluation.update(electrical, |part| {
        let time_s = elapsed_s(scene, cycle_after(cycles, part));
        evaluation.area(&areas(part, UNLIMITED), time_s)
    });
}

/// Takes a computed cycle into the lives by the resistance, if it is evaluated; from the states before the cycle.
fn push_life_by_resistance<C: Contact>(
    (scene, evaluation): (&Scene, Option<&Evaluation<'_>>),
    run: &mut FiniteRun<C::State>,
    (before, electrical): (&C::State, &ElectricalState),
) {
    let (Some(evaluation), Some(areas)) = (evaluation, C::areas(before, &run.state)) else {
        return;
    };
    let cycles = (C::cycle(before), C::cycle(&run.state));
    let (tools, states) = ((scene, evaluation), (electrical, &run.electrical));
    resistance::push_life(tools, cycles, states, &mut run.life, |part, limits| {
        let time_s = elapsed_s(scene, cycle_after(cycles, part));
        evaluation.area(&areas(part, limits), time_s)
    });
}

/// Its progress for its stops.
fn progress<C: Contact>(scene: &Scene, contact: &C, run: &FiniteRun<C::State>) -> Progress {
    let (cycles_left, worn_through) = contact.cycles_left();
    Progress {
        cycle: C::cycle(&run.state),
        cycles_left,
        fastest_rate: C::fastest_rate(&run.state),
        worn_through,
        exceeds_resistance: resistance::exceeds_limit(scene, &run.electrical),
    }
}

/// The summary of a run with its outcome.
fn summary<C: Contact>(
    (scene, plan, contact): (&Scene, &EffectsPlan, &C),
    run: &FiniteRun<C::State>,
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
