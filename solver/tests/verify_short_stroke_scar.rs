//! Gross slip over a short stroke: the flat takes the shape of the cylinder.
//!
//! ```text
//!      .-v-.  <->       worn area A = k P s, a circular segment of chord 2 b:
//!     ( R=6 )           b = (3 R A / 2)^(1/3), depth b^2/(2 R), mean pressure P/(2 b)
//!   ___`-.-'___         as elastic flattening (a^2/(2R) = 0.1 um) and the stroke (2 um) fade beside b and the depth
//! ```

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::record::Position;
use solver::scene::{Friction, Motion, Scene, WearLaw};

#[test]
fn flat_takes_the_shape_of_the_cylinder() {
    let (k, load, radius) = (1e-6, 18.5, 6.0);
    let mut scene = Scene {
        cycles: 100_000,
        motion: Motion::Reciprocating {
            amplitude_mm: 0.002,
            period_s: 1.0,
        },
        friction: Friction::Coulomb { coefficient: 0.1 },
        ..mccoll()
    };
    scene.slider.wear = None;
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: k,
    });
    scene.output.snapshots_at_cycles = vec![100_000];
    let (summary, recorder) = solve(&scene).expect("the scene can be solved");
    let area = summary.last.receptacle.worn_area_mm2;
    let half_width = (1.5_f64 * radius * area).cbrt();
    let depth = half_width * half_width / (2.0 * radius);
    let slipped = area / (k * load * summary.last.sliding_distance_mm);
    let ratio = summary.last.receptacle.max_depth_mm / depth - 1.0;
    let width = summary.last.receptacle.scar_half_width_mm / half_width - 1.0;
    println!(
        "short stroke: depth off by {ratio:.1e}, half-width by {width:.1e}, slip over motion {slipped:.3}"
    );
    assert!(ratio.abs() < 0.01 && width.abs() < 0.01, "{ratio} {width}");
    // The contact sticks for part of the stroke, so it slips less than it moves.
    assert!(slipped > 0.8 && slipped < 1.0, "{slipped}");
    let field = &recorder
        .snapshots
        .last()
        .expect("the last cycle has a snapshot")
        .positions
        .iter()
        .find(|field| field.position == Position::Neutral)
        .expect("every cycle passes it");
    let mean = load / (2.0 * half_width);
    // Uniform except for elasticity: at the turning points the arc is beside the middle of its trough and presses on
    // the far side, so the outer parts wear more there and less in between.
    let inner = field.x_mm.iter().zip(&field.pressure_mpa);
    for (x, p) in inner.filter(|(x, _)| x.abs() < 0.8 * half_width) {
        assert!((p / mean - 1.0).abs() < 0.2, "{x} {p} {mean}");
    }
}
