//! The run: integrate until the geometry has drifted or the contact has outgrown its mesh, relocate, condense again. One loop drives the
//! contact of every dimension (`contact`).

mod contact;
mod deliver;
mod load;
mod mission;
mod progress;
mod resistance;
mod step;
mod summary;

use std::ops::ControlFlow;

use crate::SolveError;
use crate::checkpoint::{Checkpoint, CheckpointMismatch, EarlierRuns};
use crate::effects::{self, EffectsPlan};
use crate::extruded::ExtrudedIntegrator;
use crate::observer::{Observer, Phase};
use crate::point::PointIntegrator;
use crate::record::{Outcome, Summary};
use crate::scene::{Dimension, Scene};
use crate::station::LineIntegrator;
use contact::plane::Plane;
use contact::{Bodies, Contact, RunOf, RunOfContact};
use deliver::deliver;
use load::{Loaded, load_unworn};
use resistance::{RequiredAction, Resistance};
use step::{RequiredUpdate, Step, step};
use summary::summary;

/// Solves a scene from the unworn bodies to its end.
///
/// # Errors
/// [`SolveError`]; events delivered before it stay valid.
pub fn solve(scene: &Scene, observer: &mut dyn Observer) -> Result<Summary, SolveError> {
    let (plan, earlier) = (effects::plan(scene), EarlierRuns::default());
    by_plan(scene, &plan, None, &earlier, observer)
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
    let (plan, earlier) = (effects::plan(scene), EarlierRuns::default());
    by_plan(scene, &plan, Some(run), &earlier, observer)
}

/// Solves a scene by a plan: from a checkpoint if there is one, else after earlier runs of it.
pub(crate) fn by_plan(
    scene: &Scene,
    plan: &EffectsPlan,
    from: Option<Checkpoint>,
    earlier: &EarlierRuns,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    match (scene.dimension, from) {
        (Dimension::PlaneStrain, None) => begin::<Plane>(scene, plan, earlier, observer),
        (Dimension::PlaneStrain, Some(Checkpoint::Section(run))) => {
            proceed::<Plane>(scene, plan, *run, observer)
        }
        (Dimension::Point(_), None) => begin::<PointIntegrator>(scene, plan, earlier, observer),
        (Dimension::Point(_), Some(Checkpoint::Point(run))) => {
            proceed::<PointIntegrator>(scene, plan, *run, observer)
        }
        (Dimension::Line(_), None) => begin::<LineIntegrator>(scene, plan, earlier, observer),
        (Dimension::Line(_), Some(Checkpoint::Line(run))) => {
            proceed::<LineIntegrator>(scene, plan, *run, observer)
        }
        (Dimension::Extruded(_), None) => {
            begin::<ExtrudedIntegrator>(scene, plan, earlier, observer)
        }
        (Dimension::Extruded(_), Some(Checkpoint::Extruded(run))) => {
            proceed::<ExtrudedIntegrator>(scene, plan, *run, observer)
        }
        _ => Err(CheckpointMismatch::Dimension.into()),
    }
}

/// Solves a scene by a plan, after earlier runs of it.
fn begin<B: Bodies>(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: &EarlierRuns,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    if !B::HAS_PHASES {
        observer.on_phase(Phase::Cycles);
    }
    let loaded = load_unworn::<B>(scene, plan, observer)?;
    let Loaded {
        plan,
        mut bodies,
        mut run,
        flow,
    } = loaded;
    run.earlier = earlier.clone();
    if flow.is_break() {
        let contact = bodies.contact(scene);
        return Ok(summary(scene, &plan, &contact, &run, Outcome::Stopped));
    }
    advance(scene, plan, bodies, run, observer)
}

/// Solves a scene by a plan from a checkpoint to its end.
fn proceed<B: Bodies>(
    scene: &Scene,
    plan: &EffectsPlan,
    mut run: RunOf<B>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let (cycle, cycles) = (<B::Contact<'_>>::cycle(&run.state), scene.cycles);
    if cycle > cycles {
        return Err(CheckpointMismatch::Beyond { cycle, cycles }.into());
    }
    if !B::HAS_PHASES {
        observer.on_phase(Phase::Cycles);
    }
    let plan = plan.after(&run.crossings);
    let bodies = B::resumed(scene, &plan, &mut run.state, observer)?;
    advance(scene, plan, bodies, run, observer)
}

/// Integrates until the run ends, and before that updates what its next cycle requires.
fn advance<B: Bodies>(
    scene: &Scene,
    mut plan: EffectsPlan,
    mut bodies: B,
    mut run: RunOf<B>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let blocks = scene.blocks();
    loop {
        if B::HAS_PHASES {
            observer.on_phase(Phase::Cycles);
        }
        let mut contact = bodies.contact(&blocks[run.block()]);
        let required = match integrate(scene, &plan, &mut contact, &mut run, observer)? {
            ControlFlow::Break(outcome) => {
                return Ok(summary(scene, &plan, &contact, &run, outcome));
            }
            ControlFlow::Continue(required) => required,
        };
        match required {
            RequiredUpdate::Block => {
                let worn = contact.worn(&run.state);
                mission::next_block(scene, &contact, &mut run, &worn);
            }
            RequiredUpdate::Effects => {
                drop(contact);
                plan = plan.after(&run.crossings);
                bodies = bodies.with_effects(scene, &plan, Some(&mut run.state), observer)?;
            }
            RequiredUpdate::Stiffness => {
                drop(contact);
                bodies = bodies.renewed(scene, &mut run.state, observer)?;
            }
        }
    }
}

/// Computes cycles until the run ends (`Break`), or needs something else before its next cycle (`Continue`).
fn integrate<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &mut C,
    run: &mut RunOfContact<C>,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome, RequiredUpdate>, SolveError> {
    let resistance = Resistance::of(scene, plan);
    // Where a limit of the resistance was passed by too much.
    let mut until_limit = u64::MAX;
    let mut worn = contact.worn(&run.state);
    while C::cycle(&run.state) < scene.cycles {
        let before = match step(scene, plan, contact, run, &worn, until_limit)? {
            Step::Cycle(before) => before,
            Step::MotionChanged => continue,
            Step::Update(update) => return Ok(ControlFlow::Continue(update)),
        };
        let electrical = run.electrical.clone();
        match resistance.update(contact, run, &before, &electrical) {
            None => {}
            Some(RequiredAction::GoTo(sooner)) => {
                C::restore(&mut run.state, before);
                (run.electrical, until_limit) = (electrical, sooner);
                continue;
            }
            Some(RequiredAction::Effects(required)) => {
                run.electrical = electrical;
                run.go_back(before, required);
                return Ok(ControlFlow::Continue(RequiredUpdate::Effects));
            }
        }
        until_limit = u64::MAX;
        worn = contact.worn(&run.state);
        let surface = |side| contact.surface(&run.state, &worn, side);
        run.life.push(scene, C::cycle(&run.state), surface);
        resistance.push_life(contact, run, &before, &electrical);
        let delivered = deliver(scene, contact, run, &worn, observer)?;
        if let ControlFlow::Break(outcome) = delivered {
            return Ok(ControlFlow::Break(outcome));
        }
    }
    Ok(ControlFlow::Break(Outcome::Completed))
}

#[cfg(test)]
mod tests;
