//! Error control: the difference of a run from coarse companions estimates its error, and a run outside its tolerance
//! begins anew, finer.
//!
//! After the run four companions solve the scene: one that is coarser than the tolerance's settings in mesh, increments and
//! cycle jumps, and three of which each is coarser in one more of them. The run's difference from the first gives its
//! error, the differences between the companions the shares of mesh, increments and jumps in it. A run whose estimated
//! error exceeds the tolerance begins anew once, with the settings refined that cause it; one that is still outside, or
//! whose settings the user has given, says so in its warnings, and in its outcome where it has done all cycles. Where the
//! finer run has no solution, the first one is solved again.
//!
//! What the companions are compared by is part of the checkpoint, so that a resumed run makes the same choices.

mod balance;
mod companions;
mod estimate;

pub use companions::companion_scenes;

use crate::SolveError;
use crate::checkpoint::{Checkpoint, Earlier, Finished};
use crate::observer::{Event, Observer, Phase};
use crate::record::{Errors, Outcome, Quantity, Summary};
use crate::run;
use crate::scene::{Refinement, Scene};

/// Solves a scene from the unworn bodies to its end, with an estimate of the error.
///
/// # Errors
/// [`SolveError`]; events delivered before it stay valid. A companion without a solution is no error.
pub fn solve(scene: &Scene, observer: &mut dyn Observer) -> Result<Summary, SolveError> {
    control(scene, None, observer)
}

/// Solves a scene from a checkpoint of it to its end, to the same bits as an undisturbed run; only events after the
/// checkpoint are delivered.
///
/// # Errors
/// [`SolveError`], among others if the checkpoint is not one of this scene.
pub fn resume(
    scene: &Scene,
    from: Checkpoint,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    control(scene, Some(from), observer)
}

fn control(
    scene: &Scene,
    mut from: Option<Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    if !scene.accuracy.estimate_errors {
        return one_run(scene, from, Earlier::default(), observer);
    }
    let mut earlier = from
        .as_ref()
        .map_or_else(Earlier::default, |from| from.earlier.clone());
    if earlier.runs.is_empty() {
        let done = one_run(scene, from.take(), earlier.clone(), observer)?;
        if done.outcome == Outcome::Stopped {
            return Ok(done);
        }
        let mut done = done;
        earlier.runs.push(Some(std::mem::take(&mut done.compared)));
        earlier.finished = Some(Box::new(Finished::new(done)));
    }
    if earlier.finished.is_some() {
        observer.on_phase(Phase::Companions);
    }
    while let Some(refinement) = companions::refinement(earlier.runs.len() - 1) {
        // Nothing can be compared with the first.
        if earlier.runs.get(1) == Some(&None) {
            break;
        }
        let companion = companions::scene(scene, refinement);
        let quiet = &mut companions::Quiet { observer };
        match one_run(&companion, from.take(), earlier.clone(), quiet) {
            Ok(done) if done.outcome == Outcome::Stopped => return Ok(done),
            Ok(done) => earlier.runs.push(Some(done.compared)),
            Err(SolveError::Checkpoint(misfit)) => return Err(misfit.into()),
            Err(_) => earlier.runs.push(None),
        }
    }
    let run = earlier.runs.first().and_then(Option::as_ref);
    let errors =
        run.and_then(|run| estimate::errors(scene, &earlier.runs[1..], run, Refinement::NONE));
    if let Some(finished) = earlier.finished.take() {
        let mut done = finished.into_summary();
        state_errors(&mut done, errors, scene.accuracy.tolerance);
        let worth = errors.is_some_and(|errors| balance::is_worth_a_restart(scene, &errors));
        if !worth {
            return Ok(done);
        }
        if observer
            .on(Event::Restart(&done.warnings.join("; ")))
            .is_break()
        {
            done.outcome = Outcome::Stopped;
            return Ok(done);
        }
    }
    let refinement = errors.map_or(Refinement::NONE, |errors| balance::finer(scene, &errors));
    let is_finer_possible = earlier.runs.len() == 1 + companions::COUNT;
    if is_finer_possible {
        let refined = companions::refined(scene, refinement);
        match one_run(&refined, from.take(), earlier.clone(), observer) {
            Ok(done) if done.outcome == Outcome::Stopped => return Ok(done),
            Ok(mut done) => {
                let (companions, run) = (&earlier.runs[1..], &done.compared);
                let errors = estimate::errors(scene, companions, run, refinement);
                state_errors(&mut done, errors, scene.accuracy.tolerance);
                return Ok(done);
            }
            Err(SolveError::Checkpoint(misfit)) => return Err(misfit.into()),
            Err(error) => {
                let reason = format!("the finer run has no solution: {error}");
                if observer.on(Event::Restart(&reason)).is_break() {
                    return Err(error);
                }
            }
        }
        earlier.runs.push(None);
    }
    let mut done = one_run(scene, from.take(), earlier, observer)?;
    if done.outcome != Outcome::Stopped {
        state_errors(&mut done, errors, scene.accuracy.tolerance);
        done.warnings.push("a finer run has no solution".to_owned());
    }
    Ok(done)
}

/// One of the runs of a scene, from its checkpoint if there is one.
fn one_run(
    scene: &Scene,
    from: Option<Checkpoint>,
    earlier: Earlier,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    match from {
        Some(from) => run::resume(scene, from, observer),
        None => run::begin(scene, earlier, observer),
    }
}

/// Sets the errors of a run, and its outcome and warnings where they exceed the tolerance.
fn state_errors(done: &mut Summary, errors: Option<Errors>, tolerance: f64) {
    done.errors = errors;
    let Some(errors) = errors else {
        done.warnings
            .push("errors are not estimated: a coarse companion has no solution".to_owned());
        return;
    };
    for quantity in errors.outside(tolerance) {
        let name = match quantity {
            Quantity::WornDepth => "worn depth",
            Quantity::ScarHalfWidth => "scar width",
            Quantity::WornArea => "worn area",
            Quantity::PeakPressure => "peak pressure",
        };
        let error = errors.parts(quantity).relative;
        let allowed = quantity.allowed(tolerance);
        done.warnings.push(format!(
            "the estimated error of the {name} is {:.2} %, the tolerance allows {:.2} %",
            100.0 * error,
            100.0 * allowed
        ));
        if balance::is_decisive(quantity) && done.outcome == Outcome::Completed {
            done.outcome = Outcome::OutsideTolerance;
        }
    }
}
