//! Spreading of the current in a body.
//!
//! * A strip of 2 B whose end has a contact of 2 c in its middle: H/(2 B) + (1/pi) ln(1/sin(pi c/2B)).
//! * A contact as long as the strip: H/(2 B) and the little by which its current is not even.

use std::f64::consts::PI;

use crate::verification::scenes::fuzz_button;
use solver::condensation::condense;
use solver::effects;
use solver::model;
use solver::scene::Motion;

const HALF_LENGTH: f64 = 0.04;
const HEIGHT: f64 = 0.16;

/// Resistance of the strip beyond that of a bar, for a contact of a part of its length with so many elements in its half.
fn excess(share: f64, elements: f64) -> f64 {
    let half_contact = share * HALF_LENGTH;
    let mut scene = fuzz_button();
    scene.receptacle.shape.length_mm = 2.0 * HALF_LENGTH;
    scene.receptacle.shape.height_mm = HEIGHT;
    // The surface is fine along the contact.
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 2.0 * half_contact,
        period_s: 1.0,
    };
    scene.accuracy.contact_element_mm = Some(half_contact / elements);
    let mut model = model::build(&scene, &effects::plan(&scene)).expect("the strip can be meshed");
    model.conducts = true;
    let condensed = condense(&model, 1).expect("the strip can be condensed");
    let ratio = condensed.spreading_ratios((-half_contact, half_contact));
    ratio.receptacle - HEIGHT / (2.0 * HALF_LENGTH)
}

#[test]
fn a_slotted_strip_has_the_resistance_of_the_reference() {
    for (share, expected) in [(0.2, 0.373_810), (0.1, 0.590_502), (0.01, 1.322_141)] {
        let closed = (1.0 / (0.5 * PI * share).sin()).ln() / PI;
        assert!((closed - expected).abs() < 1e-6, "{closed}");
        let numbers = [4.0, 8.0, 16.0];
        let errors = numbers.map(|elements| excess(share, elements) - expected);
        println!("slotted strip, c/B {share}, 4, 8, 16 elements in c: {errors:+.5?}");
        // The potential of elements is too smooth at both edges, by an order of their length: 0.007 of rho/w at eight elements, the
        // fewest that a contact has at 2 %. The rest of the mesh, which grows away from the contact, adds less than 0.002.
        for (elements, error) in numbers.iter().zip(errors) {
            let most = 0.06 / elements + 2e-3;
            assert!((-most..0.0).contains(&error), "{errors:?}");
        }
        for pair in errors.windows(2) {
            assert!(pair[1].abs() < 0.75 * pair[0].abs(), "{errors:?}");
        }
    }
}
