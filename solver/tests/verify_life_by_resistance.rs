//! Lives by the contact resistance, which jumps where a metal with a film is exposed.
//!
//! * No such life ends before the exposure that causes it, in any scene.
//! * The floor of a long groove is through its layers at once, after t/(2 k P) cycles of each: so long does the resistance stay low. A film
//!   that grows in proportion to the time reaches a limit by as much later as it takes to grow.

use crate::verification::recorder::solve;
use crate::verification::verify_contact_resistance::{
    FILM, FORCE, clean_and_covered, filmed, limited,
};
use crate::verification::verify_plating::{RATES, THICKNESS, layer};
use crate::verification::verify_section_and_ball::as_ball;
use fastrand::Rng;
use solver::closed_form::half_lengths_mm;
use solver::law::resistance::{Film, Growth};
use solver::record::CriterionState;
use solver::scene::{Accuracy, Conduction, Criterion, Motion, Scene};
use solver::sides::Side;

fn lives(scene: &Scene) -> (Vec<CriterionState>, Vec<CriterionState>) {
    let (summary, _) = solve(scene).expect("the scene can be solved");
    (summary.life.criteria, summary.life.resistance)
}

#[test]
fn the_resistance_of_a_groove_rises_when_its_floor_is_through() {
    let (clean, covered) = clean_and_covered();
    let load = filmed(0.1, None).load_n_per_mm;
    let layers = THICKNESS.iter().zip(RATES);
    let through: f64 = layers.map(|(mm, rate)| mm / (2.0 * rate * load)).sum();
    for base_wears in [true, false] {
        // Seconds, of a cycle each, in which the film has grown to what it otherwise is at once.
        for growth_s in [None, Some(0.05 * through)] {
            let growth = growth_s.map(|time_s| Growth {
                exponent: 1.0,
                time_s,
            });
            let limits = [1.5 * clean, 0.5 * covered];
            let mut scene = limited(filmed(0.1, growth), &[0.6 * covered], &limits);
            if !base_wears {
                scene.receptacle.wear = None;
            }
            let (_, found) = lives(&scene);
            for (state, limit) in found.iter().zip(limits) {
                let grown = (limit - clean) / (covered - clean);
                let expected = through + growth_s.unwrap_or(0.0) * grown;
                let off = state.cycles.expect("it is reached") / expected - 1.0;
                println!(
                    "base wears: {base_wears}, growth {growth_s:?} s: {limit:.2} mOhm after {expected:.1} cycles, off by {off:+.1e}"
                );
                // As exactly as the layers last (`verify_plating`).
                assert!(off.abs() < 1e-3, "{off}");
            }
        }
    }
}

/// A plated contact, a section or a ball, with a film on what is exposed last or before.
struct Drawn {
    scene: Scene,
    /// The number of the layer, from the surface down, whose loss exposes a film.
    above_film: usize,
}

fn log(random: &mut Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(random.f64())
}

fn drawn(random: &mut Rng) -> Drawn {
    let amplitude = log(random, 0.004, 0.1);
    let growth = random.bool().then(|| Growth {
        exponent: 0.5,
        time_s: log(random, 1.0, 1e4),
    });
    let mut scene = filmed(amplitude, growth);
    let thin = [0.2, 1.0].map(|factor| factor * log(random, 0.5, 1.5));
    let layers = [0, 1].map(|i| {
        let rate = RATES[i] * log(random, 0.5, 2.0);
        layer(thin[i] * THICKNESS[i], rate)
    });
    scene.receptacle.plating = layers.to_vec();
    if random.bool() {
        scene.receptacle.wear = None;
    }
    let above_film = random.usize(0..2);
    let bottoms = [
        layers[0].thickness_mm,
        layers[0].thickness_mm + layers[1].thickness_mm,
    ];
    if let Conduction::Known(electrical) = &mut scene.conduction {
        let metals = &mut electrical.metals.receptacle;
        let film = metals[2].film.map(|film| Film {
            specific_resistance_ohm_mm2: FILM * log(random, 3.0, 1e6),
            ..film
        });
        for (number, metal) in metals.iter_mut().enumerate() {
            metal.film = film.filter(|_| number > above_film);
        }
        (metals[0].bottom_mm, metals[1].bottom_mm) = (bottoms[0], bottoms[1]);
    }
    let deepest = |depth| Criterion::deepest(Side::Receptacle, depth);
    scene.life = bottoms.map(deepest).to_vec();
    scene.stop = vec![Criterion {
        part: 0.97,
        ..deepest(bottoms[above_film])
    }];
    scene.accuracy = Accuracy {
        estimate_errors: false,
        ..Accuracy::from_tolerance([0.1, 0.05, 0.02][random.usize(0..3)])
    };
    Drawn { scene, above_film }
}

/// The same contact as that of a ball, whose wider spots have the same share of the force.
fn ball(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let radius = scene.slider.shape.radius_mm;
    as_ball(&mut scene, FORCE, radius);
    let half_length = half_lengths_mm(&scene).expect("it is a ball").0;
    // As short and as coarse as shows the order of events. Sections end with their floor, all of which is exposed in the end.
    scene.cycles = 2_000;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: half_length,
        period_s: 1.0,
    };
    scene.accuracy = Accuracy {
        estimate_errors: false,
        contact_element_mm: Some(half_length / 6.0),
        ..Accuracy::from_tolerance(0.1)
    };
    scene
}

#[test]
fn no_life_by_resistance_ends_before_the_exposure_that_causes_it() {
    let (clean, _) = clean_and_covered();
    let mut random = Rng::with_seed(4);
    let (mut reached, mut together) = (0, 0);
    for draw in 0..12 {
        let Drawn { scene, above_film } = drawn(&mut random);
        let scene = if draw % 6 == 5 { ball(&scene) } else { scene };
        // A resistance that no metal without a film comes to.
        let limits = [10.0, 15.0, 100.0].map(|factor| factor * clean);
        let (exposures, found) = lives(&limited(scene, &[], &limits));
        let Some(exposed) = exposures[above_film].cycles else {
            continue;
        };
        for state in found {
            if let Some(cycles) = state.cycles {
                reached += 1;
                together += usize::from(cycles < 1.01 * exposed);
                assert!(
                    cycles >= exposed,
                    "draw {draw}: {} mOhm after {cycles} cycles, exposed after {exposed}",
                    state.limit
                );
            }
        }
    }
    println!("{reached} limits are reached, {together} of them with the exposure");
    assert!(reached > 20 && together > 10, "{reached} {together}");
}
