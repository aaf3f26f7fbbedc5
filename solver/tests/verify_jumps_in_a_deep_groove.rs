//! Cycle jumps in a groove deeper than the slider's radius, against single cycles on the same mesh.
//!
//! The contact of a computed cycle rests on the leading-edge step of its whole jump: it is sqrt(jump) times as wide as that of
//! a single cycle, and at the turning points it extends farther up the walls. They wear faster and further out, and on their
//! slopes the normal force, and with it the worn area, is larger. The error grows with the excess of the contact's
//! width, not in proportion to the jump, so the coarse companions of a run, whose jumps are three and four times as long, differ
//! by less than the run is off: its estimate of the worn area is far too low.
//!
//! `FRETWEAR_TOLERANCE=0.02 cargo test --release -p solver deep_groove -- --nocapture` prints it for another tolerance.

use crate::recorder::{area_between, largest_distance, solve};
use crate::scenes::fuzz_button;

#[test]
fn jumps_in_a_deep_groove_are_within_the_tolerance_of_single_cycles() {
    let tolerance = std::env::var("FRETWEAR_TOLERANCE");
    let tolerance = tolerance.map_or(0.05, |given| given.parse().expect("a tolerance"));
    let worn = |cycle_jump: Option<u64>| {
        let mut scene = fuzz_button();
        scene.accuracy.tolerance = tolerance;
        scene.accuracy.cycle_jump = cycle_jump;
        scene.output.snapshots_at_cycles.clear();
        let (summary, recorder) = solve(&scene).expect("the scene can be solved");
        (summary.last.receptacle, recorder.last_profile().clone())
    };
    let ((jumps, profile), (single, exact)) = (worn(None), worn(Some(1)));
    let depth = jumps.max_depth_mm / single.max_depth_mm - 1.0;
    let area = jumps.worn_area_mm2 / single.worn_area_mm2 - 1.0;
    let (largest, between) = (
        largest_distance(&profile, &exact),
        area_between(&profile, &exact),
    );
    println!(
        "deep groove at {tolerance}: depth off by {depth:+.2e}, area by {area:+.2e}, profile by {largest:.2e} at most, \
         {between:.2e} in area"
    );
    let errors = [depth.abs(), area.abs(), largest];
    assert!(errors.iter().all(|error| *error < tolerance), "{errors:?}");
}
