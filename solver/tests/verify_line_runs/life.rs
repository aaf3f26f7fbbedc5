//! Worn volumes and lives of runs along lines.

use super::{CROWN, GOLD, done, spring};
use solver::record::Outcome;
use solver::scene::{Accuracy, Criterion, Dimension};
use solver::sides::Side;

/// A tenth and ten times the force. The volume is k F s but for the walls of the groove, which are flat: 1 %; reached: 1e-7.
#[test]
fn the_volume_of_a_line_goes_with_its_force() {
    let volumes = [0.1, 1.0, 10.0].map(|factor| {
        let mut scene = spring(Some(CROWN), (GOLD, GOLD), 100);
        scene.accuracy = Accuracy::from_tolerance(0.1);
        scene.load_n_per_mm *= factor;
        if let Dimension::Line(line) = &mut scene.dimension {
            line.force_n *= factor;
        }
        let last = done(&scene).last;
        last.slider.worn_volume_mm3.expect("a volume") / factor
    });
    println!("line: volume over force {volumes:?} mm^3/N");
    for volume in volumes {
        assert!((volume / volumes[1] - 1.0).abs() < 0.01);
    }
}

/// The life by a depth is the cycle at which a run stops at it, within the last jump before it, a hundredth. Half of the scar is through later than
/// its deepest place.
#[test]
fn the_life_of_a_line_is_where_its_run_stops() {
    let mut scene = spring(Some(CROWN), (GOLD, GOLD), 1_500);
    scene.accuracy = Accuracy::from_tolerance(0.1);
    let criterion = Criterion::deepest(Side::Slider, 0.15e-3);
    scene.life = vec![
        criterion,
        Criterion {
            part: 0.5,
            ..criterion
        },
    ];
    let lives = done(&scene).life.criteria;
    let life = lives[0].cycles.expect("it is reached");
    assert!(lives[1].cycles.is_none_or(|half| half > 2.0 * life));
    scene.life.clear();
    scene.stop = vec![criterion];
    let stopped = done(&scene);
    assert_eq!(stopped.outcome, Outcome::StopCondition);
    let cycles = f64::from(u32::try_from(stopped.last.cycle).expect("it is small"));
    println!("line: life {life:.0}, stopped after {cycles} cycles");
    assert!((life / cycles - 1.0).abs() < 0.01);
}
