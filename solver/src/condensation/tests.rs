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

/// The recovered interior agrees with the compliance on the surface, beside the near field of a tangential force, and
/// satisfies the clamp.
#[test]
fn interior_and_surface_agree() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let condensed = condense(&model).expect("the preset can be condensed");
    let body = &condensed.operators.receptacle;
    let mesh = &model.bodies.receptacle.mesh;
    let middle = body.x.len() / 2;
    for (direction, near) in [(0, near_field::REACH), (1, 0)] {
        let mut force = vec![0.0; 2 * body.x.len()];
        force[2 * middle + direction] = 0.3;
        let u = condensed.interior.receptacle.displacements(&force, 0.0);
        for i in (0..body.x.len()).filter(|i| i.abs_diff(middle) >= near) {
            for (d, u) in u[mesh.surface_node(i)].iter().enumerate() {
                let expected = 0.3 * body.compliance.get(2 * i + d, 2 * middle + direction);
                let largest = body.compliance.get(2 * middle, 2 * middle);
                assert!((u - expected).abs() < 1e-12 * largest, "{direction} {i}");
            }
            let far = u[mesh.far_node(i)];
            assert!(far.iter().all(|u| u.abs() < f64::MIN_POSITIVE));
        }
    }
}

/// Near a force the surface follows a tangential force as it follows a normal one; a uniform shear moves it as the elements
/// alone do.
#[test]
fn near_fields_are_equal_in_both_directions() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let condensed = condense(&model).expect("the preset can be condensed");
    let body = &condensed.operators.receptacle;
    let middle = body.x.len() / 2;
    let local = |d: usize, i: usize| {
        let at = |i: usize| body.compliance.get(2 * i + d, 2 * middle + d);
        at(middle) - at(i)
    };
    for i in middle + 1..middle + near_field::REACH {
        let ratio = local(0, i) / local(1, i);
        // 0.96 to 0.98: the rest is the change on the diagonal that keeps a uniform shear.
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    }
    let shear: Vec<f64> = body.widths.iter().flat_map(|w| [*w, 0.0]).collect();
    let u = condensed.interior.receptacle.displacements(&shear, 0.0);
    for i in (0..body.x.len()).step_by(13) {
        let sum = |(j, width): (usize, &f64)| body.compliance.get(2 * i, 2 * j) * width;
        let found: f64 = body.widths.iter().enumerate().map(sum).sum();
        let expected = u[model.bodies.receptacle.mesh.surface_node(i)][0];
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
}
