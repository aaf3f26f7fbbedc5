//! A wire that slides along itself sinks into a trough of its own section.
//!
//! ```text
//!   ____        ____      recession is normal to the wall: k p ds
//!       \  a|r /          sinking by dh, all of the trough recedes by cos(phi) dh there
//!        `.__.'
//! ```
//! The pressure p = cos(phi) dh/(k ds) carries the line load P' = int p r cos(phi) dphi, so that a trough of half-angle a and
//! depth h = r (1 - cos a) has
//!   k P' s = r^2 (sin a - a cos a + sin^3 a/3)   and the area   r^2 (a - sin a cos a),
//! which is more than k P' s: the normal force on its walls is more than the line load. Shallow troughs: 1 + a^2/10 times as much.

use super::{RADIUS, ring, solved};
use crate::verification::scenes::COPPER_WEAR;
use solver::scene::{LineShape, Motion, RingMotion, Top, WearLaw};
use solver::station::StationScene;

const WIRE: f64 = 0.0254;
const WIDE_WIRE: f64 = 0.100_005;
const WIDE_RATE: f64 = 1e-6;

/// Halvings of the interval that holds a half-angle: round-off.
const HALVINGS: usize = 60;

/// A trough: half-angle, depth and area of its section.
struct Trough {
    half_angle: f64,
    depth_mm: f64,
    area_mm2: f64,
}

/// The trough that a wire of a radius in mm has worn after k P' s in mm^2.
fn trough(radius: f64, wear: f64) -> Trough {
    let [mut low, mut high] = [0.0, 0.5 * std::f64::consts::PI];
    for _ in 0..HALVINGS {
        let a: f64 = 0.5 * (low + high);
        let worn = a.sin() - a * a.cos() + a.sin().powi(3) / 3.0;
        if radius * radius * worn < wear {
            low = a;
        } else {
            high = a;
        }
    }
    Trough {
        half_angle: low,
        depth_mm: radius * (1.0 - low.cos()),
        area_mm2: radius * radius * (low - low.sin() * low.cos()),
    }
}

/// The ring turned about its axis.
fn turned(top: Top, cycles: u64) -> StationScene {
    StationScene {
        line: LineShape::Ring {
            radius_mm: RADIUS,
            motion: RingMotion::Torsion,
        },
        ..ring(top, 2, cycles)
    }
}

/// k P' s of a scene, mm^2.
fn sliding_wear(scene: &StationScene, rate: f64) -> f64 {
    let cycles = f64::from(u32::try_from(scene.section.cycles).expect("few"));
    let amplitude = scene.section.motion.amplitude_mm();
    rate * scene.mean_line_load() * 4.0 * amplitude * cycles
}

/// A wire of 0.20001 mm in a ring of 4.2 mm, 5 N, +-0.05 mm.
fn wide_ring() -> StationScene {
    let mut scene = turned(Top::Rigid, 500);
    let slider = &mut scene.section.slider.shape;
    (slider.half_width_mm, slider.height_mm) = (WIDE_WIRE, WIDE_WIRE);
    slider.radius_mm = WIDE_WIRE;
    let receptacle = &mut scene.section.receptacle;
    (receptacle.shape.length_mm, receptacle.shape.height_mm) = (3.0 * WIDE_WIRE, 2.5 * WIDE_WIRE);
    receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: WIDE_RATE,
    });
    scene.section.motion = Motion::Reciprocating {
        amplitude_mm: 0.05,
        period_s: 1.0,
    };
    scene.force_n = 5.0;
    scene.line = LineShape::Ring {
        radius_mm: 2.1 - WIDE_WIRE,
        motion: RingMotion::Torsion,
    };
    scene
}

/// Elastic contacts are wider than the arc that has worn off, and slopes of walls are read between elements of a fraction of the unworn contact and
/// before a jump: by the part of the deepest trough that is allowed for. Without its walls the area were 0.3, 3.7 and 10.8 % less.
/// The energy is mu times the work of the pressure, mu V/k: as the wire sinks in a jump it slips down the walls at once, which no friction takes.
#[test]
fn turned_ring_sinks_into_a_trough_of_its_wire() {
    for (name, scene, (radius, rate), allowed) in [
        ("wide", wide_ring(), (WIDE_WIRE, WIDE_RATE), 1e-3),
        ("thesis", turned(Top::Even, 100), (WIRE, COPPER_WEAR), 3e-3),
        ("deep", turned(Top::Rigid, 500), (WIRE, COPPER_WEAR), 1e-2),
    ] {
        let found = solved(&scene).last;
        let [one, other] = found.stations[..] else {
            panic!("{} stations", found.stations.len());
        };
        assert_eq!(one.max_depth_mm, other.max_depth_mm);
        let wear = sliding_wear(&scene, rate);
        let trough = trough(radius, wear);
        let depth = one.max_depth_mm.receptacle / trough.depth_mm;
        let area = one.worn_area_mm2.receptacle / trough.area_mm2;
        println!(
            "ring, torsion, {name}: half-angle {:.1} deg, {:.4} um, {:.4e} mm^2, {:.4} k P' s; depth {depth:.4} and area {area:.4} of the trough's",
            trough.half_angle.to_degrees(),
            1e3 * one.max_depth_mm.receptacle,
            one.worn_area_mm2.receptacle,
            one.worn_area_mm2.receptacle / wear,
        );
        assert!((depth - 1.0).abs() < allowed && (area - 1.0).abs() < allowed);
        let work = found.worn_volume_mm3.receptacle / rate;
        let energy = found.dissipated_energy_mj / (1.21 * work) - 1.0;
        assert!(energy.abs() < 1e-4, "{energy}");
    }
}

/// At 90 degrees a motion in the plane of the ring slips along the wire, as torsion does, and digs its trough. At every place friction opposes the
/// slip, on walls too: the energy is mu times the work of the pressure, mu V/k.
#[test]
fn places_of_a_ring_beside_90_degrees_have_walls_too() {
    let scene = ring(Top::Even, 9, 100);
    let found = solved(&scene).last;
    let trough = trough(WIRE, sliding_wear(&scene, COPPER_WEAR));
    let area = found.stations[4].worn_area_mm2.receptacle / trough.area_mm2;
    let work = found.worn_volume_mm3.receptacle / COPPER_WEAR;
    let energy = found.dissipated_energy_mj / (1.21 * work) - 1.0;
    println!(
        "ring, in the plane: area at 90 deg {area:.4} of the trough's, energy off mu V/k by {energy:.1e}"
    );
    assert!((area - 1.0).abs() < 1e-2 && energy.abs() < 1e-4);
}
