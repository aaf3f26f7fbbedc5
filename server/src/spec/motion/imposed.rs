//! A motion as the engine imposes it, and what the kinds of motion share.

use std::ops::RangeInclusive;

use api::spec::{DerivedMotion, Drive, Motion, Provenance, Waveform};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::Sourced;
use crate::spec::system::Preset;
use crate::spec::unit;

/// mm; from below an atom to far beyond any contact. 0 is accepted too: no motion.
pub(in crate::spec) const AMPLITUDE_MM: RangeInclusive<f64> = 1e-9..=1e4;
/// s; a megahertz to a month.
pub(in crate::spec) const PERIOD_S: RangeInclusive<f64> = 1e-6..=3e6;
/// Hz; the same range as of the period.
pub(in crate::spec) const FREQUENCY_HZ: RangeInclusive<f64> = 1.0 / 3e6..=1.0 / 1e-6;
/// A resolved motion.
pub(crate) struct ImposedMotion {
    /// As written in the resolved specification.
    pub(crate) spec: Motion,
    pub(crate) drive: scene::Drive,
    pub(crate) scene: scene::Motion,
    pub(crate) timing: scene::Timing,
    /// How it was derived from another kind.
    pub(crate) derived: Option<DerivedMotion>,
    /// Cycles of its duration, if it has one.
    pub(super) duration_cycles: Option<u64>,
}

impl ImposedMotion {
    /// Returns `true` if its duration gives its number of cycles.
    pub(in crate::spec) fn is_timed(&self) -> bool {
        self.duration_cycles.is_some()
    }
}

/// The period, from the given one of period and frequency.
pub(super) fn period(
    given: &Motion,
    default: Sourced<f64>,
    filled: &mut Motion,
    diagnostics: &mut Diagnostics,
) -> f64 {
    match (given.period_s, given.frequency_hz) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields("/motion/period_s", "frequency_hz");
            default.value
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
            let period_s = diagnostics.or_default("/motion/period_s", period_s, default);
            filled.period_s = Some(period_s);
            diagnostics.check_range("/motion/period_s", period_s, &PERIOD_S)
        }
    }
}

/// Course in time of a reciprocating motion of a waveform.
pub(super) fn timing(waveform: Waveform) -> scene::Timing {
    match waveform {
        Waveform::Sine => scene::Timing::Sine,
        Waveform::Triangle => scene::Timing::Triangle,
    }
}

/// Where a reciprocating motion enters: as given, or as in the preset.
pub(super) fn drive(given: &Motion, preset: &Preset, diagnostics: &mut Diagnostics) -> Drive {
    let drive = given.drive.as_ref();
    let drive = drive.and_then(|drive| diagnostics.enum_member("/motion/drive", drive));
    diagnostics.or_default("/motion/drive", drive, preset.drive)
}

/// In quasi-static contact only the relative motion matters, not which body is held.
pub(super) fn engine_drive(drive: Drive) -> scene::Drive {
    match drive {
        Drive::SliderTop | Drive::ReceptacleBase => scene::Drive::Handle,
        Drive::SliderBody => scene::Drive::WholeBody,
    }
}
