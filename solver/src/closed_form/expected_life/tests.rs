use super::*;
use crate::model::tests::fuzz_button;
use crate::scene::{Block, Layer, Mission, Motion, Order, Timing, WearLaw};

const GOLD_MM: f64 = 0.76e-3;
const NICKEL_MM: f64 = 1.27e-3;

/// An SD card's tip of 0.4 mm with 0.625 N/mm; gold of a rate over nickel that wears 4 times as fast, over a base 20 times.
fn card(amplitude_mm: f64, rates: Sides<f64>) -> Scene {
    let mut scene = fuzz_button();
    scene.slider.shape.radius_mm = 0.4;
    scene.slider.shape.half_width_mm = 0.3;
    scene.load_n_per_mm = 0.625;
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    };
    let plating = |rate: f64| {
        let layer = |thickness_mm, rate_per_mpa| Layer {
            thickness_mm,
            rate_per_mpa,
        };
        vec![layer(GOLD_MM, rate), layer(NICKEL_MM, 4.0 * rate)]
    };
    let base = |rate: f64| {
        Some(WearLaw::Archard {
            k_over_h_per_mpa: 20.0 * rate,
        })
    };
    if rates.slider > 0.0 {
        scene.slider.plating = plating(rates.slider);
        scene.slider.wear = base(rates.slider);
    }
    scene.receptacle.wear = None;
    if rates.receptacle > 0.0 {
        scene.receptacle.plating = plating(rates.receptacle);
        scene.receptacle.wear = base(rates.receptacle);
    }
    scene
}

fn both(rate: f64) -> Sides<f64> {
    Sides {
        slider: rate,
        receptacle: rate,
    }
}

fn life(scene: &Scene, side: Side, depth_mm: f64) -> f64 {
    cycles(scene, Criterion::deepest(side, depth_mm)).expect("it wears so deep")
}

fn is_close(a: f64, b: f64, tolerance: f64) -> bool {
    (a / b - 1.0).abs() < tolerance
}

/// Matings of 1.5 mm: the tip's gold lasts 218 where that of the pad lasts 10 000.
#[test]
fn the_tip_is_through_long_before_the_pad() {
    let scene = card(0.75, both(6.1e-8));
    let pad = life(&scene, Side::Receptacle, GOLD_MM);
    // The floor alone has 9 967; the tip is far through its plating by then, and its flat almost as wide as the stroke.
    assert!(pad > 9_967.0 && pad < 1.3 * 9_967.0, "{pad}");
    let tip = life(&scene, Side::Slider, GOLD_MM);
    assert!(is_close(tip, 218.5, 1e-3), "{tip}");
    let section = 4.0 / 3.0 * (2.0 * 0.4 * GOLD_MM).sqrt() * GOLD_MM;
    assert!(
        is_close(tip, section / (6.1e-8 * 0.625 * 3.0), 1e-9),
        "{tip}"
    );
}

#[test]
fn layers_add_their_doses() {
    let through = GOLD_MM + NICKEL_MM;
    let pad_alone = Sides {
        slider: 0.0,
        receptacle: 1e-8,
    };
    let pad = life(&card(0.75, pad_alone), Side::Receptacle, through);
    let expected = (GOLD_MM / 1e-8 + NICKEL_MM / 4e-8) / (2.0 * 0.625);
    assert!(is_close(pad, expected, 1e-12), "{pad} {expected}");
    // The doses of all places of an arc, summed: each place has the dose of its depth.
    let dose = |z: f64| z.min(GOLD_MM) / 1e-8 + (z - GOLD_MM).max(0.0) / 4e-8;
    let half_width = (2.0_f64 * 0.4 * through).sqrt();
    let parts = 20_000;
    let sum: f64 = (0..parts)
        .map(|i| (f64::from(i) + 0.5) / f64::from(parts) * half_width)
        .map(|x| dose(through - x * x / 0.8))
        .sum();
    let summed = 2.0 * half_width / f64::from(parts) * sum / (0.625 * 3.0);
    let tip = life(&card(0.75, both(1e-8)), Side::Slider, through);
    assert!(is_close(tip, summed, 1e-6), "{tip} {summed}");
}

#[test]
fn one_layer_is_archards_law_and_layers_of_one_rate_are_one_layer() {
    let mut layered = card(0.75, both(1e-8));
    for layer in &mut layered.slider.plating {
        layer.rate_per_mpa = 1e-8;
    }
    let mut bare = layered.clone();
    bare.slider.plating.clear();
    bare.slider.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 1e-8,
    });
    let depth = 1.5e-3;
    let (layered, bare) = (
        life(&layered, Side::Slider, depth),
        life(&bare, Side::Slider, depth),
    );
    assert!(is_close(layered, bare, 1e-12), "{layered} {bare}");
}

#[test]
fn short_strokes_wear_one_scar_into_both_bodies() {
    let scene = card(1e-6, both(1e-8));
    let (tip, pad) = (
        life(&scene, Side::Slider, GOLD_MM),
        life(&scene, Side::Receptacle, GOLD_MM),
    );
    assert!(is_close(tip, pad, 1e-3), "{tip} {pad}");
    // Twice the depth at twice the rate.
    let depth = 2.0 * GOLD_MM;
    let section = 4.0 / 3.0 * (2.0 * 0.4 * depth).sqrt() * depth;
    assert!(
        is_close(tip, section / (2e-8 * 0.625 * 4e-6), 1e-3),
        "{tip}"
    );
    // Beside a body that does not wear, each has the scar alone.
    for side in Side::BOTH {
        let mut rates = both(0.0);
        *rates.of_mut(side) = 1e-8;
        let scene = card(1e-6, rates);
        let alone = life(&scene, side, GOLD_MM);
        let section = 4.0 / 3.0 * (2.0 * 0.4 * GOLD_MM).sqrt() * GOLD_MM;
        let expected = section / (1e-8 * 0.625 * 4e-6);
        assert!(
            is_close(alone, expected, 0.03),
            "{side:?} {alone} {expected}"
        );
    }
}

#[test]
fn a_groove_is_a_floor_where_its_arc_is_as_wide_as_the_stroke() {
    let amplitude = (2.0_f64 * 0.4 * GOLD_MM).sqrt();
    let rates = Sides {
        slider: 0.0,
        receptacle: 1e-8,
    };
    let of = |amplitude: f64| life(&card(amplitude, rates), Side::Receptacle, GOLD_MM);
    let (long, short) = (of(amplitude * (1.0 + 1e-9)), of(amplitude * (1.0 - 1e-9)));
    assert!(is_close(long, short, 1e-6), "{long} {short}");
}

#[test]
fn what_never_wears_so_deep_has_no_life() {
    let mut scene = card(0.75, both(1e-8));
    scene.receptacle.wear = None;
    let of = |scene: &Scene, side, depth| cycles(scene, Criterion::deepest(side, depth));
    assert!(of(&scene, Side::Receptacle, GOLD_MM + NICKEL_MM).is_some());
    assert_eq!(of(&scene, Side::Receptacle, 3e-3), None);
    scene.slider.plating.clear();
    scene.slider.wear = None;
    assert_eq!(of(&scene, Side::Slider, 1e-6), None);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.0,
        period_s: 1.0,
    };
    assert_eq!(of(&scene, Side::Receptacle, GOLD_MM), None);
}

#[test]
fn half_of_a_scar_is_exposed_later_than_its_deepest_place() {
    let scene = card(0.75, both(1e-8));
    let half = Criterion {
        part: 0.5,
        ..Criterion::deepest(Side::Slider, GOLD_MM)
    };
    let (first, half) = (
        life(&scene, Side::Slider, GOLD_MM),
        cycles(&scene, half).expect("it wears so deep"),
    );
    assert!(half > 1.1 * first && half < 2.0 * first, "{first} {half}");
}

/// Runs of both bodies bare, at equal rates of 1e-8 1/MPa and a tolerance of 10 %: cycles until 0.76 um on either side.
#[test]
fn lives_of_two_bodies_are_those_of_runs() {
    for (amplitude_um, tip, pad) in [
        (1.0, 1.395, 23.958),
        (5.0, 1.284, 5.568),
        (20.0, 1.094, 2.172),
        (30.0, 1.057, 1.78),
    ] {
        let amplitude = 1e-3 * amplitude_um;
        let mut scene = card(amplitude, both(1e-8));
        let law = Some(WearLaw::Archard {
            k_over_h_per_mpa: 1e-8,
        });
        scene.slider.plating.clear();
        scene.receptacle.plating.clear();
        (scene.slider.wear, scene.receptacle.wear) = (law, law);
        let section = 4.0 / 3.0 * (2.0 * 0.4 * GOLD_MM).sqrt() * GOLD_MM;
        let rider = section / (1e-8 * 0.625 * 4.0 * amplitude);
        let floor = GOLD_MM / (2e-8 * 0.625);
        let found = life(&scene, Side::Slider, GOLD_MM) / rider;
        assert!(is_close(found, tip, 0.03), "{amplitude_um} um: tip {found}");
        let found = life(&scene, Side::Receptacle, GOLD_MM) / floor;
        assert!(is_close(found, pad, 0.06), "{amplitude_um} um: pad {found}");
    }
}

/// A card that meets strokes of these amplitudes, mm, in blocks of so many cycles.
fn card_of_mission(blocks: &[(f64, u64)], rates: Sides<f64>) -> Scene {
    let blocks = blocks.iter().map(|(amplitude_mm, cycles)| Block {
        motion: Motion::Reciprocating {
            amplitude_mm: *amplitude_mm,
            period_s: 1.0,
        },
        timing: Timing::Sine,
        cycles: *cycles,
    });
    let mission = Mission {
        blocks: blocks.collect(),
        repeat: 1_000,
        order: Order::InOrder,
    };
    Scene {
        motion: mission.mean_motion(),
        mission: Some(mission),
        ..card(0.75, rates)
    }
}

#[test]
fn blocks_of_one_motion_are_that_motion_and_blocks_at_rest_only_count() {
    let alone = card(0.02, both(1e-8));
    let divided = card_of_mission(&[(0.02, 30), (0.02, 10)], both(1e-8));
    let resting = card_of_mission(&[(0.02, 30), (0.0, 10)], both(1e-8));
    for side in Side::BOTH {
        let [alone, divided, resting] =
            [&alone, &divided, &resting].map(|scene| life(scene, side, GOLD_MM));
        assert!(is_close(divided, alone, 1e-12), "{divided} {alone}");
        assert!(
            is_close(resting, 40.0 / 30.0 * alone, 1e-12),
            "{resting} {alone}"
        );
    }
}

/// A floor that all strokes pass twice a cycle receives 2 P' of each, whatever its length.
#[test]
fn passes_of_all_blocks_wear_a_floor() {
    let pad_alone = Sides {
        slider: 0.0,
        receptacle: 1e-8,
    };
    let mission = card_of_mission(&[(0.75, 4), (0.1, 16)], pad_alone);
    let found = life(&mission, Side::Receptacle, GOLD_MM);
    let expected = GOLD_MM / (2e-8 * 0.625);
    assert!(is_close(found, expected, 1e-12), "{found} {expected}");
}

/// `tests/specs/sd_card_ten_years.json`: 4 matings of +-500 um and 2 000 cycles of +-1.605 um a week, with 7 cycles at rest. A run of it at
/// 2 % exposes the tip's nickel after 687 770 cycles, and has worn 57.5 % of the pad's gold after 1 045 720.
#[test]
fn lives_of_a_mission_are_those_of_a_run() {
    let blocks = [(0.5, 4), (1.605e-3, 2_000), (0.0, 7)];
    let scene = card_of_mission(&blocks, both(6e-9));
    // The forms are 16 % long and 26 % short here: a change of them shows.
    let tip = life(&scene, Side::Slider, GOLD_MM);
    assert!(is_close(tip, 687_770.0, 0.2), "{tip}");
    let pad = life(&scene, Side::Receptacle, 0.575 * GOLD_MM);
    assert!(is_close(pad, 1_045_720.0, 0.27), "{pad}");
}
