//! Extruded bodies: a plane section drawn out over a width.
//!
//! ```text
//!     .---------.          w = 0.01058 mm, 0.508 N/mm: 5.37 mN
//!    /_________/|
//!    |  ____  | |          thesis' fuzz button: wire of 25.4 um on a block of 63.5 um, two layers over the width
//!    |_/    \_|/
//! ```
//! Held ends are plane strain; free ends are softer. Where the contact leaves its own width, it wears a floor by 2 k P' a cycle, whatever the
//! ends.

mod cost;
mod ends;
mod fields;
mod limits;
mod runs;
mod wear;

use std::ops::ControlFlow;

use crate::verification::scenes::fuzz_button;
use solver::contact::ContactState;
use solver::cycle::{CycleState, Integrator};
use solver::extruded::{ExtrudedScene, ExtrudedSummary, run};
use solver::scene::{Accuracy, Ends, Friction, Scene};
use solver::sides::Sides;
use solver::{condensation, effects, model};

/// Width of the thesis' extruded model, mm.
const WIDTH: f64 = 0.010_58;
/// Two layers over the width.
const TWO: (usize, f64) = (2, 1.0);

/// The thesis' fuzz button at 10 % with layers that grow from the free end on, for so many cycles.
fn button(ends: Ends, (layers, growth): (usize, f64), cycles: u64) -> ExtrudedScene {
    let mut section = fuzz_button();
    section.accuracy = Accuracy::from_tolerance(0.1);
    section.cycles = cycles;
    section.output.snapshots_at_cycles = vec![cycles];
    ExtrudedScene {
        section,
        width_mm: WIDTH,
        layers,
        growth,
        ends,
    }
}

/// The loaded contact without friction, meshed for a short stroke.
fn loaded(ends: Ends, layers: (usize, f64)) -> ExtrudedScene {
    let mut scene = button(ends, layers, 0);
    scene.section.friction = Friction::Frictionless;
    scene.section.motion = solver::scene::Motion::Reciprocating {
        amplitude_mm: 1e-6,
        period_s: 1.0,
    };
    scene
}

fn solved(scene: &ExtrudedScene) -> ExtrudedSummary {
    run(scene, |_| ControlFlow::Continue(())).expect("the scene can be solved")
}

/// The loaded plane contact of a section.
fn loaded_plane(section: &Scene) -> ContactState {
    let model = model::build(section, &effects::plan(section)).expect("the section can be meshed");
    let condensed = condensation::condense(&model, 1).expect("the section can be condensed");
    let mut state = CycleState::start(&condensed.operators, model.interface.slave);
    Integrator::new(section, &model, &condensed.operators)
        .apply_load(&mut state)
        .expect("the load is carried");
    state.contact
}

/// Approach, peak pressures of all planes from the end to the middle, and line loads, over those of the plane contact.
fn over_plane(scene: &ExtrudedScene) -> (f64, Vec<f64>, Vec<f64>) {
    let (summary, plane) = (solved(scene), loaded_plane(&scene.section));
    let found = &summary.initial;
    let planes = found.stations.iter();
    (
        summary.approach_mm / -plane.height,
        (planes.clone())
            .map(|p| p.peak_pressure_mpa / plane.peak_pressure())
            .collect(),
        planes
            .map(|p| p.line_load_n_per_mm / scene.section.load_n_per_mm)
            .collect(),
    )
}

/// Largest difference of worn depths over the largest depth, on the same nodes.
fn difference(a: &Sides<Vec<f64>>, b: &Sides<Vec<f64>>) -> f64 {
    let sides = [(&a.slider, &b.slider), (&a.receptacle, &b.receptacle)];
    let of_side = |(a, b): &(&Vec<f64>, &Vec<f64>)| {
        assert_eq!(a.len(), b.len());
        let pairs = a.iter().zip(b.iter());
        pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    };
    sides.iter().map(of_side).fold(0.0, f64::max) / b.largest()
}
