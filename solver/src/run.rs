//! The run: integrate until the geometry has drifted, relocate, condense again.

use std::ops::ControlFlow;

use crate::SolveError;
use crate::ale::{self, Spines};
use crate::checkpoint::Checkpoint;
use crate::condensation::{self, Condensed};
use crate::cycle::{self, CycleRecord, CycleState, Integrator};
use crate::fields;
use crate::history::{CycleReport, Initial, Outcome, Resolution, Snapshot, Summary};
use crate::model::{self, Model};
use crate::number::count_at_least;
use crate::observer::{Event, Observer, Phase};
use crate::scene::{Scene, StopCondition};

/// Solves a scene from the unworn bodies to its end.
///
/// # Errors
/// [`SolveError`]; events delivered before it stay valid.
pub fn solve(scene: &Scene, observer: &mut dyn Observer) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Mesh);
    let model = model::build(scene)?;
    observer.on_phase(Phase::Condense);
    let condensed = condensation::condense(&model)?;
    let (run, flow) = load(scene, &model, &condensed, observer)?;
    match flow {
        ControlFlow::Continue(()) => advance(scene, model, condensed, run, observer),
        ControlFlow::Break(()) => Ok(summary(scene, &model, &run, Outcome::Stopped)),
    }
}

/// Solves a scene from a checkpoint of it to its end, to the same bits as an undisturbed run; only events after the
/// checkpoint are delivered.
///
/// # Errors
/// [`SolveError`], among others if the checkpoint is not one of this scene.
pub fn resume(
    scene: &Scene,
    run: Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Mesh);
    let unworn = model::build(scene)?;
    run.check(&unworn, scene.cycles)?;
    let model = run.model(unworn)?;
    observer.on_phase(Phase::Condense);
    let condensed = condensation::condense(&model)?;
    advance(scene, model, condensed, run, observer)
}

/// Integrates, relocates and condenses until the run ends.
fn advance(
    scene: &Scene,
    mut model: Model,
    mut condensed: Condensed,
    mut run: Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        observer.on_phase(Phase::Cycles);
        let flow = integrate(scene, &model, &condensed, &mut run, observer)?;
        if let ControlFlow::Break(outcome) = flow {
            return Ok(summary(scene, &model, &run, outcome));
        }
        observer.on_phase(Phase::Relocate);
        let moved = ale::relocate(&model, &run.state)?;
        run.relocated();
        observer.on_phase(Phase::Condense);
        condensed = condensation::renew(&moved, &model, condensed)?;
        model = moved;
    }
}

/// Cycle 0: the unworn, loaded state.
fn load(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    observer: &mut dyn Observer,
) -> Result<(Checkpoint, ControlFlow<()>), SolveError> {
    let mut state = CycleState::start(&condensed.operators);
    let mut integrator = Integrator::new(scene, model, &condensed.operators);
    let record = integrator.apply_load(&mut state)?;
    let report = cycle::report(scene, model, &state);
    let mut flow = observer.on(Event::Cycle(&report));
    if flow.is_continue() {
        let snapshot = snapshot(scene, model, condensed, &state, record)?;
        flow = observer.on(Event::Snapshot(&snapshot));
    }
    integrator.initial_quarter(&mut state)?;
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
    };
    let run = Checkpoint {
        state,
        initial,
        built: None,
        relocations: 0,
    };
    Ok((run, flow))
}

/// Computes cycles until the run ends (`Break`) or the geometry has drifted (`Continue`).
fn integrate(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    run: &mut Checkpoint,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let mut integrator = Integrator::new(scene, model, &condensed.operators);
    let spines = Spines::of(model);
    while run.state.cycle < scene.cycles {
        if ale::has_drifted(model, &run.state, scene.accuracy.tolerance) {
            return Ok(ControlFlow::Continue(()));
        }
        let state = &mut run.state;
        let record = integrator.compute_cycle(state, next_stop(scene, &spines, state))?;
        let report = cycle::report(scene, model, state);
        if observer.on(Event::Cycle(&report)).is_break() {
            return Ok(STOPPED);
        }
        let end = end_of(scene, &spines, state, &report);
        if end.is_some() || scene.output.snapshots_at_cycles.contains(&state.cycle) {
            let snapshot = snapshot(scene, model, condensed, state, record)?;
            if observer.on(Event::Snapshot(&snapshot)).is_break() {
                return Ok(STOPPED);
            }
        }
        if let Some(outcome) = end {
            return Ok(ControlFlow::Break(outcome));
        }
        if observer.on(Event::Checkpoint(run)).is_break() {
            return Ok(STOPPED);
        }
    }
    Ok(ControlFlow::Break(Outcome::Completed))
}

/// The next cycle that must be hit exactly, or beyond which the depths of stop conditions and of the bodies
/// themselves would be passed at the present rate.
fn next_stop(scene: &Scene, spines: &Spines, state: &CycleState) -> u64 {
    let snapshots = &scene.output.snapshots_at_cycles;
    let next = snapshots
        .iter()
        .copied()
        .find(|&at| at > state.cycle)
        .unwrap_or(scene.cycles);
    let deepest = |depth: &[f64]| depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    let worn = deepest(&state.receptacle_depth).max(deepest(&state.slider_depth));
    let limits = scene
        .stop
        .iter()
        .map(|StopCondition::WornDepth(limit)| limit - worn);
    let left = limits.fold(spines.least_left_mm(state), f64::min);
    let cycles = left / state.jump.fastest_rate().max(f64::MIN_POSITIVE);
    let reach = u64::try_from(count_at_least(cycles.floor())).unwrap_or(u64::MAX);
    next.min(scene.cycles)
        .min(state.cycle.saturating_add(reach))
}

fn end_of(
    scene: &Scene,
    spines: &Spines,
    state: &CycleState,
    report: &CycleReport,
) -> Option<Outcome> {
    let deepest = report
        .receptacle
        .max_depth_mm
        .max(report.slider.max_depth_mm);
    let stopped = scene.stop.iter().any(|condition| match condition {
        StopCondition::WornDepth(limit) => deepest >= *limit,
    });
    if stopped {
        Some(Outcome::StopCondition)
    } else if spines.are_worn_through(state) {
        Some(Outcome::WornThrough)
    } else {
        (state.cycle >= scene.cycles).then_some(Outcome::Completed)
    }
}

fn snapshot(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    state: &CycleState,
    record: CycleRecord,
) -> Result<Snapshot, SolveError> {
    let fields = if scene.output.fields {
        fields::placed(model, condensed, state, &record.contacts)?
    } else {
        Vec::new()
    };
    Ok(cycle::snapshot(model, state, record, fields))
}

fn summary(scene: &Scene, model: &Model, run: &Checkpoint, outcome: Outcome) -> Summary {
    let state = &run.state;
    let last = cycle::report(scene, model, state);
    let mut checks = state.checks;
    checks.worn_area = cycle::worn_area_residual(model, state, &last);
    Summary {
        outcome,
        initial: run.initial,
        resolution: Resolution {
            contact_element_mm: model.sizes.contact_element,
            contact_elements: model.receptacle.contact_x().len() - 1,
            increments_per_cycle: u32::try_from(state.most_increments).unwrap_or(u32::MAX),
            computed_cycles: state.computed_cycles,
            increments: state.increments,
            dofs: model.slider.dofs() + model.receptacle.dofs(),
            relocations: run.relocations,
            estimated_relative_error: state.jump.mean_error(),
        },
        last,
        checks,
    }
}
