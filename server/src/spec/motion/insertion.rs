//! Insertion: one cycle is one mating, a pass in and a pass out over the wipe.

use std::ops::RangeInclusive;

use api::spec::{Motion, MotionKind, Waveform};

use super::contact::{Demand, Limits};
use super::imposed::{ImposedMotion, drive, period, timing};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;
use crate::spec::system::Preset;

/// mm.
pub(in crate::spec) const WIPE_MM: RangeInclusive<f64> = 1e-6..=1e3;
/// A mating and an unmating by hand, s.
const PERIOD_S: f64 = 2.0;

pub(super) fn resolve(
    given: &Motion,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> ImposedMotion {
    let fields = ["kind", "wipe_mm", "frequency_hz", "period_s", "drive"];
    diagnostics.check_fields("/motion", given, &fields, "insertion");
    let wipe_mm = diagnostics.required(
        "/motion/wipe_mm",
        given.wipe_mm,
        &WIPE_MM,
        "`insertion` needs it",
    );
    let drive = drive(given, preset, diagnostics);
    let mut spec = Motion {
        kind: MotionKind::Insertion.into(),
        wipe_mm: given.wipe_mm,
        drive: Some(drive.into()),
        ..Motion::default()
    };
    let period_s = period(given, assumed(PERIOD_S), &mut spec, diagnostics);
    let demand = Demand::beyond(0.5 * wipe_mm, Limits::NONE, 1.0 / period_s);
    let how = "half of the wipe to either side";
    ImposedMotion {
        timing: timing(Waveform::Triangle),
        ..demand.imposed(spec, drive, how, diagnostics)
    }
}
