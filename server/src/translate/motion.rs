//! The imposed motion and where it enters.

use api::spec::{Drive, Motion, MotionKind, Provenance, Waveform};
use solver::scene;

use super::ledger::{Ledger, Range};
use super::preset::Preset;

/// mm; from below an atom to far beyond any contact.
const AMPLITUDE_MM: Range = Range {
    from: 1e-9,
    to: 1e4,
};
/// s; a megahertz to a month.
const PERIOD_S: Range = Range {
    from: 1e-6,
    to: 3e6,
};

/// Fills in the motion; also returns the engine's drive and motion.
pub(super) fn resolve(
    given: Option<&Motion>,
    preset: &Preset,
    ledger: &mut Ledger,
) -> (Motion, scene::Drive, scene::Motion) {
    let empty = Motion {
        kind: MotionKind::Reciprocating.into(),
        waveform: None,
        amplitude_mm: None,
        frequency_hz: None,
        period_s: None,
        drive: None,
        speed_mm_s: None,
        distance_mm: None,
    };
    ledger.note(
        "/motion/kind",
        if given.is_some() {
            Provenance::Given
        } else {
            preset.amplitude_mm.from
        },
    );
    let given = given.cloned().unwrap_or(empty.clone());
    let kind = ledger.known("/motion/kind", &given.kind);
    if kind == Some(MotionKind::Continuous) {
        ledger.fault("/motion/kind", "`continuous` is not available yet");
    }
    if kind == Some(MotionKind::Reciprocating) {
        let fields = [
            ("speed_mm_s", given.speed_mm_s.is_some()),
            ("distance_mm", given.distance_mm.is_some()),
        ];
        ledger.misplaced("/motion", &fields, "reciprocating");
    }
    let waveform = given
        .waveform
        .as_ref()
        .and_then(|waveform| ledger.known("/motion/waveform", waveform));
    let waveform = ledger.take(
        "/motion/waveform",
        waveform,
        preset.waveform.value,
        preset.waveform.from,
    );
    let drive = given
        .drive
        .as_ref()
        .and_then(|drive| ledger.known("/motion/drive", drive));
    let drive = ledger.take(
        "/motion/drive",
        drive,
        preset.drive.value,
        preset.drive.from,
    );
    let amplitude_mm = ledger.take(
        "/motion/amplitude_mm",
        given.amplitude_mm,
        preset.amplitude_mm.value,
        preset.amplitude_mm.from,
    );
    ledger.check("/motion/amplitude_mm", amplitude_mm, AMPLITUDE_MM);
    let mut filled = filled(empty, waveform, drive, amplitude_mm);
    let period_s = period(&given, preset, &mut filled, ledger);
    (
        filled,
        engine_drive(drive),
        scene::Motion::Reciprocating {
            amplitude_mm,
            period_s,
        },
    )
}

fn filled(empty: Motion, waveform: Waveform, drive: Drive, amplitude_mm: f64) -> Motion {
    Motion {
        waveform: Some(waveform.into()),
        drive: Some(drive.into()),
        amplitude_mm: Some(amplitude_mm),
        ..empty
    }
}

/// The period, from whichever of period and frequency was written.
fn period(given: &Motion, preset: &Preset, filled: &mut Motion, ledger: &mut Ledger) -> f64 {
    match (given.period_s, given.frequency_hz) {
        (Some(_), Some(_)) => {
            ledger.fault(
                "/motion/period_s",
                "stands beside `frequency_hz`; write one of them",
            );
            preset.period_s.value
        }
        (None, Some(frequency_hz)) => {
            ledger.note("/motion/frequency_hz", Provenance::Given);
            filled.frequency_hz = Some(frequency_hz);
            ledger.check(
                "/motion/frequency_hz",
                frequency_hz,
                Range {
                    from: 1.0 / PERIOD_S.to,
                    to: 1.0 / PERIOD_S.from,
                },
            );
            1.0 / frequency_hz
        }
        (period_s, None) => {
            let period_s = ledger.take(
                "/motion/period_s",
                period_s,
                preset.period_s.value,
                preset.period_s.from,
            );
            filled.period_s = Some(period_s);
            ledger.check("/motion/period_s", period_s, PERIOD_S)
        }
    }
}

/// Quasi-static contact does not tell which of both bodies is held.
fn engine_drive(drive: Drive) -> scene::Drive {
    match drive {
        Drive::SliderTop | Drive::ReceptacleBase => scene::Drive::Handle,
        Drive::SliderBody => scene::Drive::WholeBody,
    }
}
