//! The same motion to the other side first.
//!
//! Every drawn scene is its own mirror image except for the direction in which its initial quarter goes, and a negative
//! amplitude turns that. No specification can ask for one: the integrator is run on the model of the positive amplitude, with
//! increments and jumps given, because they would be chosen by the amplitude's sign. Profiles, pressures and worn areas are
//! then mirrored.
//!
//! Allowed: what the convergence of an increment leaves, a gap of 1e-11 of the indentation, and the round-off of sums in the
//! opposite order, times the number of increments (4 x 40) and the condition of the contact's compliance (1e4): 1e-6 of
//! the largest value is generous, and far below any jump of a node from one status to another.

use solver::SolveError;
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::scene::{Motion, Scene};
use solver::sides::Side;

use super::comparison::Deviation;
use super::{ALL, holds, holds_plated};
use crate::verification::random_scenes::Drawn;

/// Computed cycles, each of so many physical ones.
const COMPUTED: u64 = 4;
const JUMP: u64 = 2;
const INCREMENTS: u32 = 40;
const ALLOWED: f64 = 1e-6;

fn mirrored(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.motion = Motion::Reciprocating {
        amplitude_mm: -scene.motion.amplitude_mm(),
        period_s: 1.0,
    };
    scene
}

/// Largest difference of a list and another from its end, times a sign, over the largest value.
fn apart(one: &[f64], other: &[f64], sign: f64) -> f64 {
    let pairs = one.iter().zip(other.iter().rev());
    let largest = one.iter().fold(f64::MIN_POSITIVE, |m, a| m.max(a.abs()));
    pairs.map(|(a, b)| (a - sign * b).abs()).fold(0.0, f64::max) / largest
}

fn the_mirror_image(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    let mut scene = drawn.scene.clone();
    scene.accuracy.cycle_jump = Some(JUMP);
    scene.accuracy.increments_per_cycle = Some(INCREMENTS);
    let model = solver::model::build(&scene, &solver::effects::plan(&scene))?;
    let condensed = condense(&model, 1)?;
    let operators = &condensed.operators;
    let integrate = |scene: &Scene| -> Result<CycleState, SolveError> {
        let mut state = CycleState::start(operators, model.interface.slave);
        let mut integrator = Integrator::new(scene, &model, operators);
        integrator.apply_load(&mut state)?;
        integrator.initial_quarter(&mut state)?;
        while state.cycle < COMPUTED * JUMP {
            integrator.compute_cycle(&mut state, COMPUTED * JUMP, true)?;
        }
        Ok(state)
    };
    let (right, left) = (integrate(&scene)?, integrate(&mirrored(&scene))?);
    let deviation = |quantity: String, found| Deviation {
        quantity,
        found,
        allowed: ALLOWED,
    };
    let mut deviations = vec![
        deviation(
            "pressure".to_owned(),
            apart(&right.contact.pressure, &left.contact.pressure, 1.0),
        ),
        deviation(
            "shear".to_owned(),
            apart(&right.contact.shear, &left.contact.shear, -1.0),
        ),
    ];
    for side in Side::BOTH {
        deviations.push(deviation(
            format!("profile of the {}", side.name()),
            apart(right.depth.of(side), left.depth.of(side), 1.0),
        ));
    }
    Ok(Some(deviations))
}

#[test]
fn mirrored_motion_gives_the_mirror_image() {
    holds("mirrored motion", &ALL, the_mirror_image);
}

#[test]
fn mirrored_motion_of_plated_bodies_gives_the_mirror_image() {
    holds_plated("mirrored motion", &ALL, the_mirror_image);
}
