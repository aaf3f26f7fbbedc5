//! The run: integrate until the geometry has drifted, relocate, condense again.

mod finite;
mod section;

use crate::SolveError;
use crate::checkpoint::{Checkpoint, CheckpointMismatch, EarlierRuns};
use crate::effects::{self, EffectsPlan};
use crate::observer::Observer;
use crate::record::Summary;
use crate::scene::{Dimension, Scene};

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
        (Dimension::PlaneStrain, None) => section::begin(scene, plan, earlier.clone(), observer),
        (_, None) => finite::begin(scene, plan, earlier.clone(), observer),
        (Dimension::PlaneStrain, Some(Checkpoint::Section(run))) => {
            section::proceed(scene, plan, *run, observer)
        }
        (Dimension::Point(_), Some(Checkpoint::Point(run))) => {
            finite::proceed_point(scene, plan, *run, observer)
        }
        (Dimension::Line(_), Some(Checkpoint::Line(run))) => {
            finite::proceed_line(scene, plan, *run, observer)
        }
        (Dimension::Extruded(_), Some(Checkpoint::Extruded(run))) => {
            finite::proceed_extruded(scene, plan, *run, observer)
        }
        _ => Err(CheckpointMismatch::Dimension.into()),
    }
}

#[cfg(test)]
mod tests;
