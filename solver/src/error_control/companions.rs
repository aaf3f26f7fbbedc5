//! The companions of a run: the same scene on coarser settings.

use std::ops::ControlFlow;

use crate::observer::{Event, Observer};
use crate::scene::{Accuracy, Refinement, Scene};

/// Settings of the first companion over those of the tolerance, and those of the coarser ones. Finer companions cost
/// more than a quarter of the run; coarser ones have less than an element in the half-width of a contact in gross
/// sliding.
pub(super) const COARSE: f64 = 0.35;
pub(super) const COARSER: f64 = 0.25;

/// Number of companions: the coarse one, and one more for each of mesh, increments and jumps.
pub(super) const COUNT: usize = 4;

/// The settings of a companion; `None` beyond the last. Each differs from the one before in one of them.
pub(super) fn refinement(companion: usize) -> Option<Refinement> {
    let of = |part: usize| if companion > part { COARSER } else { COARSE };
    (companion < COUNT).then(|| Refinement {
        mesh: of(0),
        increments: of(1),
        cycles: of(2),
    })
}

/// The scene of a companion: no snapshots, no fields.
pub(super) fn scene(scene: &Scene, refinement: Refinement) -> Scene {
    let mut companion = refined(scene, refinement);
    companion.output.snapshots_at_cycles.clear();
    companion.output.fields = false;
    companion.accuracy.estimate_errors = false;
    companion
}

/// The scenes that are solved beside a scene whose errors are estimated.
pub fn companion_scenes(of: &Scene) -> Vec<Scene> {
    let count = if of.accuracy.estimate_errors {
        COUNT
    } else {
        0
    };
    let refinements = (0..count).filter_map(refinement);
    refinements
        .map(|refinement| scene(of, refinement))
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
