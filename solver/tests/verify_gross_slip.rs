//! Gross slip: once all of the contact slides, Q = mu P, and q = mu p at every place.
//!
//! ```text
//!      P ->        the cylinder of McColl's case without wear, 25 um beyond the 1 um of stick;
//!    .-v-.         shear on the block points along the slider's motion
//!   ( R=6 ) ->     (Coulomb's law, no approximation: round-off is the tolerance)
//!  __`-.-'__
//! ```

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::scene::{Friction, Scene};

#[test]
fn every_place_of_a_sliding_contact_is_on_the_friction_cone() {
    for friction in [0.1, 0.9, 1.5] {
        let mut scene = Scene {
            cycles: 1,
            friction: Friction::Coulomb {
                coefficient: friction,
            },
            ..mccoll()
        };
        scene.slider.wear = None;
        scene.receptacle.wear = None;
        scene.output.snapshots_at_cycles = vec![1];
        let (summary, recorder) = solve(&scene).expect("the scene can be solved");
        let snapshot = recorder.snapshots.last().expect("cycle 1 has a snapshot");
        for field in &snapshot.positions {
            let peak = field.pressure_mpa.iter().fold(0.0, |m: f64, p| m.max(*p));
            for (p, q) in field.pressure_mpa.iter().zip(&field.shear_mpa) {
                assert!((q.abs() - friction * p).abs() < 1e-10 * peak, "{p} {q}");
            }
        }
        let forces = &snapshot.friction_loop.tangential_force_n_per_mm;
        let largest = forces.iter().fold(0.0, |m: f64, q| m.max(q.abs()));
        println!(
            "gross slip at mu = {friction}: Q / (mu P) = {:.12}",
            largest / (friction * 18.5)
        );
        assert!((largest / (friction * 18.5) - 1.0).abs() < 1e-10);
        assert!(summary.checks.friction_use <= 1.0 + 1e-12);
    }
}
