//! Block on ring: the slider's surface slides continuously past a contact that stays at one place of the block.
//!
//! ```text
//!       .--.            the block takes the shape of the ring: a circular segment of chord 2 b with the worn area
//!      ( -> ) R = 6     A = k P s = 2 b^3 / (3 R), so b = (3 R A / 2)^(1/3), depth b^2 / (2 R), mean pressure
//!    ___`--'___         P / (2 b), exactly once elastic flattening is small beside the depth
//! ```

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::scene::{Motion, Scene, WearLaw};

#[test]
fn block_takes_the_shape_of_the_ring() {
    let (k, load, radius, distance) = (2.9e-6, 18.5, 6.0, 300.0);
    let mut scene = Scene {
        cycles: 10_000,
        ..mccoll()
    };
    scene.motion = Motion::Continuous {
        step_mm: distance / 10_000.0,
    };
    scene.slider.wear = None;
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: k,
    });
    scene.output.snapshots_at_cycles = vec![10_000];
    let (summary, recorder) = solve(&scene).expect("the scene can be solved");
    let last = &summary.last;
    let area = k * load * distance;
    let half_width = (1.5_f64 * radius * area).cbrt();
    let depth = half_width * half_width / (2.0 * radius);
    let ratio = last.receptacle.max_depth_mm / depth - 1.0;
    let width = last.contact_half_width_mm / half_width - 1.0;
    println!("block on ring: depth off by {ratio:.1e}, half-width by {width:.1e}");
    assert!((last.sliding_distance_mm / distance - 1.0).abs() < 1e-12);
    // Gross slip: all of k P s is worn off, but for the first micrometre of stick.
    assert!((last.receptacle.worn_area_mm2 / area - 1.0).abs() < 1e-4);
    // Elastic flattening is a^2/R = 0.2 um beside a depth of 23 um: 1 %.
    assert!(
        ratio.abs() < 0.015 && width.abs() < 0.015,
        "{ratio} {width}"
    );
    let field = &recorder
        .snapshots
        .last()
        .expect("the last cycle has a snapshot")
        .positions[0];
    let mean = load / (2.0 * half_width);
    let inner = field
        .x_mm
        .iter()
        .zip(&field.pressure_mpa)
        .filter(|(x, _)| x.abs() < 0.9 * half_width);
    for (x, p) in inner {
        // Archard's rate must follow the parabola's spreading: p = k^-1 dh/ds is even to the order of elasticity.
        assert!((p / mean - 1.0).abs() < 0.05, "{x} {p} {mean}");
    }
}
