//! Other units: all lengths times 2^p and all stresses times 2^q.
//!
//! Nothing in the engine has a unit of its own. Powers of four are exact in every sum, product and square root (of the
//! stiffness, in its factors), so the answer has the same bits but for its exponents. Allowed: nothing; with odd powers of
//! two, round-off. A constant in mm or MPa, or a limit below which something counts as zero, is a violation.

use solver::SolveError;
use solver::record::{DepthProfile, Snapshot};
use solver::scene::{Motion, Scene};

use super::comparison::Deviation;
use super::{ALL, holds, holds_plated};
use crate::verification::random_scenes::{Drawn, scale_wear};
use crate::verification::recorder::solve;

/// The scene with its lengths and stresses multiplied.
fn in_other_units(scene: &Scene, length: f64, stress: f64) -> Scene {
    let mut other = scene.clone();
    let (slider, block) = (&mut other.slider.shape, &mut other.receptacle.shape);
    slider.radius_mm *= length;
    slider.half_width_mm *= length;
    slider.height_mm *= length;
    block.length_mm *= length;
    block.height_mm *= length;
    block.crown_radius_mm = block.crown_radius_mm.map(|radius| radius * length);
    other.slider.elastic.youngs_modulus_mpa *= stress;
    other.receptacle.elastic.youngs_modulus_mpa *= stress;
    scale_wear(&mut other, stress.recip());
    let (slider, receptacle) = (&mut other.slider.plating, &mut other.receptacle.plating);
    for layer in slider.iter_mut().chain(receptacle) {
        layer.thickness_mm *= length;
    }
    other.load_n_per_mm *= length * stress;
    other.spring_n_per_mm2 *= stress;
    if let Motion::Reciprocating { amplitude_mm, .. } = &mut other.motion {
        *amplitude_mm *= length;
    }
    other
}

/// Largest difference of two lists over the largest value.
fn apart(one: &[f64], other: &[f64], factor: f64) -> f64 {
    if one.len() != other.len() {
        return f64::INFINITY;
    }
    let pairs = one.iter().zip(other);
    let difference = pairs.map(|(a, b)| (a * factor - b).abs());
    let largest = one.iter().fold(f64::MIN_POSITIVE, |m, a| m.max(a.abs()));
    difference.fold(0.0, f64::max) / (largest * factor)
}

/// Factors on lengths and stresses: powers of four, and others.
const EXACT: [(f64, f64); 4] = [(16.0, 1.0), (1.0, 0.25), (0.0625, 1024.0), (1024.0, 64.0)];
const ROUNDED: [(f64, f64); 4] = [(2.0, 1.0), (1.0, 0.5), (0.125, 32.0), (512.0, 2.0)];

fn the_same_bits(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    deviations(drawn, &EXACT, 0.0)
}

fn the_same_but_for_round_off(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    // As in `mirrored_motion`.
    deviations(drawn, &ROUNDED, 1e-6)
}

fn deviations(
    drawn: &Drawn,
    factors: &[(f64, f64)],
    allowed: f64,
) -> Result<Option<Vec<Deviation>>, SolveError> {
    let (length, stress) = factors[usize::try_from(drawn.number).unwrap_or(0) % factors.len()];
    let (_, here) = solve(&drawn.scene)?;
    let (_, there) = solve(&in_other_units(&drawn.scene, length, stress))?;
    let [here, there] = [&here, &there].map(|run| &run.snapshots[run.snapshots.len() - 1]);
    let profiles =
        |of: fn(&Snapshot) -> &DepthProfile| apart(&of(here).depth_mm, &of(there).depth_mm, length);
    let pressures = here.positions.iter().zip(&there.positions);
    let pressures = pressures.map(|(a, b)| apart(&a.pressure_mpa, &b.pressure_mpa, stress));
    let deviation = |quantity: &str, found| Deviation {
        quantity: quantity.to_owned(),
        found,
        allowed,
    };
    Ok(Some(vec![
        deviation(
            "receptacle profile",
            profiles(|snapshot| &snapshot.receptacle),
        ),
        deviation("slider profile", profiles(|snapshot| &snapshot.slider)),
        deviation("pressures", pressures.fold(0.0, f64::max)),
    ]))
}

#[test]
fn scaled_units_change_no_bit() {
    holds("units scaled by powers of four", &ALL, the_same_bits);
}

#[test]
fn scaled_units_change_nothing_but_round_off() {
    holds(
        "units scaled by odd powers of two",
        &ALL,
        the_same_but_for_round_off,
    );
}

#[test]
fn scaled_units_change_no_bit_of_plated_bodies() {
    holds_plated("units scaled by powers of four", &ALL, the_same_bits);
}

#[test]
fn scaled_units_change_nothing_but_round_off_of_plated_bodies() {
    holds_plated(
        "units scaled by odd powers of two",
        &ALL,
        the_same_but_for_round_off,
    );
}
