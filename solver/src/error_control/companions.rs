//! The companions of a run: the same scene on coarser settings.

use std::ops::ControlFlow;

use crate::observer::{Event, Observer};
use crate::scene::{Accuracy, Refinement, Scene};

/// Settings of the first companion over those of the tolerance, and those of the coarser ones. Finer companions cost
/// more than a quarter of the run; coarser ones have less than an element in the half-width of a contact in gross
/// sliding.
pub(super) const COARSE: f64 = 0.35;
pub(super) const COARSER: f64 = 0.25;

/// Number of companions that the errors are estimated by: the coarse one, and one more for each of mesh, increments and jumps. Those of
/// other wear coefficients follow, on the settings of the first.
pub(super) const COUNT: usize = 4;

/// The settings of a companion. Each differs from the one before in one of them.
fn refinement(companion: usize) -> Refinement {
    let of = |part: usize| {
        if companion > part && companion < COUNT {
            COARSER
        } else {
            COARSE
        }
    };
    Refinement {
        mesh: of(0),
        increments: of(1),
        cycles: of(2),
    }
}

/// Number of the companions of a scene.
pub(super) fn count(of: &Scene) -> usize {
    if of.accuracy.estimate_errors {
        COUNT + of.scattered.len()
    } else {
        0
    }
}

/// The scene of a companion; `None` beyond the last.
pub(super) fn companion(of: &Scene, number: usize) -> Option<Scene> {
    let same = (number < count(of)).then_some(of)?;
    let solved = number
        .checked_sub(COUNT)
        .map_or(Some(same), |scattered| of.scattered.get(scattered));
    Some(coarse(solved?, refinement(number)))
}

/// A scene on coarse settings: no snapshots, no fields.
fn coarse(scene: &Scene, refinement: Refinement) -> Scene {
    let mut companion = refined(scene, refinement);
    companion.output.snapshots_at_cycles.clear();
    companion.output.fields = false;
    companion.accuracy.estimate_errors = false;
    companion
}

/// The scenes that are solved beside a scene whose errors are estimated.
pub fn companion_scenes(of: &Scene) -> Vec<Scene> {
    (0..count(of))
        .filter_map(|number| companion(of, number))
        .collect()
}

/// The scene on refined settings.
pub(super) fn refined(scene: &Scene, refinement: Refinement) -> Scene {
    Scene {
        accuracy: Accuracy {
            refinement,
            ..scene.accuracy
        },
        ..scene.clone()
    }
}

/// Delivers the checkpoints of a companion and nothing else.
pub(super) struct Quiet<'a> {
    pub(super) observer: &'a mut dyn Observer,
}

impl Observer for Quiet<'_> {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        match event {
            Event::Checkpoint(_) => self.observer.on(event),
            Event::Cycle(_) | Event::Snapshot(_) | Event::Restart(_) => ControlFlow::Continue(()),
        }
    }
}
