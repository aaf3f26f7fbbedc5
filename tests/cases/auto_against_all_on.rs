//! Requirement: the plan leaves out what does not matter and nothing else.
//!
//! Over scenes of all regimes the outputs with `auto` are those with every effect on, within the tolerance, for no more
//! work; and an effect that the plan calls decisive changes the outputs by more than the tolerance when it is switched
//! off. The long form prints the table of `docs/evidence/effects-plan.md`.

mod difference;
mod scenes;

use comfy_table::{Table, presets};
use serde_json::Value;
use server::words::effects::name as effect_name;
use solver::effects::{self, EffectsPlan, Verdict};
use solver::record::Summary;
use solver::scene::Scene;
use solver::scene::{Effect, Switches};

use crate::hard::run::{self, Run};
use difference::largest;

/// Tolerance of all scenes.
const TOLERANCE: f64 = 0.02;

/// A scene solved by its plan, with every effect on, and with each decisive effect off.
struct Compared {
    name: String,
    skipped: Vec<&'static str>,
    /// Largest difference of an output from the run with every effect on, and its name.
    difference: (f64, &'static str),
    /// Entries of responses and unknowns, over those with every effect on.
    work: [f64; 2],
    /// Decisive effects with the largest change of an output when they are off.
    decisive: Vec<(Effect, f64)>,
}

#[test]
fn plans_leave_out_only_what_does_not_matter() {
    hold(&scenes::one_of_each_regime());
}

mod long {
    #[test]
    #[ignore = "long: takes 160 s"]
    fn plans_leave_out_only_what_does_not_matter() {
        let scenes = super::scenes::all();
        assert!(scenes.len() >= 40, "{}", scenes.len());
        super::hold(&scenes);
    }
}

/// Solves scenes with and without effects, prints the table and checks what plans must hold.
fn hold(scenes: &[(String, Value)]) {
    let compared: Vec<Compared> = scenes
        .iter()
        .map(|(name, spec)| compare(name, &run::scene(spec)))
        .collect();
    println!("{}", table(&compared));
    for scene in &compared {
        let (difference, output) = scene.difference;
        let name = &scene.name;
        assert!(difference <= TOLERANCE, "{name}: {output} {difference}");
        let [entries, unknowns] = scene.work;
        let skips = |effect: Effect| scene.skipped.contains(&effect_name(effect));
        // Heat and layers have no unknowns of their own, but change rates by a part of the tolerance: the control of jumps may take a
        // cycle more or less on another solution, most where it rejects them at the interfaces of a plating.
        let [most_entries, most_unknowns] = if skips(Effect::Friction) || skips(Effect::StickMemory)
        {
            [1.0, 1.05]
        } else {
            [1.15, 1.15]
        };
        assert!(entries <= most_entries, "{name}: {entries}");
        assert!(unknowns <= most_unknowns, "{name}: {unknowns}");
    }
    for &effect in Effect::ALL {
        let changes: Vec<f64> = changes(&compared, effect).collect();
        let called = changes.len();
        let decisive = changes.iter().filter(|change| **change > TOLERANCE).count();
        println!(
            "{}: decisive in {decisive} of {called} scenes that call it so",
            effect_name(effect)
        );
        // Half of them at least: the indicators are upper estimates.
        assert!(
            2 * decisive >= called,
            "{}: {changes:?}",
            effect_name(effect)
        );
    }
}

/// The change of the outputs without an effect, in the scenes in which it is called decisive.
fn changes(compared: &[Compared], effect: Effect) -> impl Iterator<Item = f64> {
    let decisive = compared.iter().flat_map(|scene| &scene.decisive);
    decisive
        .filter(move |(other, _)| *other == effect)
        .map(|(_, change)| *change)
}

fn compare(name: &str, scene: &Scene) -> Compared {
    let plan = effects::plan(scene);
    let auto = solved(scene.clone());
    let all_on = solved(Scene {
        effects: all_on(&plan, scene),
        ..scene.clone()
    });
    let decisive = decisive(&plan).map(|effect| {
        let off = solved(Scene {
            effects: Switches::default().with(effect, false),
            ..scene.clone()
        });
        (effect, largest(&off, &auto).0)
    });
    let decisive = decisive.collect();
    let share = |of: fn(&Summary) -> u64| share(of(auto.summary()), of(all_on.summary()));
    Compared {
        name: name.to_owned(),
        skipped: skipped(&plan).map(effect_name).collect(),
        difference: largest(&auto, &all_on),
        work: [
            share(|summary| summary.resolution.work.response_entries),
            share(|summary| summary.resolution.work.unknowns),
        ],
        decisive,
    }
}

/// A count over another one, to a millionth.
fn share(part: u64, whole: u64) -> f64 {
    let millionths = (u128::from(part) * 1_000_000).div_ceil(u128::from(whole));
    f64::from(u32::try_from(millionths).expect("a plan counts little more than everything")) * 1e-6
}

fn solved(scene: Scene) -> Run {
    run::solve_part(scene, usize::MAX)
}

/// Effects that the plan skips although there is something to simulate, and that it could.
fn skipped(plan: &EffectsPlan) -> impl Iterator<Item = Effect> {
    let skipped = plan
        .decisions
        .iter()
        .filter(|decision| decision.verdict == Verdict::Skipped && decision.indicator().is_some())
        .filter(|decision| decision.effect.is_available());
    skipped.map(|decision| decision.effect)
}

/// Every effect that has something to simulate.
fn all_on(plan: &EffectsPlan, scene: &Scene) -> Switches {
    let has_friction = scene.largest_friction() > 0.0;
    let on = Effect::ALL.iter().filter(|effect| {
        let sticks = **effect == Effect::StickMemory && has_friction;
        let mut decisions = plan.decisions.iter();
        let decision = decisions.find(|decision| decision.effect == **effect);
        effect.is_available() && (sticks || decision.is_some_and(|d| d.indicator().is_some()))
    });
    on.fold(Switches::default(), |switches, effect| {
        switches.with(*effect, true)
    })
}

/// Effects whose indicator exceeds the tolerance.
fn decisive(plan: &EffectsPlan) -> impl Iterator<Item = Effect> {
    let decisive = plan.decisions.iter().filter(|decision| {
        decision.verdict == Verdict::Simulated
            && decision.effect != Effect::Elasticity
            && !decision.effect.is_derived()
            && decision
                .indicator()
                .is_some_and(|indicator| indicator.value() > TOLERANCE)
    });
    decisive.map(|decision| decision.effect)
}

fn table(compared: &[Compared]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN);
    table.set_header([
        "scene",
        "skipped",
        "difference from all on",
        "response entries",
        "unknowns",
        "change without each decisive effect",
    ]);
    for scene in compared {
        let (difference, output) = scene.difference;
        let decisive = scene.decisive.iter();
        let decisive = decisive
            .map(|(effect, change)| format!("{} {:.1} %", effect_name(*effect), 100.0 * change));
        table.add_row([
            scene.name.clone(),
            scene.skipped.join(", "),
            format!("{:.2} % ({output})", 100.0 * difference),
            format!("{:.2}", scene.work[0]),
            format!("{:.2}", scene.work[1]),
            decisive.collect::<Vec<_>>().join(", "),
        ]);
    }
    table
}
