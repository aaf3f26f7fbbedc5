//! The imposed motion, where it enters, and the number of cycles.

use std::ops::RangeInclusive;

use api::spec::{Drive, Motion, MotionKind, Provenance};
use solver::scene;

use crate::number::real;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;
use crate::spec::system::Preset;
use crate::spec::unit;

/// mm; from below an atom to far beyond any contact. 0 is accepted too: no motion.
pub(in crate::spec) const AMPLITUDE_MM: RangeInclusive<f64> = 1e-9..=1e4;
/// s; a megahertz to a month.
pub(in crate::spec) const PERIOD_S: RangeInclusive<f64> = 1e-6..=3e6;
/// Hz; the same range as of the period.
pub(in crate::spec) const FREQUENCY_HZ: RangeInclusive<f64> = 1.0 / 3e6..=1.0 / 1e-6;
/// mm.
pub(in crate::spec) const DISTANCE_MM: RangeInclusive<f64> = 1e-6..=1e12;
/// mm/s.
pub(in crate::spec) const SPEED_MM_S: RangeInclusive<f64> = 1e-9..=1e6;
/// Cycles of a job.
pub(crate) const CYCLES: RangeInclusive<u64> = 1..=1_000_000_000;
/// A continuous motion is recorded in this many equal parts of its distance, the `cycle` of its histories.
pub(crate) const CONTINUOUS_PARTS: u64 = 100_000;
/// Default speed of a continuous motion, mm/s. Quasi-static contact does not depend on it.
const DEFAULT_SPEED_MM_S: f64 = 1.0;

/// A resolved motion.
pub(crate) struct ImposedMotion {
    /// As written in the resolved specification.
    pub(crate) spec: Motion,
    pub(crate) drive: scene::Drive,
    pub(crate) scene: scene::Motion,
}

/// Resolves the motion.
pub(crate) fn resolve(
    given: Option<&Motion>,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> ImposedMotion {
    let provenance = match given {
        Some(_) => Provenance::Given,
        None => preset.amplitude_mm.provenance,
    };
    diagnostics.provenance("/motion/kind", provenance);
    let given = &given.cloned().unwrap_or_default();
    match diagnostics.enum_member("/motion/kind", &given.kind) {
        Some(MotionKind::Continuous) => continuous(given, diagnostics),
        Some(MotionKind::Reciprocating) => {
            let fields = [
                "kind",
                "waveform",
                "amplitude_mm",
                "frequency_hz",
                "period_s",
                "drive",
            ];
            diagnostics.check_fields("/motion", given, &fields, "reciprocating");
            reciprocating(given, preset, diagnostics)
        }
        None => reciprocating(given, preset, diagnostics),
    }
}

/// Resolves the number of cycles; a continuous motion has no such field.
pub(crate) fn cycles(
    given: Option<u64>,
    motion: &ImposedMotion,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> u64 {
    if motion.spec.distance_mm.is_some() {
        if given.is_some() {
            diagnostics.foreign_field("", "cycles", "continuous");
        }
        return CONTINUOUS_PARTS;
    }
    let cycles = diagnostics.or_default("/cycles", given, preset.cycles);
    diagnostics.check_count("/cycles", cycles, &CYCLES)
}

fn continuous(given: &Motion, diagnostics: &mut Diagnostics) -> ImposedMotion {
    let fields = ["kind", "speed_mm_s", "distance_mm"];
    diagnostics.check_fields("/motion", given, &fields, "continuous");
    let distance_mm = given.distance_mm.unwrap_or_default();
    if given.distance_mm.is_some() {
        diagnostics.provenance("/motion/distance_mm", Provenance::Given);
        diagnostics.check_range("/motion/distance_mm", distance_mm, &DISTANCE_MM);
    } else {
        diagnostics.missing("/motion/distance_mm", "`continuous` needs it");
    }
    let default = assumed(DEFAULT_SPEED_MM_S);
    let speed = diagnostics.or_default("/motion/speed_mm_s", given.speed_mm_s, default);
    diagnostics.check_range("/motion/speed_mm_s", speed, &SPEED_MM_S);
    let step_mm = distance_mm / real(CONTINUOUS_PARTS);
    ImposedMotion {
        spec: Motion {
            kind: MotionKind::Continuous.into(),
            speed_mm_s: Some(speed),
            distance_mm: Some(distance_mm),
            ..Motion::default()
        },
        drive: scene::Drive::Handle,
        scene: scene::Motion::Continuous { step_mm },
    }
}

fn reciprocating(given: &Motion, preset: &Preset, diagnostics: &mut Diagnostics) -> ImposedMotion {
    let waveform = given
        .waveform
        .as_ref()
        .and_then(|waveform| diagnostics.enum_member("/motion/waveform", waveform));
    let waveform = diagnostics.or_default("/motion/waveform", waveform, preset.waveform);
    let drive = given
        .drive
        .as_ref()
        .and_then(|drive| diagnostics.enum_member("/motion/drive", drive));
    let drive = diagnostics.or_default("/motion/drive", drive, preset.drive);
    let amplitude = given.amplitude_mm;
    let amplitude_mm =
        diagnostics.or_default("/motion/amplitude_mm", amplitude, preset.amplitude_mm);
    diagnostics.check_zero_or_range("/motion/amplitude_mm", amplitude_mm, &AMPLITUDE_MM);
    let typical = unit::amplitude_mm(preset.amplitude_mm.value);
    diagnostics.check_unit("/motion/amplitude_mm", amplitude, &typical);
    let mut spec = Motion {
        waveform: Some(waveform.into()),
        drive: Some(drive.into()),
        amplitude_mm: Some(amplitude_mm),
        ..Motion::default()
    };
    let period_s = period(given, preset, &mut spec, diagnostics);
    ImposedMotion {
        spec,
        drive: engine_drive(drive),
        scene: scene::Motion::Reciprocating {
            amplitude_mm,
            period_s,
        },
    }
}

/// The period, from the given one of period and frequency.
fn period(
    given: &Motion,
    preset: &Preset,
    filled: &mut Motion,
    diagnostics: &mut Diagnostics,
) -> f64 {
    match (given.period_s, given.frequency_hz) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields("/motion/period_s", "frequency_hz");
            preset.period_s.value
        }
        (None, Some(frequency_hz)) => {
            diagnostics.provenance("/motion/frequency_hz", Provenance::Given);
            filled.frequency_hz = Some(frequency_hz);
            diagnostics.check_range("/motion/frequency_hz", frequency_hz, &FREQUENCY_HZ);
            let typical = &unit::FREQUENCY_HZ;
            diagnostics.check_unit("/motion/frequency_hz", Some(frequency_hz), typical);
            1.0 / frequency_hz
        }
        (period_s, None) => {
            let period_s = diagnostics.or_default("/motion/period_s", period_s, preset.period_s);
            filled.period_s = Some(period_s);
            diagnostics.check_range("/motion/period_s", period_s, &PERIOD_S)
        }
    }
}

/// In quasi-static contact only the relative motion matters, not which body is held.
fn engine_drive(drive: Drive) -> scene::Drive {
    match drive {
        Drive::SliderTop | Drive::ReceptacleBase => scene::Drive::Handle,
        Drive::SliderBody => scene::Drive::WholeBody,
    }
}
