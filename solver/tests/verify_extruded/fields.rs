//! Fields inside extruded bodies against what they must be: those of the plane contact where that is their limiting case, and the load as the
//! sum over their surfaces and over a cut through the receptacle.

use super::runs::extruded;
use crate::verification::recorder::solve;
use solver::fields::{BodyFields, LineFields, SectionFields, SweptFields};
use solver::record::{Position, Snapshot};
use solver::scene::Effect;
use solver::scene::{Dimension, Drive, Ends, Friction, Scene};
use solver::sides::Side;

/// The thesis' fuzz button with its fields before any wear and after a cycle.
fn with_fields(layers: usize, ends: Ends) -> Scene {
    let mut scene = extruded(layers, ends, 1);
    scene.accuracy.cycle_jump = Some(1);
    scene.accuracy.increments_per_cycle = Some(100);
    scene.output.fields = true;
    scene.effects = scene.effects.with(Effect::StickMemory, false);
    scene
}

fn snapshots(scene: &Scene) -> Vec<Snapshot> {
    let (_, recorder) = solve(scene).expect("the scene can be solved");
    recorder.snapshots
}

fn neutral(snapshot: &Snapshot) -> &LineFields {
    let mut fields = snapshot.line_fields.iter();
    fields
        .find(|fields| fields.position == Position::Neutral)
        .expect("fields at the neutral position")
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Largest difference of a section from a plane body: of stresses over the largest stress, of displacements over the largest of these, and of
/// places, mm.
fn off(section: &SectionFields, plane: &BodyFields) -> [f64; 3] {
    assert_eq!(section.stress.len(), plane.stress.len());
    let stresses = section.stress.iter().zip(&plane.stress).flat_map(|(a, b)| {
        [
            a.xx - b.xx,
            a.yy - b.yy,
            a.zz - b.zz,
            a.xy - b.xy,
            a.xz,
            a.yz,
        ]
    });
    let highest = largest(plane.stress.iter().map(|s| s.yy));
    let pairs = section.displacement_mm.iter().zip(&plane.displacement_mm);
    let moved = pairs.flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2]]);
    let farthest = largest(plane.displacement_mm.iter().flatten().copied());
    let places = section.nodes.iter().zip(&plane.nodes);
    [
        largest(stresses) / highest,
        largest(moved) / farthest,
        largest(places.flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]])),
    ]
}

/// Largest distance of a point of the friction loop from the nearest one of the plane contact, whose increments at turning points are shorter,
/// over its largest displacement and force.
fn off_loop(found: &Snapshot, plane: &Snapshot) -> f64 {
    let points = |snapshot: &Snapshot| -> Vec<(f64, f64)> {
        let found = &snapshot.friction_loop;
        let forces = found.tangential_force_n_per_mm.iter().copied();
        found.displacement_mm.iter().copied().zip(forces).collect()
    };
    let (found, plane) = (points(found), points(plane));
    let farthest = largest(plane.iter().map(|point| point.0));
    let highest = largest(plane.iter().map(|point| point.1)).max(1e-9);
    let apart = |a: &(f64, f64), b: &(f64, f64)| {
        let (displacement, force) = ((a.0 - b.0) / farthest, (a.1 - b.1) / highest);
        displacement.abs().max(force.abs())
    };
    let nearest = found.iter().map(|a| {
        let distances = plane.iter().map(|b| apart(a, b));
        distances.fold(f64::INFINITY, f64::min)
    });
    largest(nearest)
}

/// Largest of these differences over all positions, bodies and sections after a cycle, and without friction before any wear: with it, the plane
/// contact locks shear in as it is first loaded, which extruded bodies do not.
fn off_plane(scene: &Scene) -> [f64; 3] {
    let plane = Scene {
        dimension: Dimension::PlaneStrain,
        ..scene.clone()
    };
    let (found, plane) = (snapshots(scene), snapshots(&plane));
    assert_eq!(found.len(), plane.len());
    let rubs = scene.friction != Friction::Frictionless;
    let mut worst = [0.0_f64; 3];
    let pairs = found.iter().zip(&plane);
    for (found, plane) in pairs.filter(|(found, _)| !rubs || found.cycle > 0) {
        assert!(off_loop(found, plane) < 1e-9);
        assert_eq!(found.line_fields.len(), plane.fields.len());
        for (found, plane) in found.line_fields.iter().zip(&plane.fields) {
            assert_eq!(found.position, plane.position);
            for (side, plane) in [
                (Side::Slider, &plane.slider),
                (Side::Receptacle, &plane.receptacle),
            ] {
                for section in &found.bodies.of(side).sections {
                    for (worst, off) in worst.iter_mut().zip(off(section, plane)) {
                        *worst = worst.max(off);
                    }
                }
            }
        }
    }
    worst
}

/// Held ends are plane strain under both drives, for elements with and without B-bar; free ends without friction are it without
/// Poisson's contraction. At the neutral position and both turning points.
#[test]
fn fields_of_plane_strain_are_those_of_the_plane_contact() {
    for (ends, nu, drive, friction) in [
        (Ends::Held, 0.34, Drive::Handle, true),
        (Ends::Held, 0.34, Drive::WholeBody, true),
        (Ends::Held, 0.47, Drive::Handle, true),
        (Ends::Free, 0.0, Drive::Handle, false),
    ] {
        let mut scene = with_fields(2, ends);
        scene.drive = drive;
        scene.slider.elastic.poisson_ratio = nu;
        scene.receptacle.elastic.poisson_ratio = nu;
        if !friction {
            scene.friction = Friction::Frictionless;
        }
        let [stress, moved, places] = off_plane(&scene);
        println!(
            "fields, {ends:?}, nu = {nu}, {drive:?}, friction {friction}: stresses off by {stress:.1e}, displacements by {moved:.1e}, places by {places:.1e} mm"
        );
        assert!(stress < 1e-9 && moved < 1e-9 && places < 1e-12);
    }
}

/// Integral over ascending places by the trapezoidal rule.
fn trapezoidal(mut values: Vec<(f64, f64)>) -> f64 {
    values.sort_by(|one, other| one.0.total_cmp(&other.0));
    let pairs = values.windows(2);
    pairs
        .map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1))
        .sum()
}

/// Integral of a value at the nodes on the surface of a section, N/mm.
fn on_surface(
    section: &SectionFields,
    surface: &[usize],
    of: impl Fn(&solver::fields::SurfaceFields) -> f64,
) -> f64 {
    let nodes = surface.iter().zip(&section.surface_fields);
    trapezoidal(
        nodes
            .map(|(node, carried)| (section.nodes[*node][0], of(carried)))
            .collect(),
    )
}

/// Integral of `sigma_yy` over the cut through an unworn receptacle that is nearest to a height, N/mm.
fn across_cut(section: &SectionFields, height_mm: f64) -> f64 {
    let nodes = section.nodes.iter();
    let nearest = nodes.fold(f64::INFINITY, |best: f64, [_, y]| {
        if (y - height_mm).abs() < (best - height_mm).abs() {
            *y
        } else {
            best
        }
    });
    let nodes = section.nodes.iter().zip(&section.stress);
    let cut = nodes.filter(|([_, y], _)| (y - nearest).abs() < 1e-12);
    trapezoidal(cut.map(|([x, _], stress)| (*x, stress.yy)).collect())
}

/// Sum over the width of what each section carries, sections from the middle on.
fn over_width(
    snapshot: &Snapshot,
    body: &SweptFields,
    of_section: impl Fn(&SectionFields) -> f64,
) -> f64 {
    let stations = snapshot.stations.iter().rev();
    stations
        .zip(&body.sections)
        .map(|(station, section)| station.report.weight_mm * of_section(section))
        .sum()
}

/// Free ends: the pressure on either surface is the load, friction its coefficient times that, and so is the stress on every horizontal cut
/// through the block, all of which carry the load.
#[test]
fn surfaces_and_cuts_carry_the_load() {
    let scene = with_fields(4, Ends::Free);
    let Dimension::Extruded(own) = scene.dimension else {
        panic!("it is extruded");
    };
    let force = scene.load_n_per_mm * own.width_mm;
    let height = scene.receptacle.shape.height_mm;
    let found = snapshots(&scene);
    let (unworn, worn) = (&found[0], &found[1]);
    for snapshot in [unworn, worn] {
        for fields in &snapshot.line_fields {
            for side in Side::BOTH {
                let body = fields.bodies.of(side);
                let sum = |of: fn(&solver::fields::SurfaceFields) -> f64| {
                    over_width(snapshot, body, |section| {
                        on_surface(section, &body.surface, of)
                    }) / force
                };
                let (load, friction) = (sum(|s| s.pressure_mpa), sum(|s| s.shear_mpa[0]));
                println!(
                    "fields, cycle {}, {:?}, {}: pressure {load:.5}, shear {friction:.5} of the load",
                    snapshot.cycle,
                    fields.position,
                    side.name()
                );
                assert!((load - 1.0).abs() < 0.01);
            }
        }
    }
    let receptacle = &neutral(unworn).bodies.receptacle;
    for share in [0.1, 0.3, 0.5, 0.8] {
        let carried = over_width(unworn, receptacle, |section| {
            across_cut(section, -share * height)
        });
        println!(
            "fields, cut at {share} of the height: {:.1e} off the load",
            carried / force + 1.0
        );
        assert!((carried / force + 1.0).abs() < 1e-9);
    }
}

/// No node leaves the middle plane, which no shear along z acts on; free ends bulge, and stress across them is far below that in the middle.
fn free_ends_bulge_symmetrically() {
    let scene = with_fields(8, Ends::Free);
    let found = snapshots(&scene);
    let fields = neutral(&found[0]);
    for side in Side::BOTH {
        let sections = &fields.bodies.of(side).sections;
        let (middle, end) = (&sections[0], &sections[sections.len() - 1]);
        assert!(middle.displacement_mm.iter().all(|u| u[2] == 0.0));
        assert!(middle.stress.iter().all(|s| s.xz == 0.0 && s.yz == 0.0));
        let outward = end.displacement_mm.iter().map(|u| u[2]);
        let bulge = outward.fold(0.0, f64::max);
        let along = |section: &SectionFields| largest(section.stress.iter().map(|s| s.zz));
        println!(
            "fields, {}: end bulges by {:.2e} mm, sigma_zz {:.1} MPa in the middle, {:.1} MPa at the end",
            side.name(),
            bulge,
            along(middle),
            along(end)
        );
        assert!(bulge > 0.0 && along(end) < 0.5 * along(middle));
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 18 s"]
    fn free_ends_bulge_symmetrically() {
        super::free_ends_bulge_symmetrically();
    }
}
