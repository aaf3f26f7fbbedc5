//! Metamorphic relations over random scenes: two scenes whose answers must be related, whatever the answers are.
//!
//! No closed solution covers both sides worn, springs, crowns and unequal bodies at once; a relation needs none. Each file
//! holds one relation, with what it allows and why. The tests draw a dozen scenes each; more by
//! `FRETWEAR_DRAWS=200 cargo test --release -p solver metamorphic -- --nocapture`, others by `FRETWEAR_SEED`, later ones by
//! `FRETWEAR_FIRST`. A violation names its scene by seed and number (`random_scenes::draw`), which prints nothing but its
//! figures: `FRETWEAR_SEED=1 FRETWEAR_FIRST=17 FRETWEAR_DRAWS=1` runs that one alone.
//!
//! The runs estimate no errors, for speed. Where two of them differ by more than a relation allows, they are solved with error
//! control: then they must agree, or differ by no more than the errors that they state.

mod comparison;
mod halved_wear_rate;
mod longer_block;
mod mirrored_motion;
mod moved_wear;
mod plated_bodies;
mod refined_tolerance;
mod scaled_units;
mod split_run;
mod swapped_bodies;

use std::str::FromStr;

use comparison::Deviation;
use solver::SolveError;

use crate::verification::random_scenes::{Drawn, Regime, draw};

/// The accuracy that most specifications ask for.
const TOLERANCE: f64 = 0.02;
/// Most estimated processor seconds of a scene: the suite takes under a minute of one core.
const MOST_S: f64 = 0.15;
const DRAWS: u64 = 12;

const ALL: [Regime; 3] = [Regime::PartialSlip, Regime::ShortStroke, Regime::LongGroove];
const SLIDING: [Regime; 2] = [Regime::ShortStroke, Regime::LongGroove];
const STICKING: [Regime; 1] = [Regime::PartialSlip];

/// A relation: the deviations of a scene's answer from that of its relative; `None` if the scene has no relative.
type Relation = fn(&Drawn) -> Result<Option<Vec<Deviation>>, SolveError>;

/// A setting of the environment.
pub(crate) fn setting<T: FromStr>(name: &str, default: T) -> T {
    let text = std::env::var(name).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Asserts that a relation holds in every drawn scene of some regimes.
fn holds(name: &str, regimes: &[Regime], relation: Relation) {
    holds_in(name, drawn(regimes), relation);
}

/// Asserts that a relation holds in every drawn scene of some regimes when its bodies are plated.
fn holds_plated(name: &str, regimes: &[Regime], relation: Relation) {
    let plated = drawn(regimes)
        .map(|drawn| plated_bodies::plated(&drawn).expect("the bare scene can be solved"));
    holds_in(&format!("{name}, plated"), plated, relation);
}

fn drawn(regimes: &[Regime]) -> impl Iterator<Item = Drawn> {
    let (seed, first) = (setting("FRETWEAR_SEED", 1), setting("FRETWEAR_FIRST", 0));
    let numbers = first..first + setting("FRETWEAR_DRAWS", DRAWS);
    let drawn = numbers.map(move |number| draw(seed, number, TOLERANCE, MOST_S));
    drawn.filter(|drawn| regimes.contains(&drawn.regime))
}

/// Asserts that a relation holds in the scenes of seed 1 with these numbers.
fn holds_in_found(name: &str, numbers: &[u64], relation: Relation) {
    let drawn = numbers
        .iter()
        .map(|number| draw(1, *number, TOLERANCE, MOST_S));
    holds_in(name, drawn, relation);
}

fn is_violated(deviations: &Result<Option<Vec<Deviation>>, SolveError>) -> bool {
    let mut found = deviations.iter().flatten().flatten();
    found.any(|deviation| !deviation.is_allowed())
}

fn holds_in(name: &str, scenes: impl Iterator<Item = Drawn>, relation: Relation) {
    let (mut compared, mut faults, mut worst) = (0, Vec::new(), Vec::new());
    for mut drawn in scenes {
        let mut deviations = relation(&drawn);
        if is_violated(&deviations) {
            println!("{}: solved with error control", drawn.name());
            drawn.scene.accuracy.estimate_errors = true;
            deviations = relation(&drawn);
        }
        match deviations {
            Ok(None) => {}
            Ok(Some(deviations)) => {
                compared += 1;
                let beyond: Vec<String> = deviations
                    .iter()
                    .filter(|deviation| !deviation.is_allowed())
                    .map(ToString::to_string)
                    .collect();
                if !beyond.is_empty() {
                    faults.push(format!("{}: {}", drawn.name(), beyond.join("; ")));
                }
                comparison::keep_worst(&mut worst, deviations);
            }
            Err(error) => faults.push(format!("{}: {error}", drawn.name())),
        }
    }
    println!("{name}, {compared} scenes, the largest deviations:");
    for deviation in &worst {
        println!("  {deviation}");
    }
    assert!(
        faults.is_empty(),
        "{name}: {} of {compared} scenes\n{}",
        faults.len(),
        faults.join("\n")
    );
}
