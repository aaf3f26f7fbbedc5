//! Fields inside the bodies of a contact along a line against what they must be: those of the plane contact where all sections are alike, and the
//! load as the sum of the pressure on their surfaces.

use solver::fields::{BodyFields, LineFields, SectionFields};
use solver::record::{Position, Snapshot};
use solver::scene::Effect;
use solver::scene::{Accuracy, Dimension, Scene, Top};
use solver::sides::Side;

use crate::verification::recorder::solve;
use crate::verification::verify_line_runs::{CROWN, FORCE, GOLD, ring, spring};

/// The snapshot of the unworn contact, with fields.
fn unworn(mut scene: Scene) -> Snapshot {
    scene.output.fields = true;
    let (_, recorder) = solve(&scene).expect("it can be solved");
    recorder
        .snapshots
        .into_iter()
        .next()
        .expect("the first one")
}

fn neutral(snapshot: &Snapshot) -> &LineFields {
    let mut fields = snapshot.line_fields.iter();
    fields
        .find(|fields| fields.position == Position::Neutral)
        .expect("fields at the neutral position")
}

/// Without crown and tilt all sections are the plane contact, under an even top with the same load; so is the shear that friction locks in
/// between these unlike bodies as they are first loaded.
#[test]
fn a_straight_line_has_the_fields_of_the_plane_contact() {
    let mut line = spring(None, (0.0, 0.0), 1);
    line.accuracy = Accuracy::from_tolerance(0.1);
    line.output.snapshots_at_cycles = vec![1];
    line.output.fields = true;
    line.effects = line.effects.with(Effect::StickMemory, false);
    let mut plane = line.clone();
    plane.dimension = Dimension::PlaneStrain;
    if let Dimension::Line(own) = &mut line.dimension {
        own.top = Top::Even;
    }
    let snapshots = |scene: &Scene| solve(scene).expect("it can be solved").1.snapshots;
    for (line, plane) in snapshots(&line).iter().zip(&snapshots(&plane)) {
        assert_eq!(line.line_fields.len(), plane.fields.len());
        for (line, plane) in line.line_fields.iter().zip(&plane.fields) {
            assert_eq!(line.position, plane.position);
            for section in &line.bodies.slider.sections {
                assert!(off(section, &plane.slider) < 1e-12);
            }
            for section in &line.bodies.receptacle.sections {
                assert!(off(section, &plane.receptacle) < 1e-12);
            }
        }
    }
}

/// Largest difference of a section's stresses and displacements from those of a plane body, over the largest of these.
fn off(section: &SectionFields, plane: &BodyFields) -> f64 {
    assert_eq!(section.stress.len(), plane.stress.len());
    let highest = plane.stress.iter().map(|s| s.yy.abs()).fold(0.0, f64::max);
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
    let stress = stresses.fold(0.0, |most: f64, d| most.max(d.abs())) / highest;
    let pairs = section.displacement_mm.iter().zip(&plane.displacement_mm);
    let moved = plane.displacement_mm.iter().flatten();
    let farthest = moved.fold(0.0, |most: f64, u| most.max(u.abs()));
    let moved = pairs.flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2]]);
    let moved = moved.fold(0.0, |most: f64, d| most.max(d.abs())) / farthest;
    stress.max(moved)
}

/// Integral of the pressure across a section, N/mm.
fn carried(section: &SectionFields, surface: &[usize]) -> f64 {
    let nodes = surface.iter().zip(&section.surface_fields);
    let nodes: Vec<(f64, f64)> = nodes
        .map(|(node, carried)| (section.nodes[*node][0], carried.pressure_mpa))
        .collect();
    let pairs = nodes.windows(2);
    pairs
        .map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1))
        .sum()
}

/// To 1 %: the trapezoidal rule at the nodes of either body.
#[test]
fn the_pressure_on_the_surfaces_sums_to_the_load() {
    for (name, scene, force) in [
        ("ring", ring(1), 0.834),
        ("crown", spring(Some(CROWN), (GOLD, GOLD), 1), FORCE),
    ] {
        let snapshot = unworn(scene);
        let fields = neutral(&snapshot);
        for side in Side::BOTH {
            let body = fields.bodies.of(side);
            let sections = snapshot.stations.iter().zip(&body.sections);
            let sum: f64 = sections
                .map(|(station, section)| {
                    station.report.weight_mm * carried(section, &body.surface)
                })
                .sum();
            println!("{name}, {}: {sum:.5} N of {force} N", side.name());
            assert!((sum / force - 1.0).abs() < 0.01, "{name}: {sum}");
        }
    }
}
