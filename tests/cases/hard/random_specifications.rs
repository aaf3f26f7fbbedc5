//! Requirement: any specification from the documented ranges is refused with pointers, or runs and satisfies the
//! invariants, or ends with an error that contains its numbers.
//! Source: contract.md; every failure that was found and corrected is a case of `regressions_of_random_specifications`.
//! Naive: combinations of ranges that were never tested.
//!
//! `FRETWEAR_DRAWS` sets the number of runs, `FRETWEAR_SEED` (0 to 255) the seed.

use std::str::FromStr;

use proptest::collection::vec;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use server::spec::{self, Refused};
use solver::SolveError;
use solver::cycle::CycleError;
use solver::scene::Scene;

use super::draws::{NUMBERS, specification};
use super::invariants::faults;
use super::run::solve_part;

/// Default number of runs; other draws are refused or too expensive.
const DRAWS: usize = 200;
/// Largest number of draws for each run.
const DRAWN_FOR_ONE: usize = 20;
/// Computed cycles of a run.
const MOST_CYCLES: usize = 8;
/// At most one run in this many may end without a result.
const FAILURES_ONE_IN: usize = 25;

fn setting<T: FromStr>(name: &str, default: T) -> T {
    let text = std::env::var(name).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Checks whether a scene takes seconds at most.
fn is_cheap(scene: &Scene) -> bool {
    let model = solver::model::build(scene, &solver::effects::plan(scene))
        .expect("what is accepted can be meshed");
    let spines = model.bodies.receptacle.layout.x.len() + model.bodies.slider.layout.x.len();
    let dofs = model.bodies.receptacle.dofs() + model.bodies.slider.dofs();
    let way = scene.motion.amplitude_mm() / model.sizes.hertz_half_width;
    spines <= 400
        && dofs <= 20_000
        && (scene.accuracy.increments_per_cycle.is_some() || way <= 60.0)
}

#[test]
fn any_specification_is_refused_or_satisfies_the_invariants_or_fails_with_numbers() {
    let seed = TestRng::from_seed(RngAlgorithm::ChaCha, &[setting("FRETWEAR_SEED", 1); 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), seed);
    let numbers = vec(0.0..1.0_f64, NUMBERS);
    let (mut ran, mut unsound, mut failed) = (0, Vec::new(), Vec::new());
    let draws = setting("FRETWEAR_DRAWS", DRAWS);
    let mut drawn = 0;
    for draw in 0..DRAWN_FOR_ONE * draws {
        if ran == draws {
            break;
        }
        drawn = draw + 1;
        let tree = numbers.new_tree(&mut runner).expect("numbers can be drawn");
        let spec = specification(&tree.current());
        let scene = match spec::read(spec.to_string().as_bytes()) {
            Ok(resolved) => resolved.scene,
            Err(Refused::Faults(faults)) => {
                assert!(
                    faults.iter().all(|fault| fault.pointer.starts_with('/')),
                    "{faults:?}"
                );
                continue;
            }
            Err(Refused::Parse(error)) => panic!("draw {draw} cannot be read: {error}\n{spec}"),
        };
        if !is_cheap(&scene) {
            continue;
        }
        ran += 1;
        let run = solve_part(scene, MOST_CYCLES);
        // A contact that melts is no failure of the solve.
        let melts = matches!(&run.end, Err(SolveError::Cycle(CycleError::Melts { .. })));
        if let (Err(error), false) = (&run.end, melts) {
            failed.push(format!("draw {draw}: {error}\n{spec}"));
        }
        let faults = faults(&run);
        if !faults.is_empty() {
            unsound.push(format!("draw {draw}: {}\n{spec}", faults.join("\n")));
        }
    }
    println!(
        "of {drawn} draws {ran} ran, {} of them to no contact state",
        failed.len()
    );
    for reason in &failed {
        println!("{reason}");
    }
    assert!(unsound.is_empty(), "{}", unsound.join("\n"));
    assert!(
        ran == draws,
        "of {drawn} draws only {ran} were accepted and small"
    );
    assert!(
        failed.len() * FAILURES_ONE_IN <= ran,
        "of {ran}: {}",
        failed.join("\n")
    );
}
