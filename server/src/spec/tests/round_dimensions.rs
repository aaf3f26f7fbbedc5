//! Round dimensions: an accepted specification can be meshed, whatever its dimensions, and the unworn contact is loaded.
//!
//! Rounding makes the hard cases: an arc that ends exactly at its rim, at the height of its axis or at the end of the block, and lengths one
//! unit in the last place beside. They are drawn one at a time beside the preset's others, and all together.

use std::ops::ControlFlow;

use proptest::collection::vec;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde_json::{Value, json};
use solver::SolveError;
use solver::error_control::companion_scenes;
use solver::model;
use solver::observer::{Event, Observer};
use solver::scene::Scene;

use super::super::system::definition;
use super::super::{Refused, Resolved, read};
use api::problem::Fault;
use api::spec::SystemKind;

/// Round numbers of a decade.
const ROUND: [f64; 5] = [1.0, 2.0, 2.5, 4.0, 5.0];
/// Random numbers of a draw.
const NUMBERS: usize = 64;
/// Unknowns of a body up to which the unworn contact is loaded, and the companions of its run are meshed.
const MOST_DOFS: usize = 5_000;
/// Unknowns up to which a body is meshed.
const MOST_MESHED_DOFS: usize = 30_000;

/// Ends a run at its first event: the unworn contact is meshed, condensed and loaded.
struct Unworn;

impl Observer for Unworn {
    fn on(&mut self, _: Event<'_>) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

/// Meshes what is accepted, and loads it if it is small.
fn begin(resolved: &Resolved) -> Result<(), SolveError> {
    let scene = &resolved.scene;
    let dofs = resolved.layout.as_ref().map_or(0, |layout| {
        let bodies = &layout.bodies;
        bodies.slider.dofs().max(bodies.receptacle.dofs())
    });
    let mesh = |scene: &Scene| model::build(scene, &solver::effects::plan(scene));
    if resolved.layout.is_some() && dofs <= MOST_MESHED_DOFS {
        mesh(scene)?;
    }
    if dofs <= MOST_DOFS {
        if resolved.layout.is_some() {
            for companion in companion_scenes(scene) {
                mesh(&companion)?;
            }
        }
        solver::run::solve(scene, &mut Unworn)?;
    }
    Ok(())
}

/// Counts of specifications by their result.
#[derive(Default)]
struct Tally {
    accepted: usize,
    failed: Vec<String>,
}

impl Tally {
    fn add(&mut self, spec: &Value) {
        match read(spec.to_string().as_bytes()) {
            Ok(resolved) => {
                self.accepted += 1;
                if let Err(error) = begin(&resolved) {
                    self.failed.push(format!("{error}: {spec}"));
                }
            }
            Err(Refused::Faults(faults)) => {
                let whole = ["", "/system", "/model"];
                let has_field = |fault: &Fault| !whole.contains(&&fault.pointer[..]);
                assert!(faults.iter().all(has_field), "{faults:?}: {spec}");
            }
            Err(Refused::Parse(error)) => panic!("{error}: {spec}"),
        }
    }

    /// # Panics
    /// Where one that was accepted cannot be meshed, or too few were accepted to show anything.
    fn check(&self, least: usize) {
        let failed = self.failed.join("\n");
        assert!(
            failed.is_empty(),
            "{} of {}:\n{failed}",
            self.failed.len(),
            self.accepted
        );
        assert!(self.accepted >= least, "only {} accepted", self.accepted);
    }
}

/// The default dimensions of a kind; an optional one is as large as the largest of the others.
fn dimensions(kind: SystemKind) -> Vec<(&'static str, f64)> {
    let resolved = super::accepted(&json!({"system": {"kind": kind}}).to_string());
    let system = serde_json::to_value(&resolved.spec.system).expect("JSON");
    let largest = definition(kind)
        .dimension_names()
        .filter_map(|name| system[name].as_f64())
        .fold(0.0, f64::max);
    let names = definition(kind).dimension_names();
    names
        .map(|name| (name, system[name].as_f64().unwrap_or(largest)))
        .collect()
}

/// The nearest round number, and those of one unit in the last place beside it.
fn beside(near: f64) -> [f64; 3] {
    let decade = 10_f64.powf(near.log10().floor());
    let distance = |round: f64| (round / near).ln().abs();
    let candidates = ROUND.iter().flat_map(|m| [m * decade, 10.0 * m * decade]);
    let round = candidates.fold(decade, |best, next| {
        if distance(next) < distance(best) {
            next
        } else {
            best
        }
    });
    // As it is written.
    let round: f64 = format!("{round:.3e}").parse().expect("a number");
    [round.next_down(), round, round.next_up()]
}

/// A specification of a kind under a load in proportion, without companions.
fn base(kind: SystemKind, tolerance: f64) -> Value {
    json!({
        "system": {"kind": kind},
        "load": {"kind": "pressure", "mpa": 10},
        "cycles": 1,
        "accuracy": {"tolerance": tolerance},
    })
}

/// Models of a fuzz button, each with a field and a value of it.
fn models() -> [(Value, &'static str, f64); 9] {
    let model = |dimension| json!({"dimension": dimension});
    let wide = |dimension| json!({"dimension": dimension, "width_mm": 0.4});
    let bent = json!({"dimension": "ring", "top": "pressure"});
    [
        (model("point"), "radius_z_mm", 0.0254),
        (model("ring"), "outer_diameter_mm", 1.016),
        (bent, "outer_diameter_mm", 1.016),
        (model("line"), "width_mm", 0.4),
        (wide("line"), "crown_radius_mm", 10.0),
        (wide("line"), "tilt_mrad", 0.5),
        (wide("auto"), "crown_radius_mm", 10.0),
        (model("extruded"), "width_mm", 0.010_58),
        (
            json!({"dimension": "extruded", "layers": 40}),
            "layer_growth",
            2.0,
        ),
    ]
}

/// Round values of each field of the model, so many half decades from a typical one.
fn round_fields_of_the_model(steps: &[i32]) -> Tally {
    let mut tally = Tally::default();
    for (model, field, typical) in models() {
        for &step in steps {
            for value in beside(typical * 10_f64.powf(f64::from(step) / 2.0)) {
                let mut spec = base(SystemKind::FuzzButton, 0.1);
                spec["model"] = model.clone();
                spec["model"][field] = json!(value);
                if model["dimension"] == "point" {
                    spec["load"] = json!({"kind": "force", "n": 3e-3});
                } else {
                    // Few elements: layers multiply them.
                    spec["accuracy"]["overrides"] = json!({"contact_element_mm": 0.002});
                }
                tally.add(&spec);
            }
        }
    }
    tally
}

#[test]
fn round_values_of_one_field_of_the_model_are_refused_or_meshed() {
    round_fields_of_the_model(&[-1, 0, 2]).check(45);
}

mod long {
    #[test]
    #[ignore = "long: takes 30 s"]
    fn every_round_value_of_one_field_of_the_model_is_refused_or_meshed() {
        super::round_fields_of_the_model(&[-3, -2, -1, 0, 1, 2, 3]).check(100);
    }
}

#[test]
fn every_round_value_of_one_dimension_is_refused_or_meshed() {
    let mut tally = Tally::default();
    for kind in SystemKind::ALL {
        for (name, default) in dimensions(kind) {
            for step in -4..=4 {
                let near = default * 10_f64.powf(f64::from(step) / 5.0);
                for value in beside(near) {
                    let mut spec = base(kind, 0.1);
                    spec["system"][name] = json!(value);
                    tally.add(&spec);
                }
            }
        }
    }
    tally.check(400);
}

/// Random numbers of a draw that are not used yet.
struct Numbers(std::vec::IntoIter<f64>);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0.next().expect("there are enough")
    }

    fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        let among = self.next() * crate::number::real(values.len());
        let mut values = values.iter().enumerate();
        *values
            .find(|(i, _)| among < crate::number::real(i + 1))
            .expect("below the number of values")
            .1
    }

    /// A round number, or one beside it, within a factor of `spread` of one.
    fn round(&mut self, near: f64, spread: f64) -> f64 {
        let near = near * spread.powf(2.0 * self.next() - 1.0);
        let [below, round, above] = beside(near);
        self.one_of(&[below, round, round, above])
    }
}

/// A specification whose dimensions are all round, in proportion to the preset's.
fn drawn(mut u: Numbers) -> Value {
    let kind = u.one_of(&SystemKind::ALL);
    let scale = 10_f64.powf(u.one_of(&[-3.0, -2.0, -1.0, 0.0, 0.0, 0.0, 1.0, 2.0]));
    let mut spec = base(kind, u.one_of(&[0.01, 0.02, 0.05, 0.1, 0.1, 0.1]));
    let preset = dimensions(kind);
    for (name, default) in &preset {
        let value = u.round(default * scale, 2.5);
        if u.next() < 0.9 {
            spec["system"][name] = json!(value);
        }
    }
    let radius = 0.5 * scale * preset[0].1;
    spec["motion"] = json!({"kind": "reciprocating", "amplitude_mm": u.round(0.3 * radius, 3.0)});
    let dimension = u.one_of(&["plane_strain", "point", "line", "ring", "extruded", "auto"]);
    let mut model = json!({"dimension": dimension});
    let (width, crown) = (u.round(10.0 * radius, 10.0), u.round(100.0 * radius, 10.0));
    let (tilt, growth) = (u.round(0.3, 10.0), u.round(2.2, 2.2));
    match dimension {
        "point" => {
            model["radius_z_mm"] = json!(u.round(2.0 * radius, 3.0));
            spec["load"] = json!({"kind": "force", "n": 5.0 * radius * radius});
        }
        "line" | "auto" => {
            model["width_mm"] = json!(width);
            model["top"] = json!(u.one_of(&["rigid", "even"]));
            if u.next() < 0.3 {
                model["crown_radius_mm"] = json!(crown);
            }
            if u.next() < 0.2 {
                model["tilt_mrad"] = json!(tilt);
            }
        }
        "ring" => {
            model["outer_diameter_mm"] = json!(u.round(20.0 * radius, 5.0));
            model["top"] = json!(u.one_of(&["rigid", "even", "pressure"]));
            model["motion"] = json!(u.one_of(&["in_plane", "torsion"]));
        }
        "extruded" => {
            model["width_mm"] = json!(width);
            model["layers"] = json!(u.one_of(&[2, 2, 4, 10, 20]));
            model["layer_growth"] = json!(growth);
        }
        _ => {}
    }
    spec["model"] = model;
    spec
}

#[test]
fn round_dimensions_all_together_are_refused_or_meshed() {
    let setting = std::env::var("FRETWEAR_DRAWS").ok();
    let draws = setting.and_then(|text| text.parse().ok()).unwrap_or(120);
    let seed = TestRng::from_seed(RngAlgorithm::ChaCha, &[1; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), seed);
    let numbers = vec(0.0..1.0_f64, NUMBERS);
    let mut tally = Tally::default();
    for _ in 0..draws {
        let tree = numbers.new_tree(&mut runner).expect("numbers can be drawn");
        tally.add(&drawn(Numbers(tree.current().into_iter())));
    }
    tally.check(draws / 10);
}
