//! A sprung contact loses its force as it wears.
//!
//! ```text
//!     /\/\/\  k_spring           on the flat floor of a groove every cycle wears h by 2 k P and the slider sinks
//!      .-v-.                     with it: dP/dN = -k_spring dh/dN = -2 k k_spring P, so
//!     (     ) <->                P = P0 exp(-N/N0), h = (P0 / k_spring) (1 - exp(-N/N0)), N0 = 1/(2 k k_spring)
//!   ~~~~`-'~~~~
//! ```

use crate::verification::recorder::solve;
use crate::verification::scenes::{COPPER_WEAR, fuzz_button};
use solver::scene::{Drive, Scene};

#[test]
fn force_and_depth_fade_exponentially_with_either_drive() {
    let cycles = 150.0;
    let spring = 0.5 / (2.0 * COPPER_WEAR * cycles);
    for drive in [Drive::Handle, Drive::WholeBody] {
        let scene = Scene {
            cycles: 150,
            drive,
            spring_n_per_mm2: spring,
            ..fuzz_button()
        };
        let (summary, recorder) = solve(&scene).expect("the scene can be solved");
        let fade = (-0.5_f64).exp();
        let load = recorder.at(150).load_n_per_mm / (0.508 * fade);
        let depth = recorder.at(150).station_depth_mm[3] / (0.508 / spring * (1.0 - fade));
        println!("spring, {drive:?}: load {load:.4}, depth {depth:.4} of the closed solution");
        // The tolerance of the run is 2 %; the hollowing of the floor is 0.5 % by cycle 150.
        assert!((load - 1.0).abs() < 0.01 && (depth - 1.0).abs() < 0.015);
        assert!(summary.last.receptacle.ideal_area_mm2.is_none());
        assert!(summary.checks.force_balance < 1e-12 && summary.checks.worn_area < 1e-12);
    }
}
