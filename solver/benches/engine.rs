//! Condensation and contact increments, for comparing one version of the engine with another:
//! `cargo bench -p solver`.

#[expect(dead_code, reason = "the verification suite uses more of it")]
#[path = "../tests/scenes.rs"]
mod scenes;

use divan::Bencher;
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::model;
use solver::scene::Scene;

fn main() {
    divan::main();
}

/// McColl's scene over ten cycles, whose scar is as small as the contact, with elements of a size.
fn mccoll(element_um: u32) -> Scene {
    let mut scene = scenes::mccoll();
    scene.accuracy.contact_element_mm = Some(1e-3 * f64::from(element_um));
    scene.accuracy.increments_per_cycle = Some(40);
    scene.accuracy.cycle_jump = Some(1);
    scene.cycles = 10;
    scene
}

#[divan::bench(args = [8, 4, 2])]
fn condensation(bencher: Bencher<'_, '_>, element_um: u32) {
    let model = model::build(
        &mccoll(element_um),
        &solver::effects::plan(&mccoll(element_um)),
    )
    .expect("it can be meshed");
    bencher.bench_local(|| condense(&model).expect("it can be condensed"));
}

#[divan::bench(args = [4, 2, 1])]
fn cycle_of_40_increments(bencher: Bencher<'_, '_>, element_um: u32) {
    let scene = mccoll(element_um);
    let model = model::build(&scene, &solver::effects::plan(&scene)).expect("it can be meshed");
    let condensed = condense(&model).expect("it can be condensed");
    let operators = &condensed.operators;
    let mut loaded = CycleState::start(operators, model.interface.slave);
    let mut integrator = Integrator::new(&scene, &model, operators);
    integrator.apply_load(&mut loaded).expect("it settles");
    integrator
        .initial_quarter(&mut loaded)
        .expect("it sets out");
    bencher
        .with_inputs(|| loaded.clone())
        .bench_local_values(|mut state| {
            integrator
                .compute_cycle(&mut state, (2, true))
                .expect("it slides")
        });
}

#[divan::bench(args = [0.1, 0.02], sample_count = 3)]
fn mccoll_2000_cycles(bencher: Bencher<'_, '_>, tolerance: f64) {
    let mut scene = scenes::mccoll();
    scene.cycles = 2_000;
    scene.output.snapshots_at_cycles = Vec::new();
    scene.accuracy.tolerance = tolerance;
    bencher.bench_local(|| solver::run::solve(&scene, &mut Silent).expect("it can be solved"));
}

#[divan::bench(sample_count = 3)]
fn fuzz_button_20_cycles(bencher: Bencher<'_, '_>) {
    let mut scene = scenes::fuzz_button();
    scene.cycles = 20;
    scene.output.snapshots_at_cycles = Vec::new();
    bencher.bench_local(|| solver::run::solve(&scene, &mut Silent).expect("it can be solved"));
}

/// Listens to nothing.
struct Silent;

impl solver::observer::Observer for Silent {
    fn on(&mut self, _: solver::observer::Event<'_>) -> std::ops::ControlFlow<()> {
        std::ops::ControlFlow::Continue(())
    }
}
