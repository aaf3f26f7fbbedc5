//! The pressures reported along a scar are those of a run of single cycles, at every named position.
//!
//! A jump wears the passes of its cycles one after the other, so that a computed cycle leaves the scar deeper where its last
//! pass ended. That is a thousandth of the depth, and a tenth of the pressure. Where a report follows a short jump, the skew is
//! still that of the long ones before.

use crate::verification::recorder::solve;
use crate::verification::scenes::{partial_slip, scar, sprung_contact};
use solver::interpolation;
use solver::record::{Snapshot, TractionField};
use solver::scene::{Motion, Scene};

/// Places along the contact.
const PLACES: u32 = 1_000;

/// Largest distance of two pressure fields over the peak of the second, outside of its last few elements at either edge:
/// there the pressure falls to nothing within an element of the tolerance.
fn distance(field: &TractionField, reference: &TractionField) -> f64 {
    let peak = reference
        .pressure_mpa
        .iter()
        .fold(0.0, |m: f64, p| m.max(*p));
    let loaded = reference.x_mm.iter().zip(&reference.pressure_mpa);
    let loaded: Vec<f64> = loaded.filter(|(_, p)| **p > 0.0).map(|(x, _)| *x).collect();
    let (first, last) = (loaded[0], loaded[loaded.len() - 1]);
    let inside = |i: u32| first + (last - first) * (0.1 + 0.8 * f64::from(i) / f64::from(PLACES));
    let at = |field: &TractionField, x| interpolation::linear(&field.x_mm, &field.pressure_mpa, x);
    let apart = |x: f64| (at(field, x) - at(reference, x)).abs();
    (0..=PLACES).map(inside).map(apart).fold(0.0, f64::max) / peak
}

fn snapshots(scene: &Scene) -> Vec<Snapshot> {
    let (_, recorder) = solve(scene).expect("the scene can be solved");
    let reported = recorder.snapshots.into_iter();
    reported.filter(|snapshot| snapshot.cycle > 0).collect()
}

fn pressures_along_a_scar_are_those_of_single_cycles() {
    let short_after_long = |mut scene: Scene| {
        scene.output.snapshots_at_cycles = vec![997, 1_000];
        scene.cycles = 1_000;
        scene
    };
    // The slider alone wears, and the contact is half as wide as the stroke.
    let sprung = {
        let mut scene = sprung_contact();
        (scene.slider.wear, scene.receptacle.wear) = (scene.receptacle.wear, None);
        scene.motion = Motion::Reciprocating {
            amplitude_mm: 0.01,
            period_s: 1.0,
        };
        scene
    };
    let scenes = [
        ("scar", scar(), 0.02),
        ("partial slip", partial_slip(), 0.002),
        ("worn slider", sprung, 0.01),
    ];
    for (name, scene, bound) in scenes {
        let scene = short_after_long(scene);
        let mut single = scene.clone();
        single.accuracy.cycle_jump = Some(1);
        let (jumps, single) = (snapshots(&scene), snapshots(&single));
        assert_eq!(jumps.len(), 2, "{name}");
        for (snapshot, reference) in jumps.iter().zip(&single) {
            for (field, reference) in snapshot.positions.iter().zip(&reference.positions) {
                let off = distance(field, reference);
                println!(
                    "{name}, cycle {}, {:?}: pressure off by {off:.4} of its peak",
                    snapshot.cycle, field.position
                );
                assert!(off < bound, "{name}: {off}");
            }
        }
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 19 s"]
    fn pressures_along_a_scar_are_those_of_single_cycles() {
        super::pressures_along_a_scar_are_those_of_single_cycles();
    }
}
