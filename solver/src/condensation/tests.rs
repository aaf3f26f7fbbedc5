use super::*;
use crate::model;
use crate::model::tests::fuzz_button;
use crate::scene::Drive;

#[test]
fn compliance_is_symmetric_and_positive() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let operators = condense(&model)
        .expect("the preset can be condensed")
        .operators;
    for body in [&operators.slider, &operators.receptacle] {
        let c = &body.compliance;
        assert_eq!(c.nodes(), body.x.len());
        for i in (0..2 * c.nodes()).step_by(7) {
            assert!(c.get(i, i) > 0.0);
            for j in (0..i).step_by(11) {
                assert!((c.get(i, j) - c.get(j, i)).abs() <= 1e-12 * c.get(i, i).max(c.get(j, j)));
            }
        }
    }
}

/// A wide flat block under an even pressure is squeezed by p H (1 - nu^2 - ...) = p H / (lambda + 2 mu) in its middle.
#[test]
fn an_even_pressure_squeezes_a_wide_block_uniaxially() {
    let mut scene = fuzz_button();
    scene.receptacle.shape.length_mm = 2.0;
    scene.receptacle.shape.height_mm = 0.05;
    scene.accuracy.contact_element_mm = Some(0.002);
    let model =
        model::build(&scene, &crate::effects::plan(&scene)).expect("the block can be meshed");
    let body = condense(&model)
        .expect("the block can be condensed")
        .operators
        .receptacle;
    let middle = 2 * (body.x.len() / 2) + 1;
    let squeezed: f64 = body
        .widths
        .iter()
        .enumerate()
        .map(|(j, width)| body.compliance.get(middle, 2 * j + 1) * width)
        .sum();
    let expected =
        0.05 / (model.bodies.receptacle.lame.lambda + 2.0 * model.bodies.receptacle.lame.mu);
    assert!(
        (squeezed / expected - 1.0).abs() < 1e-6,
        "{squeezed} {expected}"
    );
}

#[test]
fn a_guided_slider_moves_only_vertically() {
    let mut scene = fuzz_button();
    scene.drive = Drive::WholeBody;
    let model =
        model::build(&scene, &crate::effects::plan(&scene)).expect("the preset can be meshed");
    let slider = condense(&model)
        .expect("the preset can be condensed")
        .operators
        .slider;
    for i in (0..2 * slider.compliance.nodes()).step_by(2) {
        assert!(slider.compliance.get(i, i).abs() < f64::MIN_POSITIVE);
        assert!(slider.compliance.get(i + 1, i + 1) > 0.0);
    }
}

/// The recovered interior agrees with the compliance on the surface, and satisfies the clamp.
#[test]
fn interior_and_surface_agree() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let condensed = condense(&model).expect("the preset can be condensed");
    let body = &condensed.operators.receptacle;
    let middle = body.x.len() / 2;
    let mut force = vec![0.0; 2 * body.x.len()];
    force[2 * middle] = 0.3;
    force[2 * middle + 1] = -0.5;
    let u = condensed.interior.receptacle.displacements(&force, 0.0);
    let mesh = &model.bodies.receptacle.mesh;
    for i in (0..body.x.len()).step_by(13) {
        let at = u[mesh.surface_node(i)];
        for (d, u) in at.iter().enumerate() {
            let column = |e: usize| body.compliance.get(2 * i + d, 2 * middle + e);
            let expected = 0.3 * column(0) - 0.5 * column(1);
            assert!((u - expected).abs() < 1e-12 * body.compliance.get(2 * middle, 2 * middle));
        }
        assert!(
            u[mesh.far_node(i)]
                .iter()
                .all(|u| u.abs() < f64::MIN_POSITIVE)
        );
    }
}
