//! Condensation and contact increments, for comparing one version of the engine with another:
//! `cargo bench -p solver`.

#[expect(dead_code, reason = "the verification suite uses more of it")]
#[path = "../tests/scenes.rs"]
mod scenes;

use std::ops::ControlFlow;

use divan::Bencher;
use solver::condensation::condense;
use solver::contact::area::{Cells, NormalContact, NormalProblem};
use solver::cycle::{CycleState, Integrator};
use solver::error_control;
use solver::model;
use solver::observer::{Event, Observer};
use solver::scene::{Friction, Motion, Scene, WearLaw};

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
    bencher.bench_local(|| condense(&model, 1).expect("it can be condensed"));
}

/// A run at 2 % with the companions that its error is estimated by, in so many threads.
#[divan::bench(args = [1, 2], sample_count = 10)]
fn run_with_companions(bencher: Bencher<'_, '_>, threads: usize) {
    let mut scene = scenes::mccoll();
    scene.accuracy.estimate_errors = true;
    scene.threads = threads;
    bencher.bench_local(|| error_control::solve(&scene, &mut Unobserved).expect("it goes through"));
}

/// Observes nothing.
struct Unobserved;

impl Observer for Unobserved {
    fn on(&mut self, _event: Event<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

#[divan::bench(args = [4, 2, 1])]
fn cycle_of_40_increments(bencher: Bencher<'_, '_>, element_um: u32) {
    bench_cycle(bencher, &mccoll(element_um), 0);
}

/// A computed cycle of two, after some others.
fn bench_cycle(bencher: Bencher<'_, '_>, scene: &Scene, before: u32) {
    let model = model::build(scene, &solver::effects::plan(scene)).expect("it can be meshed");
    let condensed = condense(&model, 1).expect("it can be condensed");
    let operators = &condensed.operators;
    let mut loaded = CycleState::start(operators, model.interface.slave);
    let mut integrator = Integrator::new(scene, &model, operators);
    integrator.apply_load(&mut loaded).expect("it settles");
    integrator
        .initial_quarter(&mut loaded)
        .expect("it sets out");
    for _ in 0..before {
        integrator
            .compute_cycle(&mut loaded, 2, true)
            .expect("it slides");
    }
    bencher
        .with_inputs(|| loaded.clone())
        .bench_local_values(|mut state| {
            integrator
                .compute_cycle(&mut state, 2, true)
                .expect("it slides")
        });
}

/// Partial slip of a cylinder that wears the flat, about so many nodes in contact: as in `tests/verify_stick_zone.rs`, whose contact
/// has a half-width of 0.0913 mm.
fn partial_slip(nodes: u32) -> Scene {
    let mut scene = scenes::mccoll();
    scene.slider.shape.half_width_mm = 6.0;
    scene.slider.wear = None;
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 3e-6,
    });
    scene.friction = Friction::Coulomb { coefficient: 0.6 };
    scene.load_n_per_mm = 120.0;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.0012,
        period_s: 1.0,
    };
    scene.cycles = 10;
    scene.accuracy.contact_element_mm = Some(2.0 * 0.0913 / f64::from(nodes));
    scene.accuracy.increments_per_cycle = Some(20);
    scene.accuracy.cycle_jump = Some(2);
    scene
}

#[divan::bench(args = [80, 160, 320, 640, 1_280, 2_000], sample_count = 5)]
fn partial_slip_cycle_of_20_increments(bencher: Bencher<'_, '_>, nodes: u32) {
    // The first cycle starts from no cycle before.
    bench_cycle(bencher, &partial_slip(nodes), 1);
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

/// Hertz' contact of a sphere of steel of 10 mm under 100 N on 2.8 half-lengths.
fn sphere(count: u32) -> (NormalContact, Vec<f64>) {
    let size = 2.8 * 0.189_686 / f64::from(count);
    let along = usize::try_from(count).expect("it fits");
    let cells = Cells {
        along_x: along,
        along_z: along,
        dx_mm: size,
        dz_mm: size,
    };
    let gap = cells.map(|x, z| (x * x + z * z) / 20.0);
    (NormalContact::new(cells, 109_890.0), gap)
}

#[divan::bench(args = [32, 64, 128])]
fn point_contact_cold(bencher: Bencher<'_, '_>, count: u32) {
    let (mut contact, gap) = sphere(count);
    let wear = vec![0.0; gap.len()];
    let problem = NormalProblem {
        gap_mm: &gap,
        wear_mm_per_mpa: &wear,
        force_n: 100.0,
    };
    bencher.bench_local(|| {
        let mut pressure = vec![0.0; gap.len()];
        contact
            .solve(&problem, &mut pressure)
            .expect("it is solved")
    });
}

/// An increment: the surfaces have lost a per cent of the approach, and wear as much again.
#[divan::bench(args = [32, 64, 128])]
fn point_contact_warm(bencher: Bencher<'_, '_>, count: u32) {
    let (mut contact, gap) = sphere(count);
    let wear = vec![2.7e-8; gap.len()];
    let unworn = NormalProblem {
        gap_mm: &gap,
        wear_mm_per_mpa: &wear,
        force_n: 100.0,
    };
    let mut start = vec![0.0; gap.len()];
    contact.solve(&unworn, &mut start).expect("it is solved");
    let worn: Vec<f64> = gap
        .iter()
        .zip(&start)
        .map(|(h, p)| h + 2.7e-8 * p)
        .collect();
    let problem = NormalProblem {
        gap_mm: &worn,
        ..unworn
    };
    bencher
        .with_inputs(|| start.clone())
        .bench_local_values(|mut pressure| {
            contact
                .solve(&problem, &mut pressure)
                .expect("it is solved")
        });
}
