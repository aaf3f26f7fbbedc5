//! A run that is stopped and resumed from its checkpoint ends as the undisturbed one.
//!
//! Everything that the rest of a run depends on is in the checkpoint, so the bits are the same. Allowed: nothing.

use std::ops::ControlFlow;

use solver::SolveError;
use solver::checkpoint::Checkpoint;
use solver::observer::{Event, Observer};
use solver::run;

use super::comparison::Deviation;
use super::{ALL, holds, holds_plated};
use crate::verification::random_scenes::Drawn;
use crate::verification::recorder::{Recorder, solve};

/// Stops at the first checkpoint at or after a cycle.
struct StopAt {
    cycle: u64,
    checkpoint: Option<Checkpoint>,
}

impl Observer for StopAt {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Checkpoint(checkpoint) if checkpoint.cycle() >= self.cycle => {
                self.checkpoint = Some(checkpoint.checkpoint());
                ControlFlow::Break(())
            }
            _ => ControlFlow::Continue(()),
        }
    }
}

fn the_same_in_two_parts(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    let scene = &drawn.scene;
    let mut first = StopAt {
        cycle: scene.cycles / 2,
        checkpoint: None,
    };
    run::solve(scene, &mut first)?;
    let Some(checkpoint) = first.checkpoint else {
        return Ok(None);
    };
    let mut second = Recorder::default();
    let resumed = run::resume(scene, checkpoint, &mut second)?;
    let (whole, undisturbed) = solve(scene)?;
    let last = |recorder: &Recorder| recorder.snapshots[recorder.snapshots.len() - 1].clone();
    // The shortest text of a number identifies its bits, except those of NaN, which a run never reports.
    let [one, other] = [(resumed, last(&second)), (whole, last(&undisturbed))]
        .map(|(summary, snapshot)| format!("{summary:?} {snapshot:?}"));
    Ok(Some(vec![Deviation {
        quantity: "bits".to_owned(),
        found: f64::from(u8::from(one != other || one.contains("NaN"))),
        allowed: 0.0,
    }]))
}

#[test]
fn split_runs_change_no_bit() {
    holds("split run", &ALL, the_same_in_two_parts);
}

#[test]
fn split_runs_of_plated_bodies_change_no_bit() {
    holds_plated("split run", &ALL, the_same_in_two_parts);
}
