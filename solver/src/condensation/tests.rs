use super::*;
use crate::model;
use crate::model::tests::fuzz_button;
use crate::scene::Drive;

#[test]
fn compliance_is_symmetric_and_positive() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let operators = condense(&model, 1)
        .expect("the preset can be condensed")
        .operators;
    for body in [&operators.slider, &operators.receptacle] {
        let zone = &body.zones[0];
        assert_eq!(zone.nodes(), 0..body.x.len());
        let c = |i, j| zone.compliance(i, j);
        for i in (0..2 * body.x.len()).step_by(7) {
            assert!(c(i, i) > 0.0);
            for j in (0..i).step_by(11) {
                assert!((c(i, j) - c(j, i)).abs() <= 1e-12 * c(i, i).max(c(j, j)));
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
    let body = condense(&model, 1)
        .expect("the block can be condensed")
        .operators
        .receptacle;
    let middle = 2 * (body.x.len() / 2) + 1;
    let squeezed: f64 = body
        .widths
        .iter()
        .enumerate()
        .map(|(j, width)| body.zones[0].compliance(middle, 2 * j + 1) * width)
        .sum();
    let lame = model.bodies.receptacle.zones[0].lame;
    let expected = 0.05 / (lame.lambda + 2.0 * lame.mu);
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
    let slider = condense(&model, 1)
        .expect("the preset can be condensed")
        .operators
        .slider;
    for i in (0..2 * slider.x.len()).step_by(2) {
        assert!(slider.zones[0].compliance(i, i).abs() < f64::MIN_POSITIVE);
        assert!(slider.zones[0].compliance(i + 1, i + 1) > 0.0);
    }
}

/// The recovered interior agrees with the compliance on the surface, beside the near field of a tangential force, and
/// satisfies the clamp.
#[test]
fn interior_and_surface_agree() {
    let model = model::build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let condensed = condense(&model, 1).expect("the preset can be condensed");
    let body = &condensed.operators.receptacle;
    let mesh = &model.bodies.receptacle.zones[0].mesh;
    let middle = body.x.len() / 2;
    for (direction, near) in [(0, near_field::REACH), (1, 0)] {
        let mut force = vec![0.0; 2 * body.x.len()];
        force[2 * middle + direction] = 0.3;
        let u = condensed
            .displacements(&model, Side::Receptacle, 0, &force, 0.0)
            .expect("the factor is stored");
        for i in (0..body.x.len()).filter(|i| i.abs_diff(middle) >= near) {
            for (d, u) in u[mesh.surface_node(i)].iter().enumerate() {
                let expected = 0.3 * body.zones[0].compliance(2 * i + d, 2 * middle + direction);
                let largest = body.zones[0].compliance(2 * middle, 2 * middle);
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
    let condensed = condense(&model, 1).expect("the preset can be condensed");
    let body = &condensed.operators.receptacle;
    let middle = body.x.len() / 2;
    let local = |d: usize, i: usize| {
        let at = |i: usize| body.zones[0].compliance(2 * i + d, 2 * middle + d);
        at(middle) - at(i)
    };
    for i in middle + 1..middle + near_field::REACH {
        let ratio = local(0, i) / local(1, i);
        // 0.96 to 0.98: the rest is the change on the diagonal that keeps a uniform shear.
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    }
    let shear: Vec<f64> = body.widths.iter().flat_map(|w| [*w, 0.0]).collect();
    let u = condensed
        .displacements(&model, Side::Receptacle, 0, &shear, 0.0)
        .expect("the factor is stored");
    for i in (0..body.x.len()).step_by(13) {
        let sum = |(j, width): (usize, &f64)| body.zones[0].compliance(2 * i, 2 * j) * width;
        let found: f64 = body.widths.iter().enumerate().map(sum).sum();
        let expected = u[model.bodies.receptacle.zones[0].mesh.surface_node(i)][0];
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
}
