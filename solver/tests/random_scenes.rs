//! Random scenes over all regimes, valid by construction: within the limits that `server/src/spec` sets to a specification.
//!
//! Everything is drawn in proportion to the Hertz half-width a of the unworn contact, because independent draws would nearly
//! all be contacts that nobody builds: bodies from three contacts wide, the amplitude from a fifth of the displacement of
//! gross slip to twelve contacts, the wear by the scar that it makes. A block is longer than its groove: the stroke far
//! beyond a block is not among them, its corners wear differently with every resolution. The scene of a seed and a number
//! depends on nothing else, so that one scene of many can be drawn alone.

#[path = "random_scenes/contact.rs"]
mod contact;

use std::f64::consts::PI;

use fastrand::Rng;
use solver::model::Layout;
use solver::scene::Switches;
use solver::scene::{
    Accuracy, Body, Conduction, Dimension, Drive, Friction, Layer, Motion, Output, Scene,
    Softening, Timing, WearLaw,
};
use solver::sides::Sides;

use contact::{Numbers, gross_slip, shapes};

/// Any odd number much larger than the number of scenes.
const SEED_STRIDE: u64 = 1_000_003;
/// Processor seconds of an increment, and of one node in contact, squared: an increment with 150 nodes takes 2.7 ms.
const INCREMENT_S: f64 = 1e-4;
const NODE_PAIR_S: f64 = 1.2e-7;

/// How far the slider moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Regime {
    /// A fifth to nine tenths of the displacement of gross slip: the middle of the contact sticks.
    PartialSlip,
    /// All of the contact slips, and it stays within one and a half of its half-widths.
    ShortStroke,
    /// The contact leaves its own width: three to twelve half-widths.
    LongGroove,
}

/// Which side wears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Worn {
    Both,
    Receptacle,
    Slider,
}

/// A scene with what it was drawn as.
#[derive(Debug, Clone)]
pub(crate) struct Drawn {
    pub(crate) seed: u64,
    pub(crate) number: u64,
    pub(crate) regime: Regime,
    pub(crate) worn: Worn,
    pub(crate) scene: Scene,
}

impl Drawn {
    /// The parameters that the scene was drawn with, in one line.
    pub(crate) fn name(&self) -> String {
        let scene = &self.scene;
        let drive = match scene.drive {
            Drive::Handle => "handle",
            Drive::WholeBody => "whole body",
        };
        let crown = scene.receptacle.shape.crown_radius_mm.map(|_| ", crown");
        let spring = (scene.spring_n_per_mm2 > 0.0).then_some(", spring");
        format!(
            "{}/{} {:?}, {:?}, {drive}{}{}",
            self.seed,
            self.number,
            self.regime,
            self.worn,
            crown.unwrap_or_default(),
            spring.unwrap_or_default()
        )
    }
}

/// The scene of a seed and a number at a tolerance, of so many cycles that it takes about so many processor seconds at most:
/// a third of the scenes has each regime; one half wears on both sides, a quarter on the receptacle, a quarter on the slider.
pub(crate) fn draw(seed: u64, number: u64, tolerance: f64, most_s: f64) -> Drawn {
    let mut u = Numbers(Rng::with_seed(seed * SEED_STRIDE + number));
    let worn = [Worn::Both, Worn::Receptacle, Worn::Both, Worn::Slider][index(number, 4)];
    let regimes = [Regime::PartialSlip, Regime::ShortStroke, Regime::LongGroove];
    let regime = regimes[index(number / 4, 3)];
    let mut scene = scene(&mut u, regime, worn);
    scene.accuracy = Accuracy::from_tolerance(tolerance);
    while estimated_s(&scene) > most_s && scene.cycles > FEWEST_CYCLES {
        scene = over_fewer_cycles(scene);
    }
    Drawn {
        seed,
        number,
        regime,
        worn,
        scene,
    }
}

fn index(number: u64, count: u64) -> usize {
    usize::try_from(number % count).unwrap_or_default()
}

/// The fewest cycles to which the cost of a scene reduces it: with fewer no jump would be made.
const FEWEST_CYCLES: u64 = 12;

/// Three quarters of the cycles with the more wear in each.
fn over_fewer_cycles(mut scene: Scene) -> Scene {
    let fewer = (scene.cycles * 3 / 4).max(FEWEST_CYCLES);
    let factor = real(scene.cycles) / real(fewer);
    scene.cycles = fewer;
    scale_wear(&mut scene, factor);
    scene
}

/// Multiplies all wear rates of a scene.
pub(crate) fn scale_wear(scene: &mut Scene, factor: f64) {
    scale_rates(&mut scene.slider.wear, &mut scene.slider.plating, factor);
    scale_rates(
        &mut scene.receptacle.wear,
        &mut scene.receptacle.plating,
        factor,
    );
}

fn scale_rates(wear: &mut Option<WearLaw>, plating: &mut [Layer], factor: f64) {
    *wear = wear.map(|law| {
        let rate = law.uniform().expect("drawn scenes wear by Archard's law");
        WearLaw::Archard {
            k_over_h_per_mpa: factor * rate,
        }
    });
    for layer in plating {
        layer.rate_per_mpa *= factor;
    }
}

/// Estimated processor seconds of a scene's increments.
pub(crate) fn estimated_s(scene: &Scene) -> f64 {
    let layout = Layout::of(scene).expect("a drawn scene can be meshed");
    let forecast = solver::forecast::forecast(scene, &layout);
    let cost = |nodes: usize| {
        let nodes = f64::from(u32::try_from(nodes).unwrap_or(u32::MAX));
        INCREMENT_S + NODE_PAIR_S * nodes * nodes
    };
    let segments = forecast.segments.iter();
    segments
        .map(|part| part.increments * cost(part.nodes))
        .sum()
}

/// Wear laws with a sum of rates; where both sides wear, the slider's is a twentieth to twenty times the receptacle's.
fn laws(u: &mut Numbers, worn: Worn, rate: f64) -> Sides<Option<WearLaw>> {
    let share = match worn {
        Worn::Both => {
            let ratio = u.log(0.05, 20.0);
            ratio / (1.0 + ratio)
        }
        Worn::Receptacle => 0.0,
        Worn::Slider => 1.0,
    };
    let law = |share: f64| {
        (share > 0.0).then_some(WearLaw::Archard {
            k_over_h_per_mpa: share * rate,
        })
    };
    Sides {
        slider: law(share),
        receptacle: law(1.0 - share),
    }
}

/// Depth of wear in proportion to the indentation, and from it the rate: depth over the path of a point in all cycles times
/// the pressure on it.
fn scene(u: &mut Numbers, regime: Regime, worn: Worn) -> Scene {
    let contact = contact::draw(u);
    let (half_width, load) = (contact.half_width, contact.load);
    let scar = half_width * u.log(0.4, 2.5);
    let travel = match regime {
        Regime::PartialSlip | Regime::ShortStroke => 1.5 * half_width,
        Regime::LongGroove => half_width * u.log(3.0, 12.0),
    };
    let (slider, block) = shapes(u, &contact, travel, half_width.max(scar));
    let drive = if u.chance(0.25) {
        Drive::WholeBody
    } else {
        Drive::Handle
    };
    let coefficient = u.within(0.1, 1.2);
    let slip = gross_slip(&contact, slider, block, drive, coefficient);
    let share = match regime {
        Regime::PartialSlip => u.within(0.2, 0.9),
        Regime::ShortStroke | Regime::LongGroove => 1.0,
    };
    let amplitude_mm = match regime {
        Regime::PartialSlip => share * slip,
        Regime::ShortStroke => u.log((1.5 * slip).max(0.1 * half_width).min(travel), travel),
        Regime::LongGroove => travel,
    };
    let cycles = 10 * u.0.u64(3..=20);
    let indentation = 0.5 * half_width * half_width / contact.relative;
    let depth = match regime {
        Regime::PartialSlip => indentation * u.log(0.02, 0.5),
        Regime::ShortStroke | Regime::LongGroove => 0.5 * scar * scar / contact.relative,
    };
    let path = match regime {
        // The edge slips by the shear that it is short of, under a third of the peak pressure.
        Regime::PartialSlip => {
            4.0 * coefficient * indentation * share * 2.0 / 3.0 * load / (PI * half_width)
        }
        // Every point of the scar slips by the whole stroke; of the groove, while the contact passes.
        Regime::ShortStroke => 4.0 * amplitude_mm * load * 0.75 / scar,
        Regime::LongGroove => 2.0 * load,
    };
    let wear = laws(u, worn, depth / (path * real(cycles)));
    let spring = u.chance(0.2).then(|| load / depth * u.log(0.05, 0.5));
    let frictionless = u.chance(0.05) && regime != Regime::PartialSlip;
    Scene {
        slider: Body {
            shape: slider,
            elastic: contact.slider,
            wear: wear.slider,
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        receptacle: Body {
            shape: block,
            elastic: contact.receptacle,
            wear: wear.receptacle,
            plating: Vec::new(),
            thermal: None,
            softening: Softening::default(),
        },
        friction: if frictionless {
            Friction::Frictionless
        } else {
            Friction::Coulomb { coefficient }
        },
        temperature_c: 20.0,
        load_n_per_mm: load,
        spring_n_per_mm2: spring.unwrap_or(0.0),
        drive,
        motion: Motion::Reciprocating {
            amplitude_mm,
            period_s: 1.0,
        },
        timing: Timing::Sine,
        cycles,
        mission: None,
        cycles_at_a_time: None,
        accuracy: Accuracy::from_tolerance(0.02),
        output: Output {
            stations_mm: Vec::new(),
            snapshots_at_cycles: Vec::new(),
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

fn real(count: u64) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}
