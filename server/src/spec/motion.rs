//! The imposed motion and where it enters.

use api::spec::{Choice, Drive, Motion, MotionKind, Provenance, Waveform};
use solver::scene;

use crate::reference::presets::Preset;
use crate::spec::diagnostics::{Diagnostics, Range};

/// mm; from below an atom to far beyond any contact, and 0: nothing moves.
const AMPLITUDE_MM: Range = Range {
    from: 1e-9,
    to: 1e4,
};
/// s; a megahertz to a month.
const PERIOD_S: Range = Range {
    from: 1e-6,
    to: 3e6,
};

/// mm.
const DISTANCE_MM: Range = Range {
    from: 1e-6,
    to: 1e12,
};
/// mm/s.
const SPEED_MM_S: Range = Range {
    from: 1e-9,
    to: 1e6,
};
/// A continuous motion is recorded in this many equal parts of its distance, the `cycle` of its histories.
pub(crate) const CONTINUOUS_PARTS: u64 = 100_000;
/// Speed of a continuous motion that states none, mm/s. Quasi-static contact does not depend on it.
const SPEED: f64 = 1.0;

/// A motion with every default filled in, and what the engine makes of it.
pub(crate) struct Imposed {
    pub(crate) motion: Motion,
    pub(crate) drive: scene::Drive,
    pub(crate) engine: scene::Motion,
}

impl Imposed {
    /// Distance of a continuous motion, mm.
    pub(crate) fn distance_mm(&self) -> Option<f64> {
        self.motion.distance_mm
    }
}

const NOTHING: Motion = Motion {
    kind: Choice::Known(MotionKind::Reciprocating),
    waveform: None,
    amplitude_mm: None,
    frequency_hz: None,
    period_s: None,
    drive: None,
    speed_mm_s: None,
    distance_mm: None,
};

/// Fills in the motion.
pub(crate) fn resolve(
    given: Option<&Motion>,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> Imposed {
    let from = if given.is_some() {
        Provenance::Given
    } else {
        preset.amplitude_mm.from
    };
    diagnostics.note("/motion/kind", from);
    let given = given.cloned().unwrap_or(NOTHING);
    match diagnostics.known("/motion/kind", &given.kind) {
        Some(MotionKind::Continuous) => continuous(&given, diagnostics),
        Some(MotionKind::Reciprocating) => {
            let fields = [
                ("speed_mm_s", given.speed_mm_s.is_some()),
                ("distance_mm", given.distance_mm.is_some()),
            ];
            diagnostics.misplaced("/motion", &fields, "reciprocating");
            reciprocating(&given, preset, diagnostics)
        }
        None => reciprocating(&given, preset, diagnostics),
    }
}

fn continuous(given: &Motion, diagnostics: &mut Diagnostics) -> Imposed {
    let fields = [
        ("waveform", given.waveform.is_some()),
        ("amplitude_mm", given.amplitude_mm.is_some()),
        ("frequency_hz", given.frequency_hz.is_some()),
        ("period_s", given.period_s.is_some()),
        ("drive", given.drive.is_some()),
    ];
    diagnostics.misplaced("/motion", &fields, "continuous");
    let distance_mm = given.distance_mm.unwrap_or_default();
    if given.distance_mm.is_some() {
        diagnostics.note("/motion/distance_mm", Provenance::Given);
        diagnostics.check("/motion/distance_mm", distance_mm, DISTANCE_MM);
    } else {
        diagnostics.missing("/motion/distance_mm", "`continuous` needs it");
    }
    let speed = diagnostics.take(
        "/motion/speed_mm_s",
        given.speed_mm_s,
        SPEED,
        Provenance::Assumed,
    );
    diagnostics.check("/motion/speed_mm_s", speed, SPEED_MM_S);
    #[expect(
        clippy::cast_precision_loss,
        reason = "a hundred thousand parts are exact"
    )]
    let step_mm = distance_mm / CONTINUOUS_PARTS as f64;
    Imposed {
        motion: Motion {
            kind: MotionKind::Continuous.into(),
            speed_mm_s: Some(speed),
            distance_mm: Some(distance_mm),
            ..NOTHING
        },
        drive: scene::Drive::Handle,
        engine: scene::Motion::Continuous { step_mm },
    }
}

fn reciprocating(given: &Motion, preset: &Preset, diagnostics: &mut Diagnostics) -> Imposed {
    let waveform = given
        .waveform
        .as_ref()
        .and_then(|waveform| diagnostics.known("/motion/waveform", waveform));
    let waveform = diagnostics.take(
        "/motion/waveform",
        waveform,
        preset.waveform.value,
        preset.waveform.from,
    );
    let drive = given
        .drive
        .as_ref()
        .and_then(|drive| diagnostics.known("/motion/drive", drive));
    let drive = diagnostics.take(
        "/motion/drive",
        drive,
        preset.drive.value,
        preset.drive.from,
    );
    let amplitude_mm = diagnostics.take(
        "/motion/amplitude_mm",
        given.amplitude_mm,
        preset.amplitude_mm.value,
        preset.amplitude_mm.from,
    );
    diagnostics.check_or_zero("/motion/amplitude_mm", amplitude_mm, AMPLITUDE_MM);
    let mut motion = filled(NOTHING, waveform, drive, amplitude_mm);
    let period_s = period(given, preset, &mut motion, diagnostics);
    Imposed {
        motion,
        drive: engine_drive(drive),
        engine: scene::Motion::Reciprocating {
            amplitude_mm,
            period_s,
        },
    }
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
fn period(
    given: &Motion,
    preset: &Preset,
    filled: &mut Motion,
    diagnostics: &mut Diagnostics,
) -> f64 {
    match (given.period_s, given.frequency_hz) {
        (Some(_), Some(_)) => {
            diagnostics.fault(
                "/motion/period_s",
                "stands beside `frequency_hz`; write one of them",
            );
            preset.period_s.value
        }
        (None, Some(frequency_hz)) => {
            diagnostics.note("/motion/frequency_hz", Provenance::Given);
            filled.frequency_hz = Some(frequency_hz);
            diagnostics.check(
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
            let period_s = diagnostics.take(
                "/motion/period_s",
                period_s,
                preset.period_s.value,
                preset.period_s.from,
            );
            filled.period_s = Some(period_s);
            diagnostics.check("/motion/period_s", period_s, PERIOD_S)
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
