//! The run: integrate until the geometry has drifted, relocate, condense again.

use crate::SolveError;
use crate::ale::{self, Spines};
use crate::checkpoint::Checkpoint;
use crate::condensation::{self, Condensed};
use crate::cycle::{CycleRecord, CycleState, Integrator};
use crate::fields;
use crate::model::{self, Model};
use crate::number::count_at_least;
use crate::observer::{Event, Flow, Observer, Phase};
use crate::record::{self, CycleReport, Initial, Outcome, Resolution, Snapshot, Summary};
use crate::scene::{Scene, StopCondition};

/// Solves a scene from the unworn bodies to its end, telling the observer what happens.
///
/// # Errors
/// [`SolveError`]; everything told to the observer before stays true.
pub fn solve(scene: &Scene, observer: &mut dyn Observer) -> Result<Summary, SolveError> {
    observer.on(Event::Phase(Phase::Mesh));
    let model = model::build(scene)?;
    observer.on(Event::Phase(Phase::Condense));
    let condensed = condensation::condense(&model)?;
    let run = load(scene, &model, &condensed, observer)?;
    go_on(scene, model, condensed, run, observer)
}

/// Solves a scene from a checkpoint of it to its end, to the same bits as an undisturbed run; the observer is told what
/// follows the checkpoint.
///
/// # Errors
/// [`SolveError`], among others if the checkpoint is not one of this scene.
pub fn resume(
    scene: &Scene,
    run: Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on(Event::Phase(Phase::Mesh));
    let unworn = model::build(scene)?;
    run.check(&unworn, scene.cycles)?;
    let model = run.model(unworn)?;
    observer.on(Event::Phase(Phase::Condense));
    let condensed = condensation::condense(&model)?;
    go_on(scene, model, condensed, run, observer)
}

/// Integrates, relocates and condenses until the run ends.
fn go_on(
    scene: &Scene,
    mut model: Model,
    mut condensed: Condensed,
    mut run: Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        observer.on(Event::Phase(Phase::Cycles));
        let end = integrate(scene, &model, &condensed, &mut run, observer)?;
        if let Some(outcome) = end {
            return Ok(summary(scene, &model, &run, outcome));
        }
        observer.on(Event::Phase(Phase::Relocate));
        let moved = ale::relocate(&model, &run.state)?;
        run.relocated();
        observer.on(Event::Phase(Phase::Condense));
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
) -> Result<Checkpoint, SolveError> {
    let mut state = CycleState::start(&condensed.operators);
    let mut integrator = Integrator::new(scene, model, &condensed.operators);
    let record = integrator.apply_load(&mut state)?;
    let report = record::report(scene, model, &state);
    observer.on(Event::Cycle(&report));
    observer.on(Event::Snapshot(&snapshot(
        scene, model, condensed, &state, record,
    )?));
    integrator.initial_quarter(&mut state)?;
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
    };
    Ok(Checkpoint {
        state,
        initial,
        built: None,
        relocations: 0,
    })
}

/// Computed cycles until the run ends (an outcome) or the geometry has drifted (none).
fn integrate(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    run: &mut Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Option<Outcome>, SolveError> {
    let mut integrator = Integrator::new(scene, model, &condensed.operators);
    let spines = Spines::of(model);
    while run.state.cycle < scene.cycles {
        if ale::has_drifted(model, &run.state, scene.accuracy.tolerance) {
            return Ok(None);
        }
        let state = &mut run.state;
        let record = integrator.compute_cycle(state, next_stop(scene, &spines, state))?;
        let report = record::report(scene, model, state);
        let ended = end_of(scene, &spines, state, &report);
        let flow = observer.on(Event::Cycle(&report));
        if ended.is_some() || scene.output.snapshots_at_cycles.contains(&state.cycle) {
            let snapshot = snapshot(scene, model, condensed, state, record)?;
            observer.on(Event::Snapshot(&snapshot));
        }
        if ended.is_some() {
            return Ok(ended);
        }
        if flow == Flow::Stop || observer.on(Event::Checkpoint(run)) == Flow::Stop {
            return Ok(Some(Outcome::Stopped));
        }
    }
    Ok(Some(Outcome::Completed))
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
    Ok(record::snapshot(model, state, record, fields))
}

fn summary(scene: &Scene, model: &Model, run: &Checkpoint, outcome: Outcome) -> Summary {
    let state = &run.state;
    let last = record::report(scene, model, state);
    let mut checks = state.checks;
    checks.worn_area = record::worn_area_residual(model, state, &last);
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
