//! `fretwear plan SPEC`: tables for a reader, or the document.

use std::path::Path;

use api::plan::{Plan, PlanDocument, PlannedEffect, RatedLife};
use api::results::BlockExtent;
use comfy_table::Table;

use crate::cli::figures::{number, percent, until};
use crate::cli::specification;
use crate::cli::terminal::{Ended, write_json, write_out};
use crate::estimate::Estimate;
use crate::estimate::machine::{CalibrationCache, cache_file};
use crate::export::markdown;

pub(super) fn run(spec: &Path, json: bool) -> Ended {
    let resolved = specification::resolved(spec)?;
    let cache = CalibrationCache::open(cache_file());
    let machine = cache.get_or_measure().cloned();
    let plan = Estimate::of(&resolved).plan(&resolved, machine.as_ref());
    if json {
        return write_json(&PlanDocument {
            spec: resolved.spec,
            plan,
            machine,
        });
    }
    write_out(effects(&plan))?;
    write_out(reasons(&plan))?;
    write_out(estimates(&plan))?;
    if let Some(motion) = &plan.motion {
        write_out(format!("motion: {}", motion.reason))?;
    }
    if !plan.mission.is_empty() {
        write_out(blocks(&plan.mission))?;
    }
    if !plan.life.is_empty() {
        write_out(lives(&plan))?;
    }
    write_out(plan.notes.join("\n"))
}

/// Decisions with their numbers.
fn effects(plan: &Plan) -> Table {
    let header = ["effect", "decision", "value, %", "limit, %"];
    let mut table = markdown::table(header, 2);
    for effect in &plan.effects {
        table.add_row([
            effect.effect.clone(),
            effect.decision.as_str().to_owned(),
            value(effect),
            effect.threshold.map_or_else(String::new, percent),
        ]);
    }
    table
}

/// The value of an effect; nothing where there is nothing to simulate.
fn value(effect: &PlannedEffect) -> String {
    match (effect.value, effect.threshold) {
        (Some(value), _) => percent(value),
        (None, Some(_)) => "without bound".to_owned(),
        (None, None) => String::new(),
    }
}

/// Lines with the indicator of each effect and the reason for its decision.
fn reasons(plan: &Plan) -> String {
    let lines = plan.effects.iter().map(|effect| {
        let PlannedEffect {
            effect,
            indicator,
            reason,
            ..
        } = effect;
        format!("\n{effect}: {reason}\n    value: {indicator}")
    });
    lines.collect()
}

/// Blocks of a mission over all repetitions.
fn blocks(blocks: &[BlockExtent]) -> Table {
    let header = [
        "block",
        "motion",
        "cycles",
        "amplitude, mm",
        "path, mm",
        "time, h",
    ];
    let mut table = markdown::table(header, 2);
    for (index, block) in blocks.iter().enumerate() {
        let motion = block.motion.as_ref();
        table.add_row([
            block
                .name
                .clone()
                .unwrap_or_else(|| (index + 1).to_string()),
            motion.map_or_else(String::new, |motion| motion.reason.clone()),
            block.cycles.to_string(),
            number(block.amplitude_mm),
            number(block.sliding_distance_mm),
            number(block.duration_h),
        ]);
    }
    table
}

/// Lives in cycles of the motion, and in matings beside the rated ones.
fn lives(plan: &Plan) -> Table {
    let header = [
        "expected life until",
        "side",
        "cycles",
        "repetitions",
        "matings",
        "rated",
        "matings/rated",
    ];
    let mut table = markdown::table(header, 5);
    for life in &plan.life {
        let of_rated = |value: fn(&RatedLife) -> f64| {
            let rated = life.rated.as_ref();
            rated.map_or_else(String::new, |rated| number(value(rated)))
        };
        table.add_row([
            until(&life.criterion),
            life.side.clone(),
            life.cycles
                .map_or_else(String::new, |cycles| format!("{cycles:.0}")),
            life.repetitions.map_or_else(String::new, number),
            of_rated(|rated| rated.matings.round()),
            of_rated(|rated| rated.rated_matings),
            of_rated(|rated| rated.matings_over_rated),
        ]);
    }
    table
}

fn estimates(plan: &Plan) -> Table {
    let mut table = markdown::table(["estimate", "value"], 1);
    for (name, value) in &plan.estimates {
        table.add_row([name.clone(), number(*value)]);
    }
    table
}
