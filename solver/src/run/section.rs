//! The run of a plane section.

mod computed;
mod load;
mod progress;
mod resistance;
mod snapshot;
mod step;
mod summary;

use std::ops::ControlFlow;

use crate::SolveError;
use crate::ale::{self, Spines};
use crate::change::Change;
use crate::checkpoint::{CheckpointMismatch, EarlierRuns, Resumable, SectionRun};
use crate::condensation::{self, Condensed};
use crate::cycle::{BlockWear, CycleRecord, Integrator};
use crate::effects::EffectsPlan;
use crate::model::{self, Model};
use crate::observer::{Event, Observer, Phase};
use crate::record::{self, Exposed, Outcome, Summary};
use crate::scene::Scene;
use computed::Computed;
use load::{Loaded, load_unworn};
use progress::{end, progress};
use resistance::RequiredAction;
use snapshot::snapshot;
use step::{RequiredUpdate, Step, step};
use summary::summary;

/// Solves a scene by a plan, after earlier runs of it.
pub(super) fn begin(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: EarlierRuns,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let loaded = load_unworn(scene, plan, observer)?;
    let Loaded {
        plan,
        model,
        condensed,
        mut run,
        flow,
    } = loaded;
    run.earlier = earlier;
    match flow {
        ControlFlow::Continue(()) => advance(scene, plan, model, condensed, run, observer),
        ControlFlow::Break(()) => Ok(summary(scene, &plan, &model, &run, Outcome::Stopped)),
    }
}

/// Solves a scene by a plan from a checkpoint to its end.
pub(super) fn proceed(
    scene: &Scene,
    plan: &EffectsPlan,
    run: SectionRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Mesh);
    let plan = plan.after(&run.crossings);
    let unworn = model::build(scene, &plan)?;
    let (cycle, cycles) = (run.state.cycle_state.cycle, scene.cycles);
    if cycle > cycles {
        return Err(CheckpointMismatch::Beyond { cycle, cycles }.into());
    }
    run.state.check(&unworn)?;
    let model = run.state.model(&unworn)?;
    observer.on_phase(Phase::Condense);
    let condensed = condensation::condense(&model, scene.threads)?;
    advance(scene, plan, model, condensed, run, observer)
}

/// Integrates, relocates and condenses until the run ends.
fn advance(
    scene: &Scene,
    mut plan: EffectsPlan,
    mut model: Model,
    mut condensed: Condensed,
    mut run: SectionRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        observer.on_phase(Phase::Cycles);
        let flow = integrate(scene, &plan, &model, &condensed, &mut run, observer)?;
        match flow {
            ControlFlow::Break(outcome) => {
                return Ok(summary(scene, &plan, &model, &run, outcome));
            }
            ControlFlow::Continue(RequiredUpdate::Effects) => {
                plan = plan.after(&run.crossings);
                model.follow(scene, &plan);
                continue;
            }
            ControlFlow::Continue(RequiredUpdate::Motion) => {
                next_block(scene, &model, &mut run);
                continue;
            }
            ControlFlow::Continue(RequiredUpdate::Stiffness) => {}
        }
        observer.on_phase(Phase::Relocate);
        run.state.relocated();
        let moved = run.state.model(&model)?;
        observer.on_phase(Phase::Condense);
        condensed = condensation::renew(&moved, &model, condensed, scene.threads)?;
        model = moved;
    }
}

/// Computes cycles until the run ends (`Break`), or needs something else before its next cycle (`Continue`).
fn integrate(
    scene: &Scene,
    plan: &EffectsPlan,
    model: &Model,
    condensed: &Condensed,
    run: &mut SectionRun,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome, RequiredUpdate>, SolveError> {
    let blocks = scene.blocks();
    let block = &blocks[run.block()];
    let mut integrator = Integrator::new(block, model, &condensed.operators);
    let evaluation = resistance::evaluation(scene, plan);
    // Where a limit of the resistance was passed by too much.
    let mut until_limit = u64::MAX;
    while run.state.cycle_state.cycle < scene.cycles {
        if run.is_block_done(run.state.cycle_state.cycle) {
            return Ok(ControlFlow::Continue(RequiredUpdate::Motion));
        }
        if model.relocates && ale::has_drifted(model, &run.state.cycle_state.depth, &scene.accuracy)
        {
            return Ok(ControlFlow::Continue(RequiredUpdate::Stiffness));
        }
        let left = run.block_left().map(|left| blocks[left].motion);
        let step = step(scene, plan, model, &mut integrator, run, left, until_limit)?;
        let (before, record) = match step {
            Step::Cycle(before, record) => (*before, *record),
            Step::MotionChanged => continue,
            Step::Update(update) => return Ok(ControlFlow::Continue(update)),
        };
        let electrical = run.electrical.clone();
        if let Some(evaluation) = &evaluation {
            match resistance::update(evaluation, scene, plan, model, condensed, run, &before) {
                None => {}
                Some(RequiredAction::GoTo(sooner)) => {
                    until_limit = sooner;
                    continue;
                }
                Some(RequiredAction::Effects(required)) => {
                    run.state.cycle_state = before;
                    run.crossings.extend(required);
                    return Ok(ControlFlow::Continue(RequiredUpdate::Effects));
                }
            }
        }
        until_limit = u64::MAX;
        let surface = |side| record::worn_surface(model, &run.state.cycle_state, side);
        run.life.push(scene, run.state.cycle_state.cycle, surface);
        if let Some(evaluation) = &evaluation {
            let computed = Computed {
                evaluation,
                scene,
                model,
                condensed,
                before: &before,
                after: &run.state.cycle_state,
            };
            let change = Change {
                before: &electrical,
                after: &run.electrical,
            };
            resistance::push_life_of_section(computed, change, &mut run.life);
        }
        let end = end(scene, model, &integrator.spines, run);
        let delivered = deliver(scene, model, condensed, run, record, end, observer)?;
        if let ControlFlow::Break(outcome) = delivered {
            return Ok(ControlFlow::Break(outcome));
        }
    }
    Ok(ControlFlow::Break(Outcome::Completed))
}

/// Delivers what a computed cycle led to; `Break` where the run ends with it or is stopped.
fn deliver(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    run: &mut SectionRun,
    record: CycleRecord,
    end: Option<Outcome>,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let report = record::report(
        scene,
        model,
        &run.state.cycle_state,
        run.electrical.resistance,
    );
    if run.is_comparable(scene, report.cycle) {
        run.compared.push(&report);
    }
    if observer.on(Event::Cycle(&report)).is_break() {
        return Ok(STOPPED);
    }
    let state = &run.state.cycle_state;
    if end.is_some() || scene.output.snapshots_at_cycles.contains(&state.cycle) {
        let snapshot = snapshot(scene, model, condensed, state, record)?;
        if observer.on(Event::Snapshot(&snapshot)).is_break() {
            return Ok(STOPPED);
        }
    }
    if let Some(outcome) = end {
        return Ok(ControlFlow::Break(outcome));
    }
    Ok(match observer.on(checkpoint(run)) {
        ControlFlow::Break(()) => STOPPED,
        ControlFlow::Continue(()) => ControlFlow::Continue(()),
    })
}

/// The event of a state that the run can be resumed from.
fn checkpoint(run: &SectionRun) -> Event<'_> {
    Event::Checkpoint(Resumable::Section(run))
}

/// Moves on to the next block of a mission.
fn next_block(scene: &Scene, model: &Model, run: &mut SectionRun) {
    let spines = Spines::of(model);
    let Some(mission) = &mut run.mission else {
        return;
    };
    let state = &mut run.state.cycle_state;
    let totals = BlockWear::total(state, &model.interface.wear);
    let now = progress(model, &spines, state, mission.end_block(scene, totals));
    let leaves = state.take_motion_history();
    let depth = |side, part| record::worn_surface(model, state, side).depth_of_part(part);
    if let Some(history) = mission.begin_block(scene, now, depth, leaves) {
        state.continue_motion(history);
    }
}
