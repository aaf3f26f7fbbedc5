//! `fretwear export SPEC`: the model as an input deck for other codes.

use std::ops::ControlFlow;
use std::path::Path;

use solver::extruded::ExtrudedScene;
use solver::model::{self, Model};
use solver::observer::{Event, Observer};
use solver::record::{DepthProfile, Snapshot};
use solver::scene::Scene;
use solver::sides::Sides;
use solver::{SolveError, ale};

use crate::cli::specification;
use crate::cli::terminal::{Ended, failed, write_out};
use crate::export::deck;

pub(super) fn run(spec: &Path, cycle: u64) -> Ended {
    let scene = specification::resolved(spec)?.scene;
    let extruded = ExtrudedScene::of(&scene);
    if scene.dimension.is_finite() && extruded.is_none() {
        return Err(failed(
            "only a section and extruded bodies have a mesh that can be exported; write `plane_strain` for that of this contact",
        ));
    }
    if cycle > scene.cycles {
        return Err(failed(format_args!(
            "cycle {cycle} exceeds the number of cycles, {}",
            scene.cycles
        )));
    }
    let models = worn(&scene, cycle).map_err(failed)?;
    let deck = match &extruded {
        None => deck::inp(&scene, &models[0]),
        Some(bodies) => deck::extruded::inp(bodies, &models),
    };
    write_out(deck.trim_end())
}

/// Returns the model at a cycle, that of each node plane of extruded bodies; the unworn one needs no solve.
fn worn(scene: &Scene, cycle: u64) -> Result<Vec<Model>, SolveError> {
    let model = model::build(scene, &solver::effects::plan(scene))?;
    let planes = ExtrudedScene::of(scene).map_or(1, |bodies| bodies.node_planes());
    if cycle == 0 {
        return Ok(vec![model; planes]);
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
        return Ok(vec![model; planes]);
    };
    let of_plane = |(slider, receptacle): (DepthProfile, DepthProfile)| {
        let depth = Sides {
            slider: slider.depth_mm,
            receptacle: receptacle.depth_mm,
        };
        Ok(ale::relocate(&model, &depth)?)
    };
    if snapshot.stations.is_empty() {
        return Ok(vec![of_plane((snapshot.slider, snapshot.receptacle))?]);
    }
    let stations = snapshot.stations.into_iter();
    stations
        .map(|station| of_plane((station.slider, station.receptacle)))
        .collect()
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
