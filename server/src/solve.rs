//! Solves: the engine's events as documents, checkpoints and cost; in this process, or in one of its own.

pub mod checkpoint;
mod cost;
pub(crate) mod process;
pub(crate) mod protocol;

use std::fmt::Display;
use std::ops::ControlFlow;

use api::results::{BlockExtent, ContactMaps, Cost, Summary};
use api::spec::{DerivedMotion, LifeSettings};
use serde::Serialize;
use solver::SolveError;
use solver::checkpoint::Resumable;
use solver::error_control;
use solver::observer::{self, Event, Observer};
use solver::record::{Excess, Position, Snapshot};
use solver::scene::Scene;

use crate::export::documents::{Document, JSON, SVG, VTU};
use crate::export::vtu::VtuError;
use crate::export::{history, life, line, line_maps, maps, mission, pictures, vtu};
use crate::spec::Resolved;
use crate::spec::scatter::FollowsProduct;
use crate::words::{restarts, warnings};
use checkpoint::{Checkpoint, CheckpointPolicy, EncodedCheckpoint};
use cost::Stopwatch;
pub use cost::{children_cpu_s, cpu_s, thread_cpu_s};
pub(crate) use process::LINE_LIMIT;
pub use protocol::{ChildMessage, Failure};

/// Scene to be solved, with the parts of its specification that results need.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The resolved criteria of its life, and how wear coefficients scatter.
    pub life: &'a LifeSettings,
    /// How its motion was derived.
    pub motion: Option<&'a DerivedMotion>,
    /// The blocks of its mission.
    pub blocks: &'a [BlockExtent],
    /// Data missing for a criterion of the contact resistance; empty if the resistance is modelled.
    pub resistance_lacks: &'a [String],
    /// Results that depend on wear coefficients and cycles by their product.
    pub(crate) follows_product: FollowsProduct,
}

impl<'a> From<&'a Resolved> for Case<'a> {
    fn from(resolved: &'a Resolved) -> Self {
        Self {
            scene: &resolved.scene,
            life: &resolved.spec.life,
            motion: resolved.motion.as_ref(),
            blocks: &resolved.blocks,
            resistance_lacks: &resolved.resistance_lacks,
            follows_product: FollowsProduct::of(&resolved.spec.interface),
        }
    }
}

/// Solves a scene. `on` receives every line except the last one, and may stop the run.
///
/// # Errors
/// [`Failure`] with the engine's numbers.
pub fn run(
    case: Case<'_>,
    on: &mut dyn FnMut(ChildMessage) -> ControlFlow<()>,
) -> Result<Summary, Failure> {
    run_from(case, None, &CheckpointPolicy::default(), on)
}

/// Solves a scene from a checkpoint, if there is one, and emits checkpoints. If the checkpoint does not fit the scene, or
/// the estimated error exceeds the tolerance, the run emits [`ChildMessage::Restarted`] and starts at cycle 0.
///
/// # Errors
/// [`Failure`] with the engine's numbers.
pub fn run_from(
    Case {
        scene,
        life,
        motion,
        blocks,
        resistance_lacks,
        follows_product,
    }: Case<'_>,
    from: Option<Checkpoint>,
    policy: &CheckpointPolicy,
    on: &mut dyn FnMut(ChildMessage) -> ControlFlow<()>,
) -> Result<Summary, Failure> {
    let (cost, run) = from.map(|from| (from.cost, from.run)).unzip();
    let mut recorder = Recorder {
        on,
        policy,
        watch: Stopwatch::start(cost.unwrap_or_default()),
        is_stopped: false,
    };
    let mut ended = match run {
        Some(run) => error_control::resume(scene, run, &mut recorder),
        None => error_control::solve(scene, &mut recorder),
    };
    if let Err(SolveError::Checkpoint(mismatch)) = ended {
        recorder.watch = Stopwatch::start(Cost::default());
        recorder.emit(ChildMessage::Restarted(mismatch.to_string()));
        ended = error_control::solve(scene, &mut recorder);
    }
    let summary = ended?;
    let done = summary.last.cycle;
    let life = life::entries(
        life,
        follows_product,
        resistance_lacks,
        scene,
        &summary.life,
        done,
    );
    Ok(Summary {
        motion: motion.cloned(),
        mission: mission::blocks(blocks, &summary),
        ..history::summary(&summary, recorder.watch.cost(), life)
    })
}

struct Recorder<'a> {
    on: &'a mut dyn FnMut(ChildMessage) -> ControlFlow<()>,
    policy: &'a CheckpointPolicy,
    watch: Stopwatch,
    /// Set if `on` stopped the run at a line that is not an event of the engine; the next event stops it.
    is_stopped: bool,
}

impl Recorder<'_> {
    /// Emits a line that is not an event at which the engine can be stopped.
    fn emit(&mut self, line: ChildMessage) {
        self.is_stopped |= (self.on)(line).is_break();
    }

    /// Emits a checkpoint if one is due, and stops the run if it is asked to.
    fn checkpoint(&mut self, run: Resumable<'_>) -> ControlFlow<()> {
        if !self.policy.is_due() {
            return ControlFlow::Continue(());
        }
        let checkpoint = Checkpoint {
            cost: self.watch.cost(),
            run: run.checkpoint(),
        };
        let flow = match checkpoint.encode() {
            Ok(state) => (self.on)(ChildMessage::Checkpoint(EncodedCheckpoint {
                cycle: run.cycle(),
                state,
            })),
            Err(error) => {
                tracing::error!(%error, "a checkpoint was not encoded");
                ControlFlow::Continue(())
            }
        };
        if self.policy.is_stopped() {
            ControlFlow::Break(())
        } else {
            flow
        }
    }

    /// Emits the fields of a snapshot.
    fn fields(&mut self, snapshot: &Snapshot) -> ControlFlow<()> {
        let cycle = snapshot.cycle;
        for fields in &snapshot.fields {
            self.vtu(cycle, fields.position, vtu::bytes(fields))?;
        }
        for fields in &snapshot.line_fields {
            self.vtu(cycle, fields.position, vtu::line_bytes(fields))?;
        }
        ControlFlow::Continue(())
    }

    /// Emits the file of the fields at a position.
    fn vtu(
        &mut self,
        cycle: u64,
        position: Position,
        bytes: Result<Vec<u8>, VtuError>,
    ) -> ControlFlow<()> {
        let name = vtu::file_name(cycle, position);
        self.file(name, cycle, VTU, bytes, "fields were not written")
    }

    /// Emits the picture of the maps of a snapshot.
    fn picture(&mut self, maps: &ContactMaps) -> ControlFlow<()> {
        let name = pictures::maps::file_name(maps.cycle);
        let drawing = pictures::colour_map(&pictures::maps::picture(maps));
        let bytes = drawing.map(String::into_bytes);
        self.file(name, maps.cycle, SVG, bytes, "a picture was not drawn")
    }

    /// Emits a document of a snapshot as a file.
    fn document(&mut self, name: String, cycle: u64, document: &impl Serialize) -> ControlFlow<()> {
        let bytes = serde_json::to_vec(document);
        let failure = "a document of a snapshot was not written";
        self.file(name, cycle, JSON, bytes, failure)
    }

    /// Emits a file of a snapshot; one that could not be made is logged and left out.
    fn file(
        &mut self,
        name: String,
        cycle: u64,
        media_type: &'static str,
        bytes: Result<Vec<u8>, impl Display>,
        failure: &str,
    ) -> ControlFlow<()> {
        match bytes {
            Ok(bytes) => (self.on)(ChildMessage::Fields(Document {
                name,
                cycle: Some(cycle),
                media_type,
                bytes,
            })),
            Err(error) => {
                tracing::error!(%error, name, "{failure}");
                ControlFlow::Continue(())
            }
        }
    }
}

impl Observer for Recorder<'_> {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if self.is_stopped {
            return ControlFlow::Break(());
        }
        let line = match event {
            Event::Cycle(report) => ChildMessage::Cycle(Box::new(report.clone())),
            Event::Snapshot(snapshot) => {
                self.fields(snapshot)?;
                let cycle = snapshot.cycle;
                let area = snapshot.area.as_ref();
                let area = area.map(|maps| maps::document(cycle, maps));
                if let Some(maps) = area.or_else(|| line_maps::document(snapshot)) {
                    self.document(maps::file_name(cycle), cycle, &maps)?;
                    self.picture(&maps)?;
                }
                if !snapshot.stations.is_empty() {
                    let name = line::file_name(cycle);
                    self.document(name, cycle, &line::document(snapshot))?;
                }
                ChildMessage::Snapshot(Box::new(history::snapshot(snapshot)))
            }
            Event::Checkpoint(run) => return self.checkpoint(run),
            Event::Restart(cause) => ChildMessage::Restarted(restarts::restart(&cause)),
        };
        (self.on)(line)
    }

    fn on_phase(&mut self, phase: observer::Phase) {
        let phase = history::phase(phase);
        self.watch.enter(phase);
        self.emit(ChildMessage::Phase(phase));
    }

    fn on_refined(&mut self, errors: &[Excess]) {
        self.emit(ChildMessage::Refined(warnings::all_excess(errors)));
    }
}
