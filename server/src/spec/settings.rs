//! Cycles, effects and accuracy.

use std::collections::BTreeMap;

use api::spec::{Accuracy, Choice, CycleJump, Overrides, Preset as Tolerance, Provenance, Switch};
use solver::effects::{Effect, SMALL_STRAIN_LIMIT};
use solver::scene;

use crate::estimate::footprint::Footprint;
use crate::estimate::workload::Workload;
use crate::reference::presets::Preset;
use crate::spec::diagnostics::{Diagnostics, Range, shortened};
use crate::spec::geometry::Shapes;
use crate::spec::motion::CONTINUOUS_PARTS;

/// Most cycles of a job.
const CYCLE_LIMIT: u64 = 1_000_000_000;
/// Most surface elements that the block would be divided into at an overridden element size.
const CONTACT_ELEMENT_LIMIT: f64 = 20_000.0;
/// Relative.
const TOLERANCE: Range = Range {
    from: 1e-6,
    to: 0.5,
};
const INCREMENT_RANGE: (u32, u32) = (4, 1_000_000);

/// Effects that the engine's plan decides about, and effects that are still to come.
const PLANNED: [Effect; 5] = [
    Effect::Elasticity,
    Effect::Friction,
    Effect::ReceptacleWear,
    Effect::SliderWear,
    Effect::Relocation,
];
const TO_COME: [&str; 6] = [
    "frictional_heating",
    "geometric_nonlinearity",
    "oxidation",
    "plasticity",
    "plating",
    "resistance",
];

/// Fills in the number of cycles; a continuous motion has none of its own.
pub(crate) fn cycles(
    given: Option<u64>,
    continuous: bool,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> u64 {
    if continuous {
        diagnostics.misplaced("", &[("cycles", given.is_some())], "continuous");
        return CONTINUOUS_PARTS;
    }
    let cycles = diagnostics.take("/cycles", given, preset.cycles.value, preset.cycles.from);
    if !(1..=CYCLE_LIMIT).contains(&cycles) {
        diagnostics.fault("/cycles", format!("{cycles} is outside 1 to {CYCLE_LIMIT}"));
    }
    cycles
}

/// Checks the effects; what is left out is `auto`.
pub(crate) fn effects(
    given: &BTreeMap<String, Choice<Switch>>,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, Choice<Switch>> {
    for (name, switch) in given {
        let pointer = format!("/effects/{}", api::spec::pointer_token(name));
        let planned = PLANNED.iter().any(|effect| effect.name() == name);
        if !planned && !TO_COME.contains(&name.as_str()) {
            let names: Vec<_> = PLANNED
                .iter()
                .map(|effect| effect.name())
                .chain(TO_COME)
                .collect();
            diagnostics.fault(
                &pointer,
                format!(
                    "`{}` is no effect; effects are {}",
                    shortened(name),
                    names.join(", ")
                ),
            );
            continue;
        }
        match diagnostics.known(&pointer, switch) {
            Some(Switch::On) if !planned => {
                diagnostics.fault(&pointer, format!("`{name}` is not available yet"));
            }
            Some(Switch::Off) if planned => {
                diagnostics.fault(
                    &pointer,
                    "switching it off is not available yet; leave it out of the scene instead",
                );
            }
            _ => {}
        }
    }
    given.clone()
}

/// Notes a fault for each effect that was asked for and that the scene gives nothing to simulate.
pub(crate) fn planned(
    given: &BTreeMap<String, Choice<Switch>>,
    scene: &scene::Scene,
    diagnostics: &mut Diagnostics,
) {
    for decision in solver::effects::plan(scene).decisions {
        let name = decision.effect.name();
        let wanted = given.get(name).and_then(Choice::known) == Some(Switch::On);
        if wanted && !decision.simulated && decision.effect != Effect::GeometricNonlinearity {
            let detail = format!("cannot be on: {}", decision.reason);
            diagnostics.fault(&format!("/effects/{name}"), detail);
        }
    }
}

/// Notes a fault if the contact is strained beyond what small strains are good for; `off` accepts it.
pub(crate) fn small_strains(
    given: &BTreeMap<String, Choice<Switch>>,
    scene: &scene::Scene,
    diagnostics: &mut Diagnostics,
) {
    let name = Effect::GeometricNonlinearity.name();
    let accepted = given.get(name).and_then(Choice::known) == Some(Switch::Off);
    let cost = solver::effects::small_strain_cost(scene);
    if cost > SMALL_STRAIN_LIMIT && !accepted {
        let detail = format!(
            "strains the contact so much that small-strain elasticity would miss the peak pressure by {:.1} % (limit \
             {:.0} %) and finite strains are not available; lower the load, or accept it with `effects.{name}`: `off`",
            100.0 * cost,
            100.0 * SMALL_STRAIN_LIMIT
        );
        diagnostics.fault("/load", detail);
    }
}

/// How large the solve would be, and how much there is to do; a fault if the bodies cannot be meshed, or the mesh would be larger than the engine
/// takes.
pub(crate) fn meshable(
    scene: &scene::Scene,
    diagnostics: &mut Diagnostics,
) -> Option<(Footprint, Workload)> {
    let built = solver::model::Layout::of(scene);
    if let Err(error) = &built {
        let pointer = match scene.accuracy.contact_element_mm {
            Some(_) => "/accuracy/overrides/contact_element_mm",
            None => "/system",
        };
        diagnostics.fault(pointer, error.to_string());
    }
    built.ok().map(|layout| {
        let work = Workload::of(scene, &layout);
        (Footprint::of(scene, &layout, &work), work)
    })
}

/// Fills in the accuracy.
pub(crate) fn accuracy(
    given: &Accuracy,
    shapes: &Shapes,
    cycles: u64,
    diagnostics: &mut Diagnostics,
) -> (Accuracy, scene::Accuracy) {
    let preset = given
        .preset
        .as_ref()
        .and_then(|preset| diagnostics.known("/accuracy/preset", preset));
    let mut filled = given.clone();
    let tolerance = match (preset, given.tolerance) {
        (_, Some(tolerance)) => {
            if given.preset.is_some() {
                diagnostics.fault(
                    "/accuracy/tolerance",
                    "stands beside `preset`; write one of them",
                );
            }
            diagnostics.note("/accuracy/tolerance", Provenance::Given);
            diagnostics.check("/accuracy/tolerance", tolerance, TOLERANCE)
        }
        (preset, None) => {
            let preset = diagnostics.take(
                "/accuracy/preset",
                preset,
                Tolerance::Standard,
                Provenance::Assumed,
            );
            filled.preset = Some(preset.into());
            preset_tolerance(preset)
        }
    };
    let empty = Overrides::default();
    let overrides = given.overrides.as_ref().unwrap_or(&empty);
    let elements = source_elements(preset);
    let source_element = elements.map(|count| shapes.block.length_mm / count);
    let source_increments = elements.map(|_| SOURCE_INCREMENTS);
    let numerical = scene::Accuracy {
        tolerance,
        contact_element_mm: contact_element(overrides, shapes, diagnostics).or(source_element),
        increments_per_cycle: increments(overrides, diagnostics).or(source_increments),
        cycle_jump: cycle_jump(overrides, cycles, diagnostics),
    };
    (filled, numerical)
}

fn preset_tolerance(preset: Tolerance) -> f64 {
    match preset {
        Tolerance::Draft | Tolerance::SourceCoarse | Tolerance::SourceFine => 0.1,
        Tolerance::Standard => 0.02,
        Tolerance::Fine => 0.003,
    }
}

/// Elements along the block's length in the source's plane models: 16 of 5.29 um on 84.67 um in the finer one (two
/// widths are stated as 10.58 um), and by assumption half as many in the coarse one, of which it tells no number.
fn source_elements(preset: Option<Tolerance>) -> Option<f64> {
    match preset? {
        Tolerance::SourceCoarse => Some(8.0),
        Tolerance::SourceFine => Some(16.0),
        Tolerance::Draft | Tolerance::Standard | Tolerance::Fine => None,
    }
}

/// Increments a cycle of the source.
const SOURCE_INCREMENTS: u32 = 32;

fn contact_element(
    overrides: &Overrides,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    const POINTER: &str = "/accuracy/overrides/contact_element_mm";
    let size = overrides.contact_element_mm?;
    diagnostics.note(POINTER, Provenance::Given);
    let length = shapes.block.length_mm;
    let smallest = length / CONTACT_ELEMENT_LIMIT;
    if !(size.is_finite() && size >= smallest && size <= 0.5 * length) {
        let limits = format!(
            "{smallest} (1/{CONTACT_ELEMENT_LIMIT} of the block's length) to {}",
            0.5 * length
        );
        diagnostics.fault(POINTER, format!("{size} is outside {limits}"));
    }
    Some(size)
}

fn increments(overrides: &Overrides, diagnostics: &mut Diagnostics) -> Option<u32> {
    const POINTER: &str = "/accuracy/overrides/increments_per_cycle";
    let count = overrides.increments_per_cycle?;
    diagnostics.note(POINTER, Provenance::Given);
    let (from, to) = INCREMENT_RANGE;
    if !(from..=to).contains(&count) {
        diagnostics.fault(POINTER, format!("{count} is outside {from} to {to}"));
    }
    Some(count)
}

fn cycle_jump(overrides: &Overrides, cycles: u64, diagnostics: &mut Diagnostics) -> Option<u64> {
    const POINTER: &str = "/accuracy/overrides/cycle_jump";
    let jump = overrides.cycle_jump.as_ref()?;
    diagnostics.note(POINTER, Provenance::Given);
    match jump {
        CycleJump::Adaptive => None,
        CycleJump::Fixed(count) => {
            if !(1..=cycles.max(1)).contains(count) {
                diagnostics.fault(
                    POINTER,
                    format!("{count} is outside 1 to the number of cycles, {cycles}"),
                );
            }
            Some(*count)
        }
        CycleJump::Unknown(text) => {
            diagnostics.fault(
                POINTER,
                format!("`{}` is neither `adaptive` nor a count", shortened(text)),
            );
            None
        }
    }
}
