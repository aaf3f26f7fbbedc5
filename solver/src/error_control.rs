//! Error control: the difference of a run from coarse companions estimates its error, and a run outside its tolerance
//! restarts, finer.
//!
//! After the run four companions solve the scene: one that is coarser than the tolerance's settings in mesh, increments and
//! cycle jumps, and three of which each is coarser in one more of them. The run's difference from the first gives its
//! error, the differences between the companions the shares of mesh, increments and jumps in it. A run whose estimated
//! error exceeds the tolerance restarts once, with the settings refined that cause it; one that is still outside, or
//! whose settings the user has given, has this as a warning, and as its outcome where it has done all cycles. Where the
//! finer run has no solution, the first one is solved again.
//!
//! The histories that companions are compared by are part of the checkpoint, so that a resumed run makes the same choices.
//!
//! In more than one thread the companions are solved beside the run.

mod balance;
mod companion_threads;
mod companions;
mod estimate;

pub use balance::may_restart;
pub use companions::companion_scenes;

use crate::SolveError;
use crate::checkpoint::{Checkpoint, EarlierRuns, Finished};
use crate::effects::{self, EffectsPlan};
use crate::observer::{Event, Observer, Phase, Restart};
use crate::record::{Compared, Errors, Excess, Outcome, Summary, Warning};
use crate::run;
use crate::scene::{Refinement, Scene};
use companion_threads::CompanionThreads;
use estimate::Estimate;
use std::ops::ControlFlow;
use std::thread::Scope;

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
    from: Option<Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    let plan = effects::plan(scene);
    let mut done = with_companions(scene, &plan, from, observer)?;
    let missed = plan.missed().copied();
    done.warnings.extend(missed.map(Warning::Missed));
    Ok(done)
}

fn with_companions(
    scene: &Scene,
    plan: &EffectsPlan,
    from: Option<Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    std::thread::scope(|scope| {
        let earlier = from.as_ref().map(Checkpoint::earlier);
        let mut runs = Runs {
            scene,
            plan,
            earlier: earlier.cloned().unwrap_or_default(),
            from,
            observer,
            threads: None,
        };
        if !scene.accuracy.estimate_errors {
            return runs.solve(scene);
        }
        runs.begin_threads(scope);
        let stages: [fn(&mut Runs<'_, '_>) -> Stage; 4] = [
            |runs| runs.first(),
            |runs| runs.companions(),
            |runs| runs.end_within(),
            |runs| runs.finer(),
        ];
        for stage in stages {
            if let ControlFlow::Break(done) = stage(&mut runs)? {
                return Ok(done);
            }
        }
        runs.first_again()
    })
}

/// The end of all runs, or what the next stage is for. A stage that is behind the checkpoint does nothing.
type Stage = Result<ControlFlow<Summary>, SolveError>;

const NEXT: Stage = Ok(ControlFlow::Continue(()));

/// The runs of a scene.
struct Runs<'scope, 'env> {
    scene: &'env Scene,
    /// The plan of the scene, which all runs follow.
    plan: &'env EffectsPlan,
    /// The checkpoint that the next run resumes from.
    from: Option<Checkpoint>,
    /// The run with the settings of the tolerance, its companions, and `None` for a finer run without a solution.
    earlier: EarlierRuns,
    observer: &'env mut dyn Observer,
    /// Threads of the companions, if they have any.
    threads: Option<CompanionThreads<'scope, 'env>>,
}

impl<'scope, 'env> Runs<'scope, 'env> {
    /// Begins threads for companions that are still to be solved.
    fn begin_threads(&mut self, scope: &'scope Scope<'scope, 'env>) {
        let next = self.earlier.runs.len().saturating_sub(1);
        // A line is solved in all threads itself, and so are its companions after it.
        let is_line = self.scene.dimension.line().is_some();
        if self.scene.threads < 2 || is_line || next >= companions::count(self.scene) {
            return;
        }
        // The checkpoint is that of the run until this one has ended, then of a companion.
        let of_companion = self.from.take_if(|_| !self.earlier.runs.is_empty());
        let threads = CompanionThreads::new(scope, self.scene, self.plan, next, of_companion);
        threads.begin(self.scene.threads - 1);
        self.threads = Some(threads);
    }

    /// The run with the settings of the tolerance.
    fn first(&mut self) -> Stage {
        if !self.earlier.runs.is_empty() {
            return NEXT;
        }
        let mut done = self.solve(self.scene)?;
        if done.outcome == Outcome::Stopped {
            return Ok(ControlFlow::Break(done));
        }
        let compared = std::mem::take(&mut done.compared);
        self.earlier.runs.push(Some(compared));
        self.earlier.finished = Some(Box::new(Finished::new(done)));
        NEXT
    }

    /// The companions, of which one may have no solution; without the first nothing can be compared.
    fn companions(&mut self) -> Stage {
        if self.earlier.finished.is_some() {
            self.observer.on_phase(Phase::Companions);
        }
        if let Some(threads) = &self.threads {
            // The run has left its own thread to them.
            threads.begin(1);
        }
        while let Some(companion) = companions::companion(self.scene, self.earlier.runs.len() - 1) {
            if self.earlier.runs.get(1) == Some(&None) {
                break;
            }
            let compared = match self.companion(&companion) {
                Ok(done) if done.outcome == Outcome::Stopped => {
                    return Ok(ControlFlow::Break(done));
                }
                Ok(done) => Some(done.compared),
                Err(SolveError::Checkpoint(mismatch)) => return Err(mismatch.into()),
                Err(_) => None,
            };
            self.earlier.runs.push(compared);
        }
        self.threads = None;
        NEXT
    }

    /// The next companion: from its thread if it has one.
    fn companion(&mut self, companion: &Scene) -> Result<Summary, SolveError> {
        let number = self.earlier.runs.len() - 1;
        let mut from = self.from.take();
        if let Some(threads) = &mut self.threads {
            let (earlier, observer) = (&mut self.earlier, &mut *self.observer);
            let solved = threads.wait(number, &mut |mut checkpoint| {
                std::mem::swap(checkpoint.earlier_mut(), earlier);
                let flow = observer.on(Event::Checkpoint(checkpoint.as_resumable()));
                std::mem::swap(checkpoint.earlier_mut(), earlier);
                flow
            });
            if let Some(solved) = solved {
                return solved;
            }
            from = from.or(threads.take_checkpoint());
        }
        let observer = &mut companions::Quiet {
            observer: self.observer,
        };
        run::by_plan(companion, self.plan, from, &self.earlier, observer)
    }

    /// Ends with the first run, unless a finer one is worth it.
    fn end_within(&mut self) -> Stage {
        let errors = self.first_errors();
        let Some(finished) = self.earlier.finished.take() else {
            return NEXT;
        };
        let mut done = finished.into_summary();
        self.state_first_errors(&mut done);
        if !errors.is_some_and(|errors| balance::is_worth_a_restart(self.scene, &errors)) {
            return Ok(ControlFlow::Break(done));
        }
        let excess = self.excess(errors);
        let restart = Event::Restart(Restart::Finer(&excess));
        if self.observer.on(restart).is_break() {
            done.outcome = Outcome::Stopped;
            return Ok(ControlFlow::Break(done));
        }
        NEXT
    }

    /// The finer run, which may have no solution.
    fn finer(&mut self) -> Stage {
        if self.earlier.runs.len() > 1 + companions::count(self.scene) {
            return NEXT;
        }
        let errors = self.first_errors();
        let refinement = errors.map_or(Refinement::NONE, |errors| {
            balance::finer(self.scene, &errors)
        });
        let excess = self.excess(errors);
        self.observer.on_refined(&excess);
        match self.solve(&companions::refined(self.scene, refinement)) {
            Ok(mut done) => {
                if done.outcome != Outcome::Stopped {
                    let compared = std::mem::take(&mut done.compared);
                    self.state_errors(&mut done, &compared, refinement);
                }
                return Ok(ControlFlow::Break(done));
            }
            Err(SolveError::Checkpoint(mismatch)) => return Err(mismatch.into()),
            Err(error) => {
                let restart = Restart::NoFinerRun(&error);
                if self.observer.on(Event::Restart(restart)).is_break() {
                    return Err(error);
                }
            }
        }
        self.earlier.runs.push(None);
        NEXT
    }

    /// The first run again, whose results were discarded for the finer one's.
    fn first_again(&mut self) -> Result<Summary, SolveError> {
        let mut done = self.solve(self.scene)?;
        if done.outcome != Outcome::Stopped {
            self.state_first_errors(&mut done);
            done.warnings.push(Warning::NoFinerRun);
        }
        Ok(done)
    }

    fn solve(&mut self, scene: &Scene) -> Result<Summary, SolveError> {
        let from = self.from.take();
        run::by_plan(scene, self.plan, from, &self.earlier, self.observer)
    }

    fn first_errors(&self) -> Option<Errors> {
        let first = self.earlier.runs.first()?.as_ref()?;
        self.estimate(first, Refinement::NONE).errors()
    }

    /// The errors outside of the tolerance.
    fn excess(&self, errors: Option<Errors>) -> Vec<Excess> {
        let tolerance = self.scene.accuracy.tolerance;
        errors
            .iter()
            .flat_map(|errors| errors.outside(tolerance))
            .collect()
    }

    /// States the errors of the run with the settings of the tolerance.
    fn state_first_errors(&self, done: &mut Summary) {
        if let Some(Some(first)) = self.earlier.runs.first() {
            self.state_errors(done, first, Refinement::NONE);
        }
    }

    fn state_errors(&self, done: &mut Summary, run: &Compared, refinement: Refinement) {
        let estimate = self.estimate(run, refinement);
        done.life.state_errors(estimate.errors_of_lives());
        done.life.scattered = estimate.scattered_lives();
        state_errors(done, estimate.errors(), self.scene.accuracy.tolerance);
    }

    fn estimate<'a>(&'a self, run: &'a Compared, refinement: Refinement) -> Estimate<'a> {
        Estimate {
            scene: self.scene,
            companions: &self.earlier.runs[1..],
            run,
            refinement,
        }
    }
}

/// Sets the errors of a run, and its outcome and warnings where they exceed the tolerance.
fn state_errors(done: &mut Summary, errors: Option<Errors>, tolerance: f64) {
    done.errors = errors;
    let Some(errors) = errors else {
        done.warnings.push(Warning::NoCompanion);
        return;
    };
    for excess in errors.outside(tolerance) {
        done.warnings.push(Warning::Excess(excess));
        if balance::is_decisive(excess.quantity) && done.outcome == Outcome::Completed {
            done.outcome = Outcome::OutsideTolerance;
        }
    }
}
