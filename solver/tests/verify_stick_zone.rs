//! The fully worn state of partial slip: wear removes the pressure of the slip zone, and the stick zone stands for ever.
//!
//! ```text
//!   p, q  |      .             .          inside |x| < c, with E* = E / (2 (1 - nu^2)) for two equal bodies:
//!         |     /|             |\           p = E*/(2R) sqrt(c^2 - x^2) + (P - pi E* c^2/(4R)) / (pi sqrt(c^2 - x^2))
//!         |    / '--.._____..--' \          q = Q / (pi sqrt(c^2 - x^2)) at the turning point
//!         |___/___________________\___      outside: no pressure
//!        -a  -c         0          c  a     c^2 / a^2 = 1 - Q/(mu P), where q/p at the edge is mu exactly
//! ```
//! Ciavarella and Hills 1999; Goryacheva, Rajeev and Farris 2001. The state is marginal: an engine that lets the edge slip
//! by an error of q/p in any increment erodes it further in each cycle.

use std::f64::consts::PI;

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::record::{DepthProfile, Position, Snapshot, TractionField};
use solver::scene::{Friction, Motion, Scene, WearLaw};
use solver::sides::{Side, Sides};

const RADIUS: f64 = 6.0;
const LOAD: f64 = 120.0;
const FRICTION: f64 = 0.6;
const CYCLES: [u64; 3] = [2_000, 10_000, 50_000];

fn contact_modulus() -> f64 {
    200e3 / (2.0 * (1.0 - 0.3 * 0.3))
}

/// A cylinder of 6 mm at 120 N/mm and +-1.2 um, of which one body wears.
fn scene(worn: Side) -> Scene {
    let mut scene = mccoll();
    let wear = |side| {
        (side == worn).then_some(WearLaw::Archard {
            k_over_h_per_mpa: 3e-6,
        })
    };
    (scene.slider.wear, scene.receptacle.wear) = (wear(Side::Slider), wear(Side::Receptacle));
    scene.slider.shape.half_width_mm = RADIUS;
    scene.friction = Friction::Coulomb {
        coefficient: FRICTION,
    };
    scene.load_n_per_mm = LOAD;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.0012,
        period_s: 1.0,
    };
    scene.output.snapshots_at_cycles = CYCLES.to_vec();
    scene
}

/// Half the unworn length around x = 0, and the spacing of nodes at its edge, mm. A node belongs to it if it has lost less
/// than a thousandth of the deepest wear.
fn unworn(profile: &DepthProfile) -> (f64, f64) {
    let deepest = profile.depth_mm.iter().fold(0.0, |m: f64, d| m.max(*d));
    let x = &profile.x_mm;
    let middle = x.partition_point(|x| *x < 0.0);
    let is_worn = |i: &usize| profile.depth_mm[*i] > 1e-3 * deepest;
    let right = (middle..x.len()).find(is_worn).expect("a slip zone");
    let left = (0..middle).rev().find(is_worn).expect("a slip zone");
    let between = |i: usize, j: usize| 0.5 * (x[i] + x[j]);
    let half = 0.5 * (between(right - 1, right) - between(left, left + 1));
    (half, x[right] - x[right - 1])
}

/// Integral of a traction over its nodes, N/mm.
fn resultant(field: &TractionField, traction: &[f64]) -> f64 {
    let x = field.x_mm.windows(2).map(|x| x[1] - x[0]);
    let means = traction.windows(2).map(|t| 0.5 * (t[0] + t[1]));
    x.zip(means).map(|(dx, t)| dx * t).sum()
}

/// Largest error of the pressures within seven tenths of a stick zone, over the pressure in its middle.
fn pressure_error(field: &TractionField, edge: f64) -> f64 {
    let stiffness = contact_modulus() / (2.0 * RADIUS);
    let singular = LOAD / PI - 0.5 * stiffness * edge.powi(2);
    let closed = |x: f64| {
        let root = (edge * edge - x * x).sqrt();
        stiffness * root + singular / root
    };
    let inside = field.x_mm.iter().zip(&field.pressure_mpa);
    let inside = inside.filter(|(x, _)| x.abs() < 0.7 * edge);
    let errors = inside.map(|(x, p)| (p - closed(*x)).abs() / closed(0.0));
    errors.fold(0.0, f64::max)
}

fn assert_stands(snapshot: &Snapshot, worn: Side) {
    let hertz = (4.0 * LOAD * RADIUS / (PI * contact_modulus())).sqrt();
    let profiles = Sides {
        slider: &snapshot.slider,
        receptacle: &snapshot.receptacle,
    };
    let (edge, element) = unworn(profiles.of(worn));
    let turned = snapshot.positions.iter();
    let turned = turned.filter(|field| field.position != Position::Neutral);
    for field in turned {
        let share = resultant(field, &field.shear_mpa).abs() / (FRICTION * LOAD);
        let closed = hertz * (1.0 - share).sqrt();
        let error = pressure_error(field, closed);
        println!(
            "{} worn, cycle {}, {:?}: Q/(mu P) {share:.4}, stick zone {edge:.4} mm ({closed:.4}), elements {element:.4} mm, \
             pressure off by {error:.1e}",
            worn.name(),
            snapshot.cycle,
            field.position
        );
        // The edge of a discrete stick zone lies between two nodes.
        assert!((edge - closed).abs() < element, "{edge} {closed}");
        // The scene's tolerance. Nearer to the edge the singular pressure is that of the elements: an edge half an
        // element further in changes it by 6 % at nine tenths of c.
        assert!(error < 0.02, "{error}");
    }
}

/// At 20 increments a cycle, which the tolerance of 2 % chooses, whichever body wears. Before the surfaces were
/// paired by their own displacement and both compliances were alike near a force, the edge stood at 0.055, 0.032 and 0.016 mm
/// after 10 000, 50 000 and 200 000 cycles.
#[test]
fn the_stick_zone_of_partial_slip_stands_for_ever() {
    the_stick_zone_stands(&[
        (Side::Receptacle, None, CYCLES[1]),
        (Side::Slider, None, CYCLES[0]),
    ]);
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes 8 s"]
    fn the_stick_zone_stands_with_finer_increments() {
        the_stick_zone_stands(&[(Side::Receptacle, Some(80), CYCLES[0])]);
    }

    #[test]
    #[ignore = "long: takes 8 s"]
    fn the_stick_zone_stands_for_more_cycles() {
        the_stick_zone_stands(&[
            (Side::Receptacle, None, CYCLES[2]),
            (Side::Slider, None, CYCLES[1]),
        ]);
    }
}

/// Runs with one worn side, increments of a cycle, and cycles.
fn the_stick_zone_stands(runs: &[(Side, Option<u32>, u64)]) {
    for &(worn, increments, cycles) in runs {
        let mut scene = scene(worn);
        scene.cycles = cycles;
        scene.accuracy.increments_per_cycle = increments;
        let (_, run) = solve(&scene).expect("the scene can be solved");
        for snapshot in run
            .snapshots
            .iter()
            .filter(|snapshot| CYCLES.contains(&snapshot.cycle))
        {
            assert_stands(snapshot, worn);
        }
    }
}
