mod partial_slip;

use std::f64::consts::PI;

use super::*;
use crate::closed_form::{CyclePath, PointAccuracy, PointBody, SlipRegime};
use crate::law::elastic::Elastic;
use crate::law::friction::contact::ContactFriction;
use crate::law::plating::Layer;
use crate::law::surface::SurfaceWear;
use crate::law::wear::WearLaw;
use crate::number::real;
use crate::number::real_cycles;
use crate::point::sliding::Sliding;
use crate::point::state::State;
use crate::sides::Side;

/// Hertz' half-length in mm and peak pressure in MPa of a sphere of 10 mm of steel on steel under 100 N.
const HERTZ: (f64, f64) = (0.189_686, 1_327.0);

fn archard(k: f64) -> Option<SurfaceWear> {
    let law = WearLaw::Archard {
        k_over_h_per_mpa: k,
    };
    SurfaceWear::new(&[], Some(law))
}

/// That sphere on a flat receptacle that wears by k in 1/MPa.
fn sphere_on_flat(k: Sides<f64>, amplitude_mm: f64, cycles: u64) -> PointScene {
    let steel = Elastic {
        youngs_modulus_mpa: 200e3,
        poisson_ratio: 0.3,
    };
    let body = |radius_mm, k: f64| PointBody {
        radius_along_mm: radius_mm,
        radius_across_mm: radius_mm,
        elastic: steel,
        wear: if k > 0.0 { archard(k) } else { None },
    };
    PointScene {
        bodies: Sides {
            slider: body(Some(10.0), k.slider),
            receptacle: body(None, k.receptacle),
        },
        force_n: 100.0,
        friction: 0.5,
        slip: SlipRegime::Gross,
        amplitude_mm,
        path: CyclePath::ToAndFro,
        cycles,
        spring_n_per_mm: 0.0,
        accuracy: PointAccuracy::from_tolerance(0.02),
    }
}

fn sides(slider: f64, receptacle: f64) -> Sides<f64> {
    Sides { slider, receptacle }
}

fn solved(scene: &PointScene) -> PointSummary {
    run(scene, |_| ControlFlow::Continue(())).expect("the scene can be solved")
}

#[test]
fn one_pass_of_a_sphere_leaves_the_track_of_its_line_loads() {
    let k = 1e-9;
    let mut scene = sphere_on_flat(sides(0.0, k), 0.8, 1);
    scene.accuracy.cells_per_half_length = 20.0;
    let lattice = PointMotions::single(&scene).lattice();
    let mut state = State::unworn(&scene, lattice);
    let mut sliding = Sliding::new(&scene, ContactFriction::constant(scene.friction), &state);
    sliding.load(&mut state).expect("it can be loaded");
    let n = state.lattice.amplitude;
    for to in [n, 2 * n] {
        sliding.pass(&mut state, to, 0.8, 1.0).expect("it slides");
    }
    let surface = &state.surfaces.receptacle;
    let cells = surface.dose.cells(state.lattice.size_mm);
    let (a, p0) = HERTZ;
    let depth = surface.depths_mm();
    let middle = &depth[(cells.along_x / 2) * cells.along_z..][..cells.along_z];
    for (j, depth) in middle.iter().enumerate() {
        let z = cells.z_mm(j);
        let exact = k * p0 * 0.5 * PI * a * (1.0 - (z / a).powi(2)).max(0.0);
        assert!(
            (depth - exact).abs() < 0.015 * 3.953_9e-7,
            "{z}: {depth} {exact}"
        );
    }
}

#[test]
fn both_sides_lose_the_volume_of_archards_law() {
    for (amplitude, radius) in [(0.4, None), (0.02, None), (1e-3, None), (0.4, Some(20.0))] {
        let mut scene = sphere_on_flat(sides(2e-8, 1e-8), amplitude, 500);
        scene.bodies.receptacle.radius_along_mm = radius;
        let found = solved(&scene).last;
        let path = 4.0 * amplitude * 500.0;
        for side in Side::BOTH {
            let k = scene.bodies.of(side).wear.and_then(SurfaceWear::uniform);
            let exact = k.expect("it wears") * scene.force_n * path;
            let volume = *found.worn_volume_mm3.of(side);
            assert!(
                (volume / exact - 1.0).abs() < 1e-10,
                "{amplitude}: {volume} {exact}"
            );
        }
        let energy = scene.friction * scene.force_n * path;
        assert!((found.dissipated_energy_mj / energy - 1.0).abs() < 1e-12);
    }
}

#[test]
fn mirrored_motion_wears_the_mirrored_map() {
    let scene = sphere_on_flat(sides(2e-8, 2e-8), 0.1, 20);
    let mirrored = PointScene {
        amplitude_mm: -0.1,
        ..scene
    };
    let (one, other) = (solved(&scene), solved(&mirrored));
    for side in Side::BOTH {
        let (one, other) = (one.depth.of(side), other.depth.of(side));
        let most = one
            .depth_mm
            .iter()
            .fold(0.0, |most: f64, depth| most.max(*depth));
        for (a, b) in one.depth_mm.iter().zip(other.depth_mm.iter().rev()) {
            assert!((a - b).abs() < 1e-6 * most, "{a} {b}");
        }
    }
}

#[test]
fn the_same_scene_gives_the_same_bits() {
    let scene = sphere_on_flat(sides(2e-8, 2e-8), 0.1, 20);
    assert_eq!(solved(&scene), solved(&scene));
}

/// Where the contact hardly moves over either body, it does not matter which one wears.
#[test]
fn short_strokes_wear_either_side_alike() {
    let depth = |k| {
        let last = solved(&sphere_on_flat(k, 2e-3, 2_000)).last;
        last.max_depth_mm.slider + last.max_depth_mm.receptacle
    };
    let (one, other) = (depth(sides(2e-8, 0.0)), depth(sides(0.0, 2e-8)));
    assert!((one / other - 1.0).abs() < 0.02, "{one} {other}");
}

#[test]
fn half_the_rate_in_twice_the_cycles_wears_the_same() {
    let run = |k, cycles| solved(&sphere_on_flat(sides(k, k), 0.1, cycles));
    let (fast, slow) = (run(2e-8, 1_000), run(1e-8, 2_000));
    for side in Side::BOTH {
        let (a, b) = (
            *fast.last.max_depth_mm.of(side),
            *slow.last.max_depth_mm.of(side),
        );
        assert!((a / b - 1.0).abs() < 0.02, "{a} {b}");
    }
}

/// The slider alone loses a cap: V = pi h^2 R, once it is deep against the indentation.
#[test]
fn a_worn_sphere_loses_a_cap() {
    let mut scene = sphere_on_flat(sides(1e-7, 0.0), 1.0, 100_000);
    scene.force_n = 10.0;
    let summary = solved(&scene);
    let last = summary.last;
    let volume = 1e-7 * 10.0 * 4.0 * 1e5;
    assert!((last.worn_volume_mm3.slider / volume - 1.0).abs() < 1e-10);
    let depth = (volume / (PI * 10.0)).sqrt();
    assert!(
        (last.max_depth_mm.slider / depth - 1.0).abs() < 0.03,
        "{last:?} {depth}"
    );
    let half_length = (2.0 * 10.0 * depth).sqrt();
    assert!(
        (last.half_length_along_mm / half_length - 1.0).abs() < 0.03,
        "{last:?}"
    );
}

/// The receptacle alone gets a groove with the section of the sphere: its area is the volume over the length of the stroke, and its depth
/// that of the segment, area = 4/3 h sqrt(2 R h).
#[test]
fn a_sphere_digs_a_groove_of_its_own_section() {
    let (k, amplitude, cycles) = (1e-7, 0.5, 300);
    let mut scene = sphere_on_flat(sides(0.0, k), amplitude, cycles);
    scene.force_n = 10.0;
    let summary = solved(&scene);
    let map = &summary.depth.receptacle;
    let width = map.z_mm.len();
    let row = &map.depth_mm[(map.x_mm.len() / 2) * width..][..width];
    let section = row.iter().sum::<f64>() * (map.z_mm[1] - map.z_mm[0]);
    let area = k * scene.force_n * 2.0 * real_cycles(cycles);
    assert!((section / area - 1.0).abs() < 0.03, "{section} {area}");
    let segment = (0.75 * section / 20.0_f64.sqrt()).powf(2.0 / 3.0);
    let deepest = row.iter().fold(0.0, |most: f64, depth| most.max(*depth));
    assert!(
        (deepest / segment - 1.0).abs() < 0.05,
        "{deepest} {segment}"
    );
    // The dose is all there is, whatever the number of cells.
    assert!(real(summary.computed_cycles) > 10.0);
}

/// A layer that is worn through leaves the sum of the doses as it is.
#[test]
fn wear_through_a_layer_keeps_the_dose() {
    let layer = Layer {
        thickness_mm: 0.76e-3,
        rate_per_mpa: 1e-8,
    };
    let mut scene = sphere_on_flat(sides(0.0, 0.0), 0.1, 1_000);
    let base = WearLaw::Archard {
        k_over_h_per_mpa: 5e-8,
    };
    let wear = SurfaceWear::new(&[layer], Some(base));
    scene.bodies.receptacle.wear = wear;
    let summary = solved(&scene);
    let map = &summary.depth.receptacle;
    let area = (map.x_mm[1] - map.x_mm[0]) * (map.z_mm[1] - map.z_mm[0]);
    let equivalents = map
        .depth_mm
        .iter()
        .map(|depth| wear.expect("it wears").equivalent(*depth));
    let dose = equivalents.sum::<f64>() * area / 1e-8;
    let exact = scene.force_n * 4.0 * 0.1 * 1_000.0;
    assert!((dose / exact - 1.0).abs() < 1e-9, "{dose} {exact}");
    assert!(
        summary.last.max_depth_mm.receptacle > 2.0 * 0.76e-3,
        "{:?}",
        summary.last
    );
}

#[test]
fn a_run_ends_where_it_is_stopped() {
    let scene = sphere_on_flat(sides(0.0, 1e-8), 0.1, 100_000);
    let stopped = run(&scene, |_| ControlFlow::Break(())).expect("it starts");
    assert_eq!(
        (stopped.outcome, stopped.last.cycle),
        (PointOutcome::Stopped, 1)
    );
}

/// A cap of a rigid sphere, V = pi R h^2, below a spring: dV/ds = k (F_0 - c h), integrated by Simpson's rule over h:
/// s = (2 pi R/k) int h/(F_0 - c h) dh.
#[test]
fn a_spring_loses_its_load_as_the_slider_sinks() {
    let (k, force, spring) = (1e-7, 10.0, 50.0);
    let mut scene = sphere_on_flat(sides(k, 0.0), 1.0, 100_000);
    (scene.force_n, scene.spring_n_per_mm) = (force, spring);
    let last = solved(&scene).last;
    let depth = last.max_depth_mm.slider;
    let parts = 1_000;
    let step = depth / real(parts);
    let at = |h: f64| h / (force - spring * h);
    let simpson = |i: usize| {
        let from = step * real(i);
        step / 6.0 * (at(from) + 4.0 * at(from + 0.5 * step) + at(from + step))
    };
    let path = 2.0 * PI * 10.0 / k * (0..parts).map(simpson).sum::<f64>();
    // The sphere is elastic, its cap 3 % off without a spring; the depth goes with the root of the path.
    assert!((path / 4e5 - 1.0).abs() < 0.06, "{path}");
    let expected = force - spring * depth;
    assert!(expected < 0.7 * force, "{expected}");
    assert!(
        (last.force_n / expected - 1.0).abs() < 0.02,
        "{last:?} {expected}"
    );
}

#[test]
fn a_line_contact_is_refused() {
    let mut scene = sphere_on_flat(sides(0.0, 1e-8), 0.1, 1);
    scene.bodies.slider.radius_across_mm = None;
    let found = run(&scene, |_| ControlFlow::Continue(()));
    assert!(matches!(found, Err(PointError::CurvatureAcrossRange(value)) if value == 0.0));
}
