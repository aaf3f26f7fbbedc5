//! Jumps that are implicit in the worn shapes: plated contacts in which nothing sticks.
//!
//! * Lives and profiles are those of short jumps of computed cycles, whichever side wears and whatever the ratio of the layers' rates.
//! * Finer jumps and positions give the same lives.
//! * A resumed run gives the same bits.

use crate::verification::recorder::{Recorder, area_between, solve};
use crate::verification::scenes::{COPPER_WEAR, sprung_contact};
use crate::verification::verify_plating::layer;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::record::Summary;
use solver::scene::{Accuracy, Criterion, Elastic, Layer, Refinement, Scene, SliderShape, WearLaw};
use solver::sides::{Side, Sides};

/// Gold and nickel of the presets, 1/MPa.
const GOLD: f64 = 1e-5 / 1_700.0;
const NICKEL: f64 = 2e-4 / 2_000.0;

fn archard(k_over_h_per_mpa: f64) -> WearLaw {
    WearLaw::Archard { k_over_h_per_mpa }
}

/// A scene whose jumps are implicit where they can be.
fn implicit(mut scene: Scene) -> Scene {
    scene.accuracy.tuning.implicit_jumps = true;
    scene
}

fn deepest(side: Side, depth_mm: f64) -> Criterion {
    Criterion {
        side,
        part: 0.0,
        depth_mm,
    }
}

/// A plated side: its layers, and the rate of the base below them.
struct Plated {
    layers: Vec<Layer>,
    base: f64,
}

/// The sprung contact with these sides until the tip's first layer, or the pad's if only that wears, is through twice over.
fn thinly_plated(sides: Sides<Option<Plated>>) -> Scene {
    let mut scene = implicit(sprung_contact());
    let of = |side: Option<Plated>| match side {
        None => (None, Vec::new()),
        Some(Plated { layers, base }) => (Some(archard(base)), layers),
    };
    (scene.slider.wear, scene.slider.plating) = of(sides.slider);
    (scene.receptacle.wear, scene.receptacle.plating) = of(sides.receptacle);
    for (side, layers) in [
        (Side::Slider, &scene.slider.plating),
        (Side::Receptacle, &scene.receptacle.plating),
    ] {
        let mut depth = 0.0;
        for layer in layers {
            depth += layer.thickness_mm;
            scene.life.push(deepest(side, depth));
        }
    }
    scene.cycles = 1_600;
    scene
}

fn gold_on_nickel(gold_mm: f64, base: f64) -> Plated {
    let layers = vec![layer(gold_mm, GOLD), layer(0.05e-3, NICKEL)];
    Plated { layers, base }
}

/// Hard cases: the rates of both sides and of their layers.
fn cases() -> Vec<(&'static str, Scene)> {
    let tip = || gold_on_nickel(0.03e-3, 0.004 / 3_700.0);
    let one_layer = |rate| {
        let layers = vec![layer(0.03e-3, rate)];
        Some(Plated { layers, base: rate })
    };
    let sides = |slider, receptacle| thinly_plated(Sides { slider, receptacle });
    let equal = sides(one_layer(2.0 * GOLD), one_layer(2.0 * GOLD));
    let tip_alone = sides(Some(tip()), None);
    let both = sides(Some(tip()), Some(gold_on_nickel(0.01e-3, COPPER_WEAR)));
    // A thin layer over a base of 260 times the rate of nickel.
    let fast = Plated {
        layers: vec![layer(0.01e-3, GOLD)],
        base: COPPER_WEAR,
    };
    let fast_base = sides(Some(tip()), Some(fast));
    vec![
        ("equal rates", equal),
        ("tip alone", tip_alone),
        ("both sides", both),
        ("thin gold over a fast base", fast_base),
    ]
}

fn lives(done: &Summary) -> Vec<Option<f64>> {
    let criteria = done.life.criteria.iter();
    criteria.map(|criterion| criterion.cycles).collect()
}

/// Solves a scene with implicit jumps and with short ones of computed cycles.
fn both_ways(scene: &Scene, jump: u64) -> [(Summary, Recorder); 2] {
    let short = Scene {
        accuracy: Accuracy {
            cycle_jump: Some(jump),
            ..scene.accuracy
        },
        ..scene.clone()
    };
    [scene, &short].map(|scene| solve(scene).expect("it has a solution"))
}

fn agree_with_short_jumps(name: &str, scene: &Scene, jump: u64) {
    let [(done, record), (short, short_record)] = both_ways(scene, jump);
    let computed = |done: &Summary| done.resolution.computed_cycles;
    println!(
        "{name}: {} for {} computed cycles, lives {:.1?} and {:.1?}",
        computed(&done),
        computed(&short),
        lives(&done),
        lives(&short)
    );
    for (life, other) in lives(&done).into_iter().zip(lives(&short)) {
        let off = life
            .zip(other)
            .map_or(0.0, |(life, other)| life / other - 1.0);
        println!("   {:+.2} %", 100.0 * off);
        assert!(off.abs() < scene.accuracy.tolerance, "{off}");
        assert_eq!(life.is_some(), other.is_some(), "{life:?} {other:?}");
    }
    let snapshot = |record: &Recorder| record.snapshots.last().cloned().expect("the last one");
    let (last, other) = (snapshot(&record), snapshot(&short_record));
    for (profile, other) in [
        (last.slider, other.slider),
        (last.receptacle, other.receptacle),
    ] {
        if other.depth_mm.iter().any(|depth| *depth > 0.0) {
            let off = area_between(&profile, &other);
            println!("   profile {:.2} %", 100.0 * off);
            assert!(off < scene.accuracy.tolerance, "{off}");
        }
    }
}

#[test]
fn a_short_life_is_that_of_short_jumps() {
    let (name, mut scene) = cases().swap_remove(1);
    scene.cycles = 400;
    agree_with_short_jumps(name, &scene, 2);
}

/// Bare copper on copper: one cycle wears as much as several indentations.
fn fast_contact() -> Scene {
    let mut scene = implicit(sprung_contact());
    scene.slider.wear = Some(archard(COPPER_WEAR));
    scene.receptacle.wear = scene.slider.wear;
    scene.cycles = 300;
    scene.life = vec![deepest(Side::Slider, 1e-3), deepest(Side::Receptacle, 2e-3)];
    scene
}

#[test]
fn a_contact_that_one_cycle_reshapes_is_that_of_single_cycles() {
    let scene = fast_contact();
    agree_with_short_jumps("fast contact", &scene, 1);
    let [(done, _), (single, _)] = both_ways(&scene, 1);
    assert!(done.resolution.computed_cycles < single.resolution.computed_cycles);
    let peak = |done: &Summary| done.last.peak_pressure_mpa;
    let off = peak(&done) / peak(&single) - 1.0;
    println!(
        "   peak pressure {:.1} MPa, {:+.2} %",
        peak(&done),
        100.0 * off
    );
    assert!(off.abs() < 0.05, "{off}");
}

#[test]
fn a_resumed_run_gives_the_same_bits() {
    let (name, mut scene) = cases().swap_remove(2);
    scene.cycles = 800;
    resumes_to_the_same_bits(name, &scene, 6);
}

/// A preset of the service: a sprung contact, both sides plated with gold over nickel.
struct Preset {
    name: &'static str,
    slider: SliderShape,
    elastic: Elastic,
    base: f64,
    gold_mm: f64,
    pad_mm: [f64; 2],
    load_n_per_mm: f64,
}

const fn elastic(youngs_modulus_mpa: f64, poisson_ratio: f64) -> Elastic {
    Elastic {
        youngs_modulus_mpa,
        poisson_ratio,
    }
}

const fn arc(radius_mm: f64, half_width_mm: f64) -> SliderShape {
    SliderShape {
        radius_mm,
        half_width_mm,
        height_mm: radius_mm,
    }
}

const PRESETS: [Preset; 3] = [
    Preset {
        name: "sd_card",
        slider: arc(0.4, 0.3),
        elastic: elastic(131e3, 0.3),
        base: 0.004 / 3_700.0,
        gold_mm: 0.76e-3,
        pad_mm: [2.0, 0.3],
        load_n_per_mm: 0.625,
    },
    Preset {
        name: "dimm",
        slider: arc(0.3, 0.3),
        elastic: elastic(110e3, 0.34),
        base: 0.004 / 1_900.0,
        gold_mm: 0.76e-3,
        pad_mm: [2.5, 0.6],
        load_n_per_mm: 1.0,
    },
    Preset {
        name: "zif",
        slider: arc(0.25, 0.1875),
        elastic: elastic(110e3, 0.34),
        base: 0.004 / 1_900.0,
        gold_mm: 0.762e-3,
        pad_mm: [1.5, 0.46],
        load_n_per_mm: 0.5 / 0.46,
    },
];

/// A preset until the base metal of its tip lies open.
fn until_base_metal(preset: &Preset) -> Scene {
    let mut scene = implicit(sprung_contact());
    scene.slider.shape = preset.slider;
    scene.slider.elastic = preset.elastic;
    scene.slider.wear = Some(archard(preset.base));
    let plating = |gold| vec![layer(gold, GOLD), layer(1.27e-3, NICKEL)];
    scene.slider.plating = plating(preset.gold_mm);
    scene.receptacle.shape.length_mm = preset.pad_mm[0];
    scene.receptacle.shape.height_mm = preset.pad_mm[1];
    scene.receptacle.wear = Some(archard(COPPER_WEAR));
    scene.receptacle.plating = plating(0.76e-3);
    scene.load_n_per_mm = preset.load_n_per_mm;
    scene.cycles = 2_000_000;
    scene.life = vec![deepest(Side::Slider, preset.gold_mm)];
    scene.stop = vec![deepest(Side::Slider, preset.gold_mm + 1.27e-3)];
    scene
}

/// Cycles until nickel and base metal of a tip lie open.
fn lives_of_tip(name: &str, scene: &Scene) -> [f64; 2] {
    let done = solve(scene).expect("it has a solution").0;
    let base = u32::try_from(done.last.cycle).map_or(f64::NAN, f64::from);
    let nickel = lives(&done)[0].expect("it is reached");
    println!(
        "{name}: nickel after {nickel:.0}, base metal after {base} cycles, {} computed, {:?}",
        done.resolution.computed_cycles, done.resolution.work
    );
    [nickel, base]
}

/// Forms that take long.
mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes a minute"]
    fn lives_and_profiles_are_those_of_short_jumps() {
        for (name, scene) in cases() {
            agree_with_short_jumps(name, &scene, 5);
        }
    }

    #[test]
    #[ignore = "long: takes half a minute"]
    fn lives_of_presets_are_those_of_finer_jumps_and_positions() {
        for preset in &PRESETS {
            let scene = until_base_metal(preset);
            let lives = lives_of_tip(preset.name, &scene);
            let mut finer = scene;
            finer.accuracy.refinement = Refinement {
                increments: 3.0,
                cycles: 10.0,
                ..Refinement::NONE
            };
            let fine = lives_of_tip("   finer", &finer);
            for (life, fine) in lives.into_iter().zip(fine) {
                let off = life / fine - 1.0;
                println!("   {:+.2} %", 100.0 * off);
                assert!(off.abs() < 0.5 * finer.accuracy.tolerance, "{off}");
            }
        }
    }
}
