//! The imposed motion, where it enters, and the number of cycles.

mod contact;
pub(in crate::spec) mod fourier;
mod imposed;
pub(in crate::spec) mod insertion;
mod oscillator;
mod shaken_block;
pub(in crate::spec) mod thermal_cycle;
pub(in crate::spec) mod vibration;

use std::ops::RangeInclusive;

use api::spec::{Motion, MotionKind, Provenance};
use solver::scene;

use crate::number::real;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;
use crate::spec::system::Preset;
use crate::spec::unit;
pub(crate) use contact::HeldContact;
pub(crate) use imposed::ImposedMotion;
pub(in crate::spec) use imposed::{AMPLITUDE_MM, FREQUENCY_HZ, PERIOD_S};
use imposed::{drive, engine_drive, period};

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

/// Resolves the motion.
pub(crate) fn resolve(
    given: Option<&Motion>,
    preset: &Preset,
    contact: HeldContact,
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
        Some(MotionKind::Vibration) => vibration::resolve(given, preset, contact, diagnostics),
        Some(MotionKind::ThermalCycle) => {
            thermal_cycle::resolve(given, preset, contact, diagnostics)
        }
        Some(MotionKind::Fourier) => fourier::resolve(given, preset, diagnostics),
        Some(MotionKind::Insertion) => insertion::resolve(given, preset, diagnostics),
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
    if let Some(cycles) = motion.duration_cycles {
        if given.is_some() {
            diagnostics.exclusive_fields("/cycles", "motion.duration_s");
        }
        if !CYCLES.contains(&cycles) {
            let (least, most) = CYCLES.into_inner();
            let detail = format!("{cycles} cycles in that time, {least} to {most} are allowed");
            diagnostics.fault("/motion/duration_s", detail);
        }
        return cycles.max(1);
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
        timing: scene::Timing::Speed { mm_s: speed },
        derived: None,
        duration_cycles: None,
    }
}

fn reciprocating(given: &Motion, preset: &Preset, diagnostics: &mut Diagnostics) -> ImposedMotion {
    let waveform = given
        .waveform
        .as_ref()
        .and_then(|waveform| diagnostics.enum_member("/motion/waveform", waveform));
    let waveform = diagnostics.or_default("/motion/waveform", waveform, preset.waveform);
    let drive = drive(given, preset, diagnostics);
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
    let period_s = period(given, preset.period_s, &mut spec, diagnostics);
    ImposedMotion {
        spec,
        drive: engine_drive(drive),
        scene: scene::Motion::Reciprocating {
            amplitude_mm,
            period_s,
        },
        timing: imposed::timing(waveform),
        derived: None,
        duration_cycles: None,
    }
}
