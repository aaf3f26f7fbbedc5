//! Wear laws whose rate depends on history, time or speed, in whole runs: short strokes, in which both bodies may wear one scar, and
//! grooves. Increments or jumps half as long change depth and area by less than the tolerance, bodies that are swapped wear alike, and
//! a resumed run reaches the same bits.

mod barwell;
mod oxidational;
mod power;

use crate::verification::recorder::{Recorder, largest_distance, solve};
use crate::verification::scenes::{mccoll, sprung_contact};
use solver::record::{DepthProfile, SideReport, Summary};
use solver::scene::{Accuracy, BlockShape, Friction, Motion, Scene, SliderShape, WearLaw};
use solver::sides::{Side, Sides};

const TOLERANCE: f64 = 0.02;

/// Amplitudes of a stroke much shorter than the scar is wide, and of a groove, mm, with cycles for each.
const SHORT: (f64, u64) = (0.004, 4_000);
const LONG: (f64, u64) = (0.1, 800);

/// A contact whose sides wear by a law, or do not.
fn scene((amplitude_mm, cycles): (f64, u64), law: WearLaw, sides: &[Side]) -> Scene {
    let mut scene = sprung_contact();
    let of = |side| sides.contains(&side).then_some(law);
    scene.slider.wear = of(Side::Slider);
    scene.receptacle.wear = of(Side::Receptacle);
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    };
    scene.cycles = cycles;
    scene.accuracy = Accuracy::from_tolerance(TOLERANCE);
    scene
}

fn reports(summary: &Summary) -> Sides<SideReport> {
    Sides {
        slider: summary.last.slider,
        receptacle: summary.last.receptacle,
    }
}

/// Largest relative difference of depth and area on either side.
fn difference(one: &Summary, other: &Summary) -> f64 {
    let pairs = reports(one).zip(reports(other));
    let of = |(one, other): (SideReport, SideReport)| {
        let relative = |a: f64, b: f64| if b > 0.0 { (a / b - 1.0).abs() } else { 0.0 };
        relative(one.max_depth_mm, other.max_depth_mm)
            .max(relative(one.worn_area_mm2, other.worn_area_mm2))
    };
    let found = pairs.map(of);
    found.slider.max(found.receptacle)
}

/// Solves a scene as it is, with increments, then with jumps half as long.
fn check_refinement(name: &str, scene: &Scene) {
    let run = |scene: &Scene| solve(scene).expect("the scene can be solved");
    let (base, profile) = run(scene);
    let mut shorter = scene.clone();
    shorter.accuracy.refinement.increments = 2.0;
    let (increments, fine) = run(&shorter);
    let mut jumps = scene.clone();
    jumps.accuracy.refinement.cycles = 2.0;
    let (jumps, finer) = run(&jumps);
    let found = [
        difference(&base, &increments),
        difference(&base, &jumps),
        largest_distance(profile.last_profile(), fine.last_profile()),
        largest_distance(profile.last_profile(), finer.last_profile()),
    ];
    println!(
        "{name}: increments half as long change depth and area by {:.1e}, jumps by {:.1e}; the profile by {:.1e} and {:.1e}",
        found[0], found[1], found[2], found[3]
    );
    assert!(found[0] < TOLERANCE && found[1] < TOLERANCE, "{found:?}");
}

/// Two arcs, which are the same upside down, with a law on each.
fn arcs((upper, lower): (f64, f64), laws: &Sides<WearLaw>) -> Scene {
    let mut scene = Scene {
        cycles: 2_000,
        friction: Friction::Coulomb { coefficient: 0.6 },
        ..mccoll()
    };
    scene.slider.shape = SliderShape {
        radius_mm: upper,
        half_width_mm: 3.0,
        height_mm: 4.0,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 6.0,
        height_mm: 4.0,
        crown_radius_mm: Some(lower),
    };
    scene.slider.wear = Some(laws.slider);
    scene.receptacle.wear = Some(laws.receptacle);
    scene
}

/// Bodies with a law each wear alike where they are swapped, within twice the tolerance.
fn check_swap(name: &str, laws: &Sides<WearLaw>) {
    let turned = Sides {
        slider: laws.receptacle,
        receptacle: laws.slider,
    };
    let run = |scene: &Scene| solve(scene).expect("the scene can be solved").0;
    let (here, mut there) = (
        run(&arcs((6.0, 9.0), laws)),
        run(&arcs((9.0, 6.0), &turned)),
    );
    let last = &mut there.last;
    std::mem::swap(&mut last.slider, &mut last.receptacle);
    let found = difference(&here, &there);
    println!("{name}: swapped bodies differ by {found:.1e}");
    assert!(found < 2.0 * TOLERANCE, "{found}");
}

/// The law of the other body.
const ARCHARD: WearLaw = WearLaw::Archard {
    k_over_h_per_mpa: 2e-8,
};

/// Integral of a function of the depth over a profile.
fn integral(profile: &DepthProfile, of: impl Fn(f64) -> f64) -> f64 {
    let x = &profile.x_mm;
    let last = x.len() - 1;
    let nodes = profile.depth_mm.iter().enumerate();
    nodes
        .map(|(i, depth)| 0.5 * (x[(i + 1).min(last)] - x[i.saturating_sub(1)]) * of(*depth))
        .sum()
}

fn last_profile(run: &Recorder, side: Side) -> &DepthProfile {
    let last = run.snapshots.last().expect("a snapshot at the end");
    match side {
        Side::Slider => &last.slider,
        Side::Receptacle => &last.receptacle,
    }
}
