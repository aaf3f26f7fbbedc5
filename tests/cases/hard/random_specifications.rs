//! Requirement: any specification from the documented ranges is refused with pointers, or runs and satisfies the
//! invariants, or ends with an error that contains its numbers; of a section, and of all other dimensions.
//! Source: contract.md; every failure that was found and corrected is a case of `regressions_of_random_specifications`.
//! Naive: combinations of ranges that were never tested.
//!
//! `FRETWEAR_DRAWS` sets the number of runs, `FRETWEAR_SEED` (0 to 255) the seed.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::str::FromStr;

use proptest::collection::vec;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde_json::Value;
use server::spec::{self, Refused};
use solver::SolveError;
use solver::closed_form;
use solver::cycle::CycleError;
use solver::model::{self, Model};
use solver::scene::Effect;
use solver::scene::{Dimension, Scene};
use solver::station::StationScene;

use super::draws::{self, dimensions};
use super::invariants::{across, faults};
use super::run::{Run, solve_part};

/// Largest number of draws for each run.
const DRAWN_FOR_ONE: usize = 20;
/// At most one run in this many may end without a result.
const FAILURES_ONE_IN: usize = 25;

/// Kind of specifications that are drawn, and the checks of their runs.
struct Trial {
    /// Random numbers of a draw.
    numbers: usize,
    specification: fn(&[f64]) -> Value,
    /// Checks whether a scene takes seconds at most.
    is_cheap: fn(&Scene) -> bool,
    faults: fn(&Run) -> Vec<String>,
    /// Default number of runs; other draws are refused or too expensive.
    draws: usize,
    /// Computed cycles of a run.
    most_cycles: usize,
}

/// Results of the runs of a trial.
#[derive(Default)]
struct Found {
    drawn: usize,
    ran: usize,
    unsound: Vec<String>,
    failed: Vec<String>,
}

fn setting<T: FromStr>(name: &str, default: T) -> T {
    let text = std::env::var(name).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(default)
}

fn meshed(scene: &Scene) -> Model {
    model::build(scene, &solver::effects::plan(scene)).expect("what is accepted can be meshed")
}

/// Nodes of both surfaces, degrees of freedom of both bodies.
fn size(model: &Model) -> (usize, usize) {
    let bodies = &model.bodies;
    (
        bodies.receptacle.layout.x.len() + bodies.slider.layout.x.len(),
        bodies.receptacle.dofs() + bodies.slider.dofs(),
    )
}

fn is_cheap_section(scene: &Scene) -> bool {
    let model = meshed(scene);
    let (spines, dofs) = size(&model);
    let way = scene.motion.amplitude_mm() / model.sizes.hertz_half_width;
    spines <= 400
        && dofs <= 20_000
        && (scene.accuracy.increments_per_cycle.is_some() || way <= 60.0)
}

/// The same of a contact of finite width: a section for each station, of few increments; a window of few cells.
fn is_cheap_across(scene: &Scene) -> bool {
    let way = |half_width: f64| scene.motion.amplitude_mm() / half_width;
    match scene.dimension {
        Dimension::PlaneStrain => is_cheap_section(scene),
        Dimension::Point(_) => {
            let (along, across) = closed_form::half_lengths_mm(scene).expect("it is a point");
            let sticks = solver::effects::plan(scene).simulates(Effect::StickMemory);
            let round = if sticks { 2.0 } else { 10.0 };
            (1.0 / round..round).contains(&(across / along)) && way(along) <= 10.0
        }
        Dimension::Line(_) => {
            let model = meshed(scene);
            let (spines, dofs) = size(&model);
            let stations = StationScene::of(scene).map_or(0, |line| line.stations);
            spines <= 250
                && dofs <= 10_000
                && stations <= 17
                && way(model.sizes.hertz_half_width) <= 10.0
        }
        Dimension::Extruded(bodies) => {
            let model = meshed(scene);
            let (spines, dofs) = size(&model);
            let planes = bodies.layers / 2 + 1;
            spines * planes <= 500
                && dofs * planes <= 20_000
                && way(model.sizes.hertz_half_width) <= 10.0
        }
    }
}

/// The scene of a draw; none of one that is refused.
fn accepted(draw: usize, spec: &Value) -> Option<Scene> {
    match spec::read(spec.to_string().as_bytes()) {
        Ok(resolved) => Some(resolved.scene),
        Err(Refused::Faults(faults)) => {
            assert!(
                faults.iter().all(|fault| fault.pointer.starts_with('/')),
                "{faults:?}"
            );
            None
        }
        Err(Refused::Parse(error)) => panic!("draw {draw} cannot be read: {error}\n{spec}"),
    }
}

impl Found {
    /// Takes in the run of a draw.
    fn add(&mut self, trial: &Trial, (draw, spec, scene): (usize, &Value, Scene)) {
        self.ran += 1;
        let run = catch_unwind(AssertUnwindSafe(|| solve_part(scene, trial.most_cycles)));
        let Ok(run) = run else {
            self.unsound.push(format!("draw {draw} panics\n{spec}"));
            return;
        };
        // A contact that melts is no failure of the solve.
        let melts = matches!(&run.end, Err(SolveError::Cycle(CycleError::Melts { .. })));
        if let (Err(error), false) = (&run.end, melts) {
            self.failed.push(format!("draw {draw}: {error}\n{spec}"));
        }
        let faults = (trial.faults)(&run);
        if !faults.is_empty() {
            let faults = faults.join("\n");
            self.unsound.push(format!("draw {draw}: {faults}\n{spec}"));
        }
    }

    /// Prints the failures.
    ///
    /// # Panics
    /// Where there are too many, or an invariant does not hold.
    fn check(&self, draws: usize) {
        let Self { drawn, ran, .. } = self;
        println!(
            "of {drawn} draws {ran} ran, {} of them to no contact state",
            self.failed.len()
        );
        for reason in &self.failed {
            println!("{reason}");
        }
        assert!(self.unsound.is_empty(), "{}", self.unsound.join("\n"));
        assert!(
            *ran == draws,
            "of {drawn} draws only {ran} were accepted and small"
        );
        assert!(
            self.failed.len() * FAILURES_ONE_IN <= *ran,
            "of {ran}: {}",
            self.failed.join("\n")
        );
    }
}

impl Trial {
    fn of_sections(draws: usize) -> Self {
        Self {
            numbers: draws::NUMBERS,
            specification: draws::specification,
            is_cheap: is_cheap_section,
            faults,
            draws,
            most_cycles: 8,
        }
    }

    fn of_other_dimensions(draws: usize) -> Self {
        Self {
            numbers: dimensions::NUMBERS,
            specification: dimensions::specification,
            is_cheap: is_cheap_across,
            faults: across::faults,
            draws,
            most_cycles: 5,
        }
    }
}

fn run(trial: &Trial) {
    let seed = TestRng::from_seed(RngAlgorithm::ChaCha, &[setting("FRETWEAR_SEED", 1); 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), seed);
    let numbers = vec(0.0..1.0_f64, trial.numbers);
    let draws = setting("FRETWEAR_DRAWS", trial.draws);
    let mut found = Found::default();
    for draw in 0..DRAWN_FOR_ONE * draws {
        if found.ran == draws {
            break;
        }
        found.drawn = draw + 1;
        let tree = numbers.new_tree(&mut runner).expect("numbers can be drawn");
        let spec = (trial.specification)(&tree.current());
        let Some(scene) = accepted(draw, &spec) else {
            continue;
        };
        if (trial.is_cheap)(&scene) {
            found.add(trial, (draw, &spec, scene));
        }
    }
    found.check(draws);
}

#[test]
fn any_specification_is_refused_or_satisfies_the_invariants_or_fails_with_numbers() {
    run(&Trial::of_sections(80));
}

#[test]
fn any_specification_in_three_dimensions_is_refused_or_satisfies_the_invariants_or_fails_with_numbers()
 {
    run(&Trial::of_other_dimensions(40));
}

mod long {
    use super::{Trial, run};

    #[test]
    #[ignore = "long: takes 10 s"]
    fn any_specification_is_refused_or_satisfies_the_invariants_or_fails_with_numbers() {
        run(&Trial::of_sections(200));
    }

    #[test]
    #[ignore = "long: takes 30 s"]
    fn any_specification_in_three_dimensions_is_refused_or_satisfies_the_invariants_or_fails_with_numbers()
     {
        run(&Trial::of_other_dimensions(120));
    }
}
