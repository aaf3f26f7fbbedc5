//! `fretwear export SPEC`: the model as an input deck for other codes.

use std::ops::ControlFlow;
use std::path::Path;

use solver::model::{self, Model};
use solver::observer::{Event, Observer};
use solver::record::Snapshot;
use solver::scene::Scene;
use solver::sides::Sides;
use solver::{SolveError, ale};

use crate::cli::terminal::{Ended, failed, specification, write_out};
use crate::export::deck;

pub(super) fn run(spec: &Path, cycle: u64) -> Ended {
    let scene = specification(spec)?.scene;
    if scene.dimension.is_finite() {
        return Err(failed(
            "only a section has a mesh that can be exported; write `plane_strain` for that of this contact",
        ));
    }
    if cycle > scene.cycles {
        return Err(failed(format_args!(
            "cycle {cycle} exceeds the number of cycles, {}",
            scene.cycles
        )));
    }
    let model = worn(&scene, cycle).map_err(failed)?;
    write_out(deck::inp(&scene, &model).trim_end())
}

/// Returns the model at a cycle; the unworn one needs no solve.
fn worn(scene: &Scene, cycle: u64) -> Result<Model, SolveError> {
    let model = model::build(scene, &solver::effects::plan(scene))?;
    if cycle == 0 {
        return Ok(model);
    }
    let mut short = Scene {
        cycles: cycle,
        ..scene.clone()
    };
    short.output.snapshots_at_cycles = vec![cycle];
    short.output.fields = false;
    let mut last = Last::default();
    solver::run::solve(&short, &mut last)?;
    let Some(snapshot) = last.0 else {
        return Ok(model);
    };
    let depth = Sides {
        slider: snapshot.slider.depth_mm,
        receptacle: snapshot.receptacle.depth_mm,
    };
    Ok(ale::relocate(&model, &depth)?)
}

/// Stores the last snapshot.
#[derive(Default)]
struct Last(Option<Snapshot>);

impl Observer for Last {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if let Event::Snapshot(snapshot) = event {
            self.0 = Some(snapshot.clone());
        }
        ControlFlow::Continue(())
    }
}
