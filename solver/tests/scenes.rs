//! The scenes of the suite.

use solver::scene::Switches;
use solver::scene::{
    Accuracy, BlockShape, Body, Conduction, Dimension, Drive, Elastic, Friction, Motion, Output,
    Scene, SliderShape, Softening, Timing, WearLaw,
};

const STEEL: Elastic = Elastic {
    youngs_modulus_mpa: 200e3,
    poisson_ratio: 0.3,
};
const COPPER: Elastic = Elastic {
    youngs_modulus_mpa: 117e3,
    poisson_ratio: 0.34,
};

/// k/H of copper on copper as the thesis uses it, 1/MPa (its table 5 and section 5.3).
pub(crate) const COPPER_WEAR: f64 = 0.011 / 427.0;

/// Cylinder of 6 mm on a flat, 18.5 N/mm, +-25 um, both sides wear (McColl, Ding and Leen 2004).
pub(crate) fn mccoll() -> Scene {
    let wear = |k_over_h_per_mpa| Some(WearLaw::Archard { k_over_h_per_mpa });
    Scene {
        slider: Body {
            shape: SliderShape {
                radius_mm: 6.0,
                half_width_mm: 4.5,
                height_mm: 6.0,
            },
            elastic: STEEL,
            wear: wear(1.9e-8),
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        receptacle: Body {
            shape: BlockShape {
                length_mm: 12.0,
                height_mm: 6.0,
                crown_radius_mm: None,
            },
            elastic: STEEL,
            wear: wear(2.9e-8),
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        friction: Friction::Coulomb { coefficient: 0.9 },
        temperature_c: 20.0,
        load_n_per_mm: 18.5,
        spring_n_per_mm2: 0.0,
        drive: Drive::Handle,
        motion: Motion::Reciprocating {
            amplitude_mm: 0.025,
            period_s: 0.05,
        },
        timing: Timing::Sine,
        cycles: 18_000,
        mission: None,
        cycles_at_a_time: None,
        accuracy: Accuracy::from_tolerance(0.02),
        output: Output {
            stations_mm: vec![0.0, 0.05, 0.1, 0.2],
            snapshots_at_cycles: vec![1_000, 5_000, 10_000, 18_000],
            fields: false,
        },
        stop: Vec::new(),
        life: Vec::new(),
        conduction: Conduction::default(),
        effects: Switches::default(),
        scattered: Vec::new(),
        threads: 1,
        dimension: Dimension::PlaneStrain,
    }
}

/// The thesis' fuzz button: half-round wire of 0.0508 mm on a block of 0.08467 mm, copper on copper.
pub(crate) fn fuzz_button() -> Scene {
    Scene {
        slider: Body {
            shape: SliderShape {
                radius_mm: 0.0254,
                half_width_mm: 0.0254,
                height_mm: 0.0254,
            },
            elastic: COPPER,
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
            elastic: COPPER,
            wear: Some(WearLaw::Archard {
                k_over_h_per_mpa: COPPER_WEAR,
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
        cycles: 2_000,
        mission: None,
        cycles_at_a_time: None,
        accuracy: Accuracy::from_tolerance(0.02),
        output: Output {
            stations_mm: vec![-0.04, -0.02, -0.008, 0.0, 0.008, 0.02, 0.04],
            snapshots_at_cycles: vec![1, 150, 240, 360, 480, 585, 800, 1_600, 2_000],
            fields: false,
        },
        stop: Vec::new(),
        life: Vec::new(),
        conduction: Conduction::default(),
        effects: Switches::default(),
        scattered: Vec::new(),
        threads: 1,
        dimension: Dimension::PlaneStrain,
    }
}

fn short(mut scene: Scene, cycles: u64) -> Scene {
    scene.cycles = cycles;
    scene.output.snapshots_at_cycles = Vec::new();
    scene
}

/// The scar of a short stroke: McColl's for 1 500 cycles.
pub(crate) fn scar() -> Scene {
    short(mccoll(), 1_500)
}

/// The groove of a long stroke: the fuzz button's for 25 cycles.
pub(crate) fn groove() -> Scene {
    short(fuzz_button(), 25)
}

/// A sprung contact on a pad, whose stroke is longer than the contact at first and shorter in the end.
pub(crate) fn sprung_contact() -> Scene {
    let mut scene = short(fuzz_button(), 200);
    scene.slider.shape = SliderShape {
        radius_mm: 0.4,
        half_width_mm: 0.3,
        height_mm: 0.4,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 2.0,
        height_mm: 0.3,
        crown_radius_mm: None,
    };
    scene.friction = Friction::Coulomb { coefficient: 0.3 };
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 0.004 / 1700.0,
    });
    scene.load_n_per_mm = 0.625;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.02,
        period_s: 1.0,
    };
    scene.output.stations_mm = Vec::new();
    scene
}

/// The preset `zif` for 500 cycles: a groove some hundred times as deep as the contact's indentation.
pub(crate) fn pin() -> Scene {
    let mut scene = sprung_contact();
    scene.cycles = 500;
    scene.slider.shape = SliderShape {
        radius_mm: 0.25,
        half_width_mm: 0.2,
        height_mm: 0.25,
    };
    scene.receptacle.shape.length_mm = 1.5;
    scene.receptacle.shape.height_mm = 0.46;
    scene.load_n_per_mm = 1.0;
    scene
}

/// Partial slip: McColl's cylinder at 120 N/mm and +-3 um, where two thirds of the contact stick.
pub(crate) fn partial_slip() -> Scene {
    let mut scene = short(mccoll(), 3_000);
    scene.load_n_per_mm = 120.0;
    scene.friction = Friction::Coulomb { coefficient: 0.8 };
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.003,
        period_s: 1.0,
    };
    scene
}
