//! `fretwear export SPEC`: the model as an input deck for other codes.

use std::ops::ControlFlow;
use std::path::Path;

use solver::extruded::ExtrudedScene;
use solver::interpolation;
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
    // The mesh of fewer cycles, or of a finer run, has other nodes.
    let of_plane = |profiles: Sides<DepthProfile>| {
        let depth = Sides::from_fn(|side| {
            let DepthProfile { x_mm, depth_mm } = profiles.of(side);
            let nodes = model.bodies.of(side).contact_x().iter();
            nodes
                .map(|x| interpolation::linear(x_mm, depth_mm, *x))
                .collect()
        });
        Ok(ale::relocate(&model, &depth)?)
    };
    let Snapshot {
        slider,
        receptacle,
        stations,
        ..
    } = snapshot;
    if stations.is_empty() {
        return Ok(vec![of_plane(Sides { slider, receptacle })?]);
    }
    let profiles = stations.into_iter().map(|station| Sides {
        slider: station.slider,
        receptacle: station.receptacle,
    });
    profiles.map(of_plane).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec;
    use solver::sides::Side;

    /// The mesh of 18 000 cycles is finer farther out than that of the ten which are solved.
    #[test]
    fn surfaces_are_those_of_the_cycle_whatever_follows() {
        let scene = |cycles: u64| {
            let text = format!(
                r#"{{"system":{{"kind":"cylinder_on_flat"}},"cycles":{cycles},"accuracy":{{"preset":"draft"}}}}"#
            );
            spec::read(text.as_bytes()).expect("accepted").scene
        };
        let (long, short) = (scene(18_000), scene(10));
        let worn_down = |scene: &Scene| {
            let [unworn, worn] = [0, 10].map(|cycle| worn(scene, cycle).expect("it is solved"));
            let [unworn, worn] =
                [&unworn[0], &worn[0]].map(|model| model.bodies.of(Side::Receptacle));
            assert_eq!(unworn.contact_x(), worn.contact_x());
            let heights = unworn.surface_y().iter().zip(worn.surface_y());
            let down: Vec<f64> = heights.map(|(unworn, worn)| unworn - worn).collect();
            (worn.contact_x().to_vec(), down)
        };
        let ((x, down), (few_x, few_down)) = (worn_down(&long), worn_down(&short));
        assert_ne!(x.len(), few_x.len());
        let deepest = few_down.iter().copied().fold(0.0, f64::max);
        assert!(deepest > 0.0);
        for (x, down) in x.iter().zip(&down) {
            let expected = interpolation::linear(&few_x, &few_down, *x);
            assert!((down - expected).abs() < 1e-6 * deepest, "{x}");
        }
    }
}
