//! A surface at a temperature wears as one of the hardness that it has there, to the bit: bases, layers, both sides.

use crate::verification::recorder::solve;
use crate::verification::verify_plating::plated;
use solver::scene::{Scene, Softening, WearLaw};
use solver::sides::Side;

/// Hardness ratios of gold, nickel and the base: powers of two, so that rates are divided exactly.
const RATIOS: [f64; 3] = [0.5, 0.25, 2.0];

fn heated(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let softening = Softening {
        hardness_mpa: Vec::new(),
        ratios: RATIOS.map(Some).to_vec(),
        margins_k: Vec::new(),
        lacks_melting: false,
        to_melting_k: None,
    };
    scene.slider.softening = softening.clone();
    scene.receptacle.softening = softening;
    scene
}

/// The scene with the rates at the temperature.
fn softer(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let (slider, receptacle) = (&mut scene.slider, &mut scene.receptacle);
    for (plating, wear) in [
        (&mut slider.plating, &mut slider.wear),
        (&mut receptacle.plating, &mut receptacle.wear),
    ] {
        for (layer, ratio) in plating.iter_mut().zip(RATIOS) {
            layer.rate_per_mpa /= ratio;
        }
        if let Some(WearLaw::Archard { k_over_h_per_mpa }) = wear {
            *k_over_h_per_mpa /= RATIOS[2];
        }
    }
    scene
}

#[test]
fn a_heated_surface_wears_as_one_of_its_hardness() {
    for amplitude in [0.004, 0.1] {
        let cool = plated(amplitude, &Side::BOTH, 200, 0.1);
        let runs = [&heated(&cool), &softer(&cool), &cool].map(|scene| {
            let (summary, _) = solve(scene).expect("the scene can be solved");
            summary.last
        });
        let [heated, softer, cool] = runs;
        assert_eq!(heated, softer);
        assert!(heated.receptacle.max_depth_mm > 1.2 * cool.receptacle.max_depth_mm);
    }
}
