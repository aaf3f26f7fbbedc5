//! Delivers the events of a run.

use std::ops::ControlFlow;

use super::contact::{Contact, RunOfContact};
use super::progress::end;
use crate::SolveError;
use crate::observer::{Event, Observer};
use crate::record::Outcome;
use crate::scene::Scene;

/// Delivers the result of a computed cycle; `Break` where the run ends with it or is stopped.
pub(super) fn deliver<C: Contact>(
    scene: &Scene,
    contact: &C,
    run: &mut RunOfContact<C>,
    worn: &C::Worn,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let resistance = run.electrical.resistance.as_ref();
    let report = contact.report(scene, &run.state, worn, resistance);
    let cycle = C::cycle(&run.state);
    if run.is_comparable(scene, cycle) {
        run.compared.push(&report);
    }
    if observer.on(Event::Cycle(&report)).is_break() {
        return Ok(STOPPED);
    }
    let end = end(scene, contact, run, worn);
    if end.is_some() || scene.output.snapshots_at_cycles.contains(&cycle) {
        let snapshot = contact.snapshot(scene, &run.state, worn)?;
        if observer.on(Event::Snapshot(&snapshot)).is_break() {
            return Ok(STOPPED);
        }
    }
    if let Some(outcome) = end {
        return Ok(ControlFlow::Break(outcome));
    }
    Ok(match observer.on(Event::Checkpoint(C::resumable(run))) {
        ControlFlow::Break(()) => STOPPED,
        ControlFlow::Continue(()) => ControlFlow::Continue(()),
    })
}
