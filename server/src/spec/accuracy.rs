//! Accuracy: a tolerance or a preset, and settings fixed by the user.

use std::ops::RangeInclusive;

use api::spec::{Accuracy, CycleJump, Overrides, Preset, Provenance};
use solver::scene;

use crate::spec::diagnostics::{Diagnostics, shortened};
use crate::spec::sourced::assumed;
use crate::spec::system::Shapes;

/// Relative.
pub(in crate::spec) const TOLERANCE: RangeInclusive<f64> = 1e-6..=0.5;
/// Most surface elements along the block at a fixed element size.
const CONTACT_ELEMENT_LIMIT: f64 = 20_000.0;
const CONTACT_ELEMENT: &str = "/accuracy/overrides/contact_element_mm";
pub(in crate::spec) const INCREMENTS: RangeInclusive<u64> = 4..=1_000_000;
/// Increments a cycle of the source.
const SOURCE_INCREMENTS: u32 = 32;

/// Resolves the accuracy.
pub(crate) fn resolve(
    given: &Accuracy,
    shapes: &Shapes,
    cycles: u64,
    diagnostics: &mut Diagnostics,
) -> (Accuracy, scene::Accuracy) {
    let preset = given
        .preset
        .as_ref()
        .and_then(|preset| diagnostics.enum_member("/accuracy/preset", preset));
    let mut filled = given.clone();
    let tolerance = if let Some(tolerance) = given.tolerance {
        if given.preset.is_some() {
            diagnostics.exclusive_fields("/accuracy/tolerance", "preset");
        }
        diagnostics.provenance("/accuracy/tolerance", Provenance::Given);
        diagnostics.check_range("/accuracy/tolerance", tolerance, &TOLERANCE)
    } else {
        let default = assumed(Preset::Standard);
        let preset = diagnostics.or_default("/accuracy/preset", preset, default);
        filled.preset = Some(preset.into());
        preset_tolerance(preset)
    };
    let estimate_errors = diagnostics.or_default(
        "/accuracy/estimate_errors",
        given.estimate_errors,
        assumed(true),
    );
    filled.estimate_errors = Some(estimate_errors);
    let empty = Overrides::default();
    let overrides = given.overrides.as_ref().unwrap_or(&empty);
    let elements = source_elements(preset);
    let source_element = elements.map(|count| shapes.block.length_mm / count);
    let source_increments = elements.map(|_| SOURCE_INCREMENTS);
    let numerical = scene::Accuracy {
        contact_element_mm: contact_element(overrides, shapes, diagnostics).or(source_element),
        increments_per_cycle: increments(overrides, diagnostics).or(source_increments),
        cycle_jump: cycle_jump(overrides, cycles, diagnostics),
        estimate_errors,
        ..scene::Accuracy::from_tolerance(tolerance)
    };
    (filled, numerical)
}

fn preset_tolerance(preset: Preset) -> f64 {
    match preset {
        Preset::Draft | Preset::SourceCoarse | Preset::SourceFine => 0.1,
        Preset::Standard => 0.02,
        Preset::Fine => 0.003,
    }
}

/// Elements along the block's length in the source's plane models: 16 of 5.29 um on 84.67 um in the finer one (two
/// widths are stated as 10.58 um); half as many are assumed in the coarse one, for which it states no number.
fn source_elements(preset: Option<Preset>) -> Option<f64> {
    match preset? {
        Preset::SourceCoarse => Some(8.0),
        Preset::SourceFine => Some(16.0),
        Preset::Draft | Preset::Standard | Preset::Fine => None,
    }
}

fn contact_element(
    overrides: &Overrides,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    let size = overrides.contact_element_mm?;
    diagnostics.provenance(CONTACT_ELEMENT, Provenance::Given);
    let length = shapes.block.length_mm;
    let (smallest, largest) = (length / CONTACT_ELEMENT_LIMIT, 0.5 * length);
    if !(smallest..=largest).contains(&size) {
        let limits =
            format!("{smallest} (1/{CONTACT_ELEMENT_LIMIT} of the block's length) to {largest}");
        diagnostics.fault(CONTACT_ELEMENT, format!("{size} is outside {limits}"));
    }
    Some(size)
}

fn increments(overrides: &Overrides, diagnostics: &mut Diagnostics) -> Option<u32> {
    const POINTER: &str = "/accuracy/overrides/increments_per_cycle";
    let count = overrides.increments_per_cycle?;
    diagnostics.provenance(POINTER, Provenance::Given);
    Some(diagnostics.check_count(POINTER, count, &INCREMENTS))
}

fn cycle_jump(overrides: &Overrides, cycles: u64, diagnostics: &mut Diagnostics) -> Option<u64> {
    const POINTER: &str = "/accuracy/overrides/cycle_jump";
    let jump = overrides.cycle_jump.as_ref()?;
    diagnostics.provenance(POINTER, Provenance::Given);
    match jump {
        CycleJump::Adaptive => None,
        CycleJump::Fixed(count) => {
            if !(1..=cycles.max(1)).contains(count) {
                let detail = format!("{count} is outside 1 to the number of cycles, {cycles}");
                diagnostics.fault(POINTER, detail);
            }
            Some(*count)
        }
        CycleJump::Unknown(text) => {
            let detail = format!("`{}` is neither `adaptive` nor a count", shortened(text));
            diagnostics.fault(POINTER, detail);
            None
        }
    }
}
