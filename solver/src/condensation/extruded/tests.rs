use super::*;
use crate::condensation::condense;
use crate::model;
use crate::model::BodyLayout;
use crate::model::tests::fuzz_button;
use crate::number::{count_at_least, real};
use crate::scene::{Drive, Scene};

fn model_of(scene: &Scene) -> Model {
    model::build(scene, &crate::effects::plan(scene)).expect("the scene can be meshed")
}

fn extruded(model: &Model, planes: &NodePlanes, ends: Ends) -> ExtrudedOperators {
    let models = vec![model.clone(); planes.count()];
    condense_extruded(&models, planes, ends, None, 1).expect("the scene can be condensed")
}

fn coarse() -> Scene {
    let mut scene = fuzz_button();
    scene.accuracy.contact_element_mm = Some(0.002);
    scene
}

/// Displacement `row` = 2 i + d of a section under the line force `column` = 2 j + e of another.
fn entry(zone: &PrismZone, (k, row): (usize, usize), (l, column): (usize, usize)) -> f64 {
    let node = row / 2;
    let columns = zone.to_force_at(l, column / 2, k, &(node..node + 1));
    columns[column % 2][row % 2]
}

/// Displacements are those of the plane body if the ends are held, and if Poisson's ratio is zero also if they are free: round-off.
#[test]
fn sections_under_equal_forces_respond_as_the_plane_body() {
    let planes = NodePlanes::new(0.01, 4, 1.7);
    for (drive, ends, poisson_ratio) in [
        (Drive::Handle, Ends::Held, 0.34),
        (Drive::WholeBody, Ends::Held, 0.34),
        (Drive::Handle, Ends::Held, 0.47),
        (Drive::Handle, Ends::Free, 0.0),
    ] {
        let mut scene = coarse();
        scene.drive = drive;
        scene.slider.elastic.poisson_ratio = poisson_ratio;
        scene.receptacle.elastic.poisson_ratio = poisson_ratio;
        let model = model_of(&scene);
        let plane = condense(&model, 1)
            .expect("the preset can be condensed")
            .operators;
        let solid = extruded(&model, &planes, ends);
        for side in Side::BOTH {
            let (plane, zone) = (&plane.of(side).zones[0], &solid.zones.of(side)[0]);
            let scale = (0..2 * zone.nodes).fold(0.0, |m: f64, i| m.max(plane.compliance(i, i)));
            let is_pressed = drive == Drive::WholeBody && side == Side::Slider;
            for (k, column) in
                (0..planes.count()).flat_map(|k| (0..2 * zone.nodes).map(move |c| (k, c)))
            {
                for row in (column % 7..2 * zone.nodes).step_by(7) {
                    let terms = (0..planes.count()).map(|l| entry(zone, (k, row), (l, column)));
                    let (mut sum, mut expected): (f64, f64) =
                        (terms.sum(), plane.compliance(row, column));
                    // A guided body is grounded in one node, which carries nothing if the far face balances the force.
                    if is_pressed && column % 2 == 1 {
                        sum += zone.under_load(k, row / 2)[row % 2];
                        expected += plane.under_load(row / 2)[row % 2];
                    }
                    assert!((sum - expected).abs() < 1e-10 * scale, "{sum} {expected}");
                }
            }
        }
    }
}

/// Maxwell and Betti: nodal forces and displacements have a symmetric relation.
#[test]
fn compliance_of_free_prisms_is_symmetric_and_positive() {
    let planes = NodePlanes::new(0.01, 4, 1.7);
    let (solid, lengths) = (
        extruded(&model_of(&coarse()), &planes, Ends::Free),
        planes.lengths(),
    );
    for side in Side::BOTH {
        let zone = &solid.zones.of(side)[0];
        let nodal = |(k, row), (l, column)| entry(zone, (k, row), (l, column)) / lengths[l];
        for (k, l) in [(0, 0), (0, 1), (1, 2), (0, 2)] {
            for row in (0..2 * zone.nodes).step_by(5) {
                let own = nodal((k, row), (k, row));
                assert!(own > 0.0);
                for column in (0..2 * zone.nodes).step_by(3) {
                    let twin = nodal((l, column), (k, row));
                    let difference = nodal((k, row), (l, column)) - twin;
                    assert!(difference.abs() < 1e-10 * own);
                }
            }
        }
    }
}

/// A wall that is thin across and held along its length under an even pressure: what it is higher than another one is squeezed by
/// p (1 - nu^2)/E per height, because it is free across. Both have the same
/// clamped foot; the ends of the length matter by 1e-5.
#[test]
fn a_thin_wall_is_squeezed_in_plane_stress() {
    let planes = NodePlanes::new(0.01, 4, 1.0);
    let squeezed = |height_mm: f64| {
        let mut scene = coarse();
        scene.receptacle.shape.length_mm = 2.0;
        scene.receptacle.shape.height_mm = height_mm;
        let mut model = model_of(&scene);
        // Layers of the same height, so that both feet are the same.
        let layers = count_at_least(height_mm / 0.004 - 1e-9);
        let layout = BodyLayout {
            fractions: (0..=layers).map(|l| real(l) / real(layers)).collect(),
            ..model.bodies.receptacle.layout.clone()
        };
        model.bodies.receptacle =
            BodyModel::new(layout, scene.receptacle.elastic, Support::FarFaceHeld)
                .expect("the wall can be meshed");
        let solid = extruded(&model, &planes, Ends::Free);
        let (zone, widths) = (
            &solid.zones.receptacle[0],
            &solid.sections.receptacle.widths,
        );
        let middle = 2 * (widths.len() / 2) + 1;
        let at = |k: usize| -> f64 {
            let forces = widths.iter().enumerate();
            let by = |(j, width): (usize, &f64)| -> f64 {
                let sections = 0..planes.count();
                sections
                    .map(|l| width * entry(zone, (k, middle), (l, 2 * j + 1)))
                    .sum()
            };
            forces.map(by).sum()
        };
        (0..planes.count()).map(at).collect::<Vec<_>>()
    };
    let (low, high) = (squeezed(0.06), squeezed(0.1));
    let expected = 0.04 * (1.0 - 0.34 * 0.34) / 117e3;
    for (low, high) in low.iter().zip(&high) {
        let ratio = (high - low) / expected;
        assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
    }
}

/// Worn in one section only, a body becomes stiffer there and keeps the operators of the other body.
#[test]
fn sections_have_surfaces_of_their_own() {
    let planes = NodePlanes::new(0.01, 2, 1.0);
    let model = model_of(&coarse());
    let before = vec![model.clone(); 2];
    let first = condense_extruded(&before, &planes, Ends::Free, None, 1).expect("unworn");
    let depth = Sides {
        slider: vec![0.0; model.bodies.slider.contact_x().len()],
        receptacle: vec![0.03; model.bodies.receptacle.contact_x().len()],
    };
    let moved = crate::ale::relocate(&model, &depth).expect("the mesh can follow");
    let models = [moved, model];
    let middle = first.zones.receptacle[0].nodes / 2;
    let own = |operators: &ExtrudedOperators, k| {
        entry(
            &operators.zones.receptacle[0],
            (k, 2 * middle + 1),
            (k, 2 * middle + 1),
        )
    };
    let unworn = [own(&first, 0), own(&first, 1)];
    let slider = entry(&first.zones.slider[0], (0, 1), (1, 3));
    let then = condense_extruded(
        &models,
        &planes,
        Ends::Free,
        Some((&before, first.zones)),
        2,
    )
    .expect("the worn body can be condensed");
    let anew = condense_extruded(&models, &planes, Ends::Free, None, 1).expect("likewise");
    let stiffer = [0, 1].map(|k| 1.0 - own(&then, k) / unworn[k]);
    assert!(
        stiffer[0] > 0.01 && stiffer[1].abs() < 0.5 * stiffer[0],
        "{stiffer:?}"
    );
    assert_eq!(own(&then, 0).to_bits(), own(&anew, 0).to_bits());
    assert_eq!(
        slider.to_bits(),
        entry(&then.zones.slider[0], (0, 1), (1, 3)).to_bits()
    );
}
