use super::*;
use crate::scene::Dimension;
use crate::scene::Switches;
use crate::scene::{
    Accuracy, BlockShape, Body, Conduction, Criterion, Friction, Motion, Output, SliderShape,
    Softening, Timing, WearLaw,
};
use crate::sides::Side;

pub(crate) fn fuzz_button() -> Scene {
    let copper = Elastic {
        youngs_modulus_mpa: 117e3,
        poisson_ratio: 0.34,
    };
    Scene {
        slider: Body {
            shape: SliderShape {
                radius_mm: 0.0254,
                half_width_mm: 0.0254,
                height_mm: 0.0254,
            },
            elastic: copper,
            wear: None,
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        receptacle: Body {
            shape: BlockShape {
                length_mm: 0.08467,
                height_mm: 0.0635,
                crown_radius_mm: None,
            },
            elastic: copper,
            wear: Some(WearLaw::Archard {
                k_over_h_per_mpa: 0.011 / 427.0,
            }),
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        friction: Friction::Coulomb { coefficient: 1.21 },
        temperature_c: 20.0,
        load_n_per_mm: 0.508,
        spring_n_per_mm2: 0.0,
        drive: Drive::Handle,
        motion: Motion::Reciprocating {
            amplitude_mm: 0.033_868,
            period_s: 16.0,
        },
        timing: Timing::Sine,
        cycles: 2000,
        mission: None,
        cycles_at_a_time: None,
        accuracy: Accuracy::from_tolerance(0.02),
        output: Output {
            stations_mm: vec![0.0],
            snapshots_at_cycles: vec![],
            fields: false,
        },
        stop: Side::BOTH
            .map(|side| Criterion::deepest(side, 1.0))
            .to_vec(),
        life: Vec::new(),
        conduction: Conduction::default(),
        effects: Switches::default(),
        scattered: Vec::new(),
        threads: 1,
        dimension: Dimension::PlaneStrain,
    }
}

#[test]
fn a_half_round_slider_ends_in_tips_on_its_top_face() {
    let model = build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let x = model.bodies.slider.layout.x.clone();
    assert!((x[0] + 0.0254).abs() < 1e-15);
    assert_eq!(
        model.bodies.slider.zones[0].mesh.surface_node(0),
        model.bodies.slider.zones[0].mesh.far_node(0)
    );
    assert!(model.bodies.slider.layout.contact.0 > 0);
}

#[test]
fn widths_of_contact_nodes_add_up_to_the_surface() {
    let model = build(&fuzz_button(), &crate::effects::plan(&fuzz_button()))
        .expect("the preset can be meshed");
    let sum: f64 = model.bodies.receptacle.contact_widths().iter().sum();
    assert!((sum - 0.08467).abs() < 1e-14);
}

#[test]
fn too_fine_an_element_is_refused_with_the_limit() {
    let mut scene = fuzz_button();
    scene.accuracy.contact_element_mm = Some(1e-6);
    assert!(matches!(
        build(&scene, &crate::effects::plan(&scene)),
        Err(MeshError::TooLarge {
            limit: layout::MOST_SURFACE_NODES,
            ..
        })
    ));
}

#[test]
fn skipped_effects_leave_the_model() {
    let mut scene = fuzz_button();
    let plan = crate::effects::plan(&scene);
    let model = build(&scene, &plan).expect("the preset can be meshed");
    assert!(model.relocates && model.interface.wear.receptacle.is_some());
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.0,
        period_s: 1.0,
    };
    let plan = crate::effects::plan(&scene);
    let model = build(&scene, &plan).expect("the preset can be meshed");
    assert!(!model.relocates);
    assert_eq!(model.interface.wear, Sides::default());
}
