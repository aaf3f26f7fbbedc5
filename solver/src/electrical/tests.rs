//! Resistances of contacts with closed solutions.

use super::*;
use crate::change::Change;
use crate::law::resistance::{Deformation, Growth};
use crate::scene::{Metal, Spots};

const GOLD: f64 = 2.21e-8;

fn metal(bottom_mm: f64, resistivity_ohm_m: f64, hardness_mpa: f64) -> Metal {
    Metal {
        bottom_mm,
        resistivity_ohm_m,
        hardness_mpa,
        film: None,
    }
}

fn base(resistivity_ohm_m: f64) -> Metal {
    metal(f64::INFINITY, resistivity_ohm_m, 1_700.0)
}

fn electrical(metals: Sides<Vec<Metal>>) -> Electrical {
    Electrical {
        width_mm: 0.5,
        metals,
        spots: Spots {
            count: 1,
            cluster_diameter_mm: 0.0,
            deformation: Deformation::Plastic,
        },
        frequency_hz: None,
        current_a: None,
        stop_mohm: Vec::new(),
        life_mohm: Vec::new(),
    }
}

/// A base with a film.
fn filmed(film: Film) -> Metal {
    Metal {
        film: Some(film),
        ..base(GOLD)
    }
}

/// A layer of gold, on one side, over a base with a film.
fn gold_over(film: Film) -> Electrical {
    electrical(Sides {
        slider: vec![base(GOLD)],
        receptacle: vec![metal(1e-3, GOLD, 1_700.0), filmed(film)],
    })
}

fn of_gold() -> Electrical {
    electrical(Sides {
        slider: vec![base(GOLD)],
        receptacle: vec![base(GOLD)],
    })
}

const X: [f64; 5] = [-2e-3, -1e-3, 0.0, 1e-3, 2e-3];

/// A contact of 0.5 N from -1 to 1 um, on a receptacle of these depths.
fn contact(depth: &[f64; 5], time_s: f64) -> Contact<'_> {
    let surface = |depth| Surface { x: &X, depth };
    Contact {
        load_n_per_mm: 1.0,
        span: (-1e-3, 1e-3),
        surfaces: Sides {
            slider: surface(&[0.0; 5]),
            receptacle: surface(depth),
        },
        time_s,
        spreading: Sides::default(),
    }
}

/// Takes a contact that has been the same since the last one into a state.
fn update(electrical: &Electrical, state: &mut ElectricalState, contact: &Contact<'_>) {
    let evaluation = Evaluation::new(electrical);
    evaluation.update(state, |_| evaluation.section(contact));
}

fn resistance(electrical: &Electrical, depth: &[f64; 5]) -> ContactResistance {
    let mut state = ElectricalState::default();
    update(electrical, &mut state, &contact(depth, 0.0));
    state.resistance.expect("it is computed")
}

/// Depth 0 on the left half of the contact, 1 um deeper than a layer of 1 um on the right one.
const HALF: [f64; 5] = [0.0, 0.0, 1e-3, 2e-3, 2e-3];

#[test]
fn a_spot_of_gold_has_the_resistance_of_the_reference() {
    let found = resistance(&of_gold(), &[0.0; 5]);
    assert!((found.total_mohm - 1.142_03).abs() < 1e-5, "{found:?}");
    assert!((found.spot_radius_um - 9.675_77).abs() < 1e-5);
    let Sides { slider, receptacle } = found.constriction_mohm;
    assert!((slider - receptacle).abs() < 1e-15 && found.film_mohm <= 0.0);
}

#[test]
fn spots_in_a_circle_have_the_resistance_of_greenwood() {
    let mut many = of_gold();
    many.spots = Spots {
        count: 50,
        cluster_diameter_mm: 0.2,
        deformation: Deformation::Plastic,
    };
    let radius = 9.675_77e-3 / 50.0_f64.sqrt();
    let places = crate::law::resistance::spots::in_circle(50, 0.1);
    let pairs = crate::law::resistance::spots::pair_sum(&places);
    let expected = 1e6 * GOLD * (1.0 / (100.0 * radius) + pairs / PI);
    let found = resistance(&many, &[0.0; 5]);
    assert!(
        (found.total_mohm / expected - 1.0).abs() < 1e-6,
        "{found:?} {expected}"
    );
    // More spots have less, a smaller circle more resistance; spots that fill it are one of their area.
    assert!(found.total_mohm < resistance(&of_gold(), &[0.0; 5]).total_mohm);
    many.spots.cluster_diameter_mm = 0.1;
    assert!(resistance(&many, &[0.0; 5]).total_mohm > found.total_mohm);
    many.spots.cluster_diameter_mm = 0.01;
    let joined = resistance(&many, &[0.0; 5]).total_mohm;
    assert!((joined - 1.142_03).abs() < 1e-5, "{joined}");
}

#[test]
fn patches_are_in_parallel_and_their_parts_add_up() {
    let film = Film {
        specific_resistance_ohm_mm2: 1e-6,
        growth: None,
    };
    let layer = metal(1e-3, GOLD, 1_700.0);
    let below = Metal {
        film: Some(film),
        ..base(GOLD)
    };
    let plated = electrical(Sides {
        slider: vec![base(GOLD)],
        receptacle: vec![layer, below],
    });
    // The depth passes 1 um where the contact is three quarters covered: at x = 0, linear from -1 to 1 um.
    let found = resistance(&plated, &HALF);
    assert!((found.filmed_fraction - 0.5).abs() < 1e-12, "{found:?}");
    let clean = 1.142_03;
    let covered = 1e3 * 1e-6 / (0.5 / 1_700.0);
    let expected = 1.0 / (0.5 / clean + 0.5 / (clean + covered));
    assert!(
        (found.total_mohm / expected - 1.0).abs() < 1e-4,
        "{found:?} {expected}"
    );
    let Sides { slider, receptacle } = found.constriction_mohm;
    let sum = slider + receptacle + found.film_mohm;
    assert!((sum / found.total_mohm - 1.0).abs() < 1e-12);
    // All of it exposed, all of it covered.
    let worn = resistance(&plated, &[2e-3; 5]);
    assert!((worn.total_mohm - clean - covered).abs() < 1e-4 && worn.filmed_fraction >= 1.0);
    let unworn = resistance(&plated, &[0.0; 5]);
    assert!((unworn.total_mohm - clean).abs() < 1e-4 && unworn.film_mohm <= 0.0);
}

#[test]
fn swapped_sides_have_the_same_resistance() {
    let plated = vec![metal(1e-3, GOLD, 1_700.0), base(7e-8)];
    let bare = vec![base(1.7e-8)];
    let one = electrical(Sides {
        slider: bare.clone(),
        receptacle: plated.clone(),
    });
    let other = electrical(Sides {
        slider: plated,
        receptacle: bare,
    });
    let found = resistance(&one, &HALF);
    let mut state = ElectricalState::default();
    let straight = contact(&HALF, 0.0);
    let swapped = Contact {
        surfaces: Sides {
            slider: straight.surfaces.receptacle,
            receptacle: straight.surfaces.slider,
        },
        ..straight
    };
    update(&other, &mut state, &swapped);
    let swapped = state.resistance.expect("it is computed");
    assert!((swapped.total_mohm / found.total_mohm - 1.0).abs() < 1e-14);
    let [a, b] = [found, swapped].map(|found| found.constriction_mohm);
    assert!((a.slider / b.receptacle - 1.0).abs() < 1e-14);
}

#[test]
fn a_film_grows_from_the_exposure_of_its_metal_on() {
    let film = Film {
        specific_resistance_ohm_mm2: 1e-6,
        growth: Some(Growth {
            exponent: 0.5,
            time_s: 100.0,
        }),
    };
    let plated = gold_over(film);
    let evaluation = Evaluation::new(&plated);
    let mut state = ElectricalState::default();
    let mut film_at = |depth: [f64; 2], time_s: [f64; 2]| {
        evaluation.update(&mut state, |part| {
            let at = |[from, to]: [f64; 2]| from + part * (to - from);
            evaluation.section(&contact(&[at(depth); 5], at(time_s)))
        });
        state
            .resistance
            .map(|found| found.film_mohm)
            .expect("it is computed")
    };
    assert!(film_at([0.0; 2], [0.0, 50.0]) <= 0.0);
    // Exposed after half of the time from 40 to 60 s.
    film_at([0.0, 2e-3], [40.0, 60.0]);
    let grown = film_at([2e-3; 2], [60.0, 450.0]);
    let expected = 2.0 * 1e3 * 1e-6 / (0.5 / 1_700.0);
    // Located to 1e-9 of the 20 s, of which a film of 400 s has half of the part.
    assert!((grown / expected - 1.0).abs() < 1e-10, "{grown} {expected}");
    // The metal at the surface is exposed from the start.
    let mut state = ElectricalState::default();
    let bare = electrical(Sides {
        slider: vec![base(GOLD)],
        receptacle: vec![filmed(film)],
    });
    for time_s in [0.0, 400.0] {
        update(&bare, &mut state, &contact(&[0.0; 5], time_s));
    }
    let found = state.resistance.expect("it is computed").film_mohm;
    assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
}

/// A depth that grows evenly through a layer of gold over a base with a film, which shows all of the base at once.
#[test]
fn a_limit_of_a_jump_is_reached_where_the_metal_is_exposed() {
    let film = Film {
        specific_resistance_ohm_mm2: 1.0,
        growth: None,
    };
    let plated = gold_over(film);
    let evaluation = Evaluation::new(&plated);
    let during = |part: f64| evaluation.section(&contact(&[0.5e-3 + 2e-3 * part; 5], part));
    let mut before = ElectricalState::default();
    evaluation.update(&mut before, |_| during(0.0));
    let mut after = before.clone();
    evaluation.update(&mut after, during);
    let (clean, covered) = (before.total_mohm(), after.total_mohm());
    let (clean, covered) = (clean.expect("computed"), covered.expect("computed"));
    assert!(covered > 1e3 * clean, "{clean} {covered}");
    let change = Change {
        before: &before,
        after: &after,
    };
    for limit in [1.01 * clean, 10.0 * clean, 0.999 * covered] {
        let part = evaluation.part_at(limit, change, during);
        assert!(
            (part - 0.25).abs() < 1e-9 && part >= 0.25,
            "{limit}: {part}"
        );
    }
    // A limit that is exceeded from the beginning is reached at once.
    let part = evaluation.part_at(0.9 * clean, change, during);
    assert!(part <= 0.0, "{part}");
}

#[test]
fn what_has_not_changed_is_not_computed_again() {
    let mut broken = of_gold();
    let mut state = ElectricalState::default();
    update(&of_gold(), &mut state, &contact(&[0.0; 5], 0.0));
    let known = state.clone();
    // A resistivity that a new evaluation would take.
    broken.metals.slider[0].resistivity_ohm_m = 1.0;
    update(&broken, &mut state, &contact(&[0.0; 5], 1.0));
    assert_eq!(state.resistance, known.resistance);
    update(&broken, &mut state, &contact(&[1e-6; 5], 1.0));
    assert!(state.resistance != known.resistance);
}

#[test]
fn a_contact_without_load_is_open() {
    let mut state = ElectricalState::default();
    let mut unloaded = contact(&[0.0; 5], 0.0);
    unloaded.load_n_per_mm = 0.0;
    let gold = of_gold();
    update(&gold, &mut state, &unloaded);
    let total = |state: &ElectricalState| state.resistance.map(|found| found.total_mohm);
    assert_eq!(total(&state), Some(OPEN_MOHM));
    // Loaded again, it conducts.
    update(&gold, &mut state, &contact(&[0.0; 5], 1.0));
    assert!(total(&state).is_some_and(|total| total < 2.0));
    // A hardly loaded one is no worse than open, a contact without length has the metals of its middle.
    unloaded.load_n_per_mm = 1e-300;
    update(&gold, &mut state, &unloaded);
    assert!(total(&state).is_some_and(|total| total <= OPEN_MOHM));
    let mut point = contact(&HALF, 2.0);
    point.span = (0.5e-3, 0.5e-3);
    update(&gold, &mut state, &point);
    assert!(total(&state).is_some_and(|total| total < 2.0));
}

#[test]
fn the_bodies_are_in_series_by_the_resistivity_of_their_bases() {
    let mut bodies = contact(&[0.0; 5], 0.0);
    bodies.spreading = Sides {
        slider: 1.5,
        receptacle: 0.5,
    };
    let mut state = ElectricalState::default();
    update(&of_gold(), &mut state, &bodies);
    let found = state.resistance.expect("it is computed");
    // 2.21e-8 ohm m over 0.5 mm: 0.0442 mOhm a square.
    assert!(
        (found.bulk_mohm.slider - 1.5 * 0.0442).abs() < 1e-12,
        "{found:?}"
    );
    assert!((found.total_mohm - 1.142_03 - 2.0 * 0.0442).abs() < 1e-5);
}
