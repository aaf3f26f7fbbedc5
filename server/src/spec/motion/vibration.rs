//! Vibration: a part of a mass that its contacts hold on a shaken base.
//!
//! Where a natural frequency is given, or follows from the tangential stiffness of the arms, f_n = sqrt(n k_t/m)/(2 pi), the part is
//! an oscillator (`oscillator`) and the contact slips by what exceeds the arm's deflection, mu N/k_t. Otherwise friction alone holds
//! a rigid part (`shaken_block`). A clearance stops the part at half of it to either side, whatever of that the arm takes up. Range: the
//! slip does not damp the oscillator, which its quality factor stands for, and the stop does not return its impact.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use api::spec::{Motion, MotionKind, PsdPoint};

use super::contact::{Demand, HeldContact, Limits, held_mm};
use super::imposed::{FREQUENCY_HZ, ImposedMotion, drive};
use super::oscillator::{Oscillator, gaussian_path};
use super::shaken_block;
use crate::number::{real, whole};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;
use crate::spec::system::Preset;

/// Multiples of standard gravity; a microphone's membrane to a shot.
pub(in crate::spec) const ACCELERATION_G: RangeInclusive<f64> = 1e-9..=1e6;
/// g.
pub(in crate::spec) const MASS_G: RangeInclusive<f64> = 1e-6..=1e9;
/// Contacts that hold the part.
pub(in crate::spec) const CONTACTS: RangeInclusive<u64> = 1..=1_000_000;
/// N/mm.
pub(in crate::spec) const STIFFNESS_N_PER_MM: RangeInclusive<f64> = 1e-6..=1e9;
/// -.
pub(in crate::spec) const QUALITY: RangeInclusive<f64> = 0.5..=1e4;
/// mm.
pub(in crate::spec) const CLEARANCE_MM: RangeInclusive<f64> = 0.0..=1e3;
/// s.
pub(in crate::spec) const DURATION_S: RangeInclusive<f64> = 1e-3..=1e10;
/// g^2/Hz.
pub(in crate::spec) const G2_PER_HZ: RangeInclusive<f64> = 1e-15..=1e9;
/// Points of a power spectral density.
pub(in crate::spec) const MOST_POINTS: usize = 64;

/// mm/s^2 (CGPM 1901).
pub(super) const STANDARD_GRAVITY_MM_S2: f64 = 9_806.65;
/// Quality factor of a part of a connector; that of mounted boards is 5 to 30.
const DEFAULT_QUALITY: f64 = 10.0;
/// Grams, mm/s^2 to N.
const N_PER_G_MM_S2: f64 = 1e-6;

const FIELDS: [&str; 12] = [
    "kind",
    "acceleration_g",
    "frequency_hz",
    "psd",
    "duration_s",
    "mass_g",
    "contacts",
    "tangential_stiffness_n_per_mm",
    "natural_frequency_hz",
    "quality_factor",
    "clearance_mm",
    "drive",
];

/// The part that is shaken.
struct Part {
    mass_g: f64,
    contacts: f64,
    /// Largest force of friction of one contact, N.
    friction_n: f64,
    limits: Limits,
    oscillator: Option<Oscillator>,
}

/// Resolves the motion.
pub(super) fn resolve(
    given: &Motion,
    preset: &Preset,
    contact: HeldContact,
    diagnostics: &mut Diagnostics,
) -> ImposedMotion {
    diagnostics.check_fields("/motion", given, &FIELDS, "vibration");
    let part = part(given, contact, diagnostics);
    let duration = diagnostics.optional("/motion/duration_s", given.duration_s, &DURATION_S);
    let (demand, how) = match &given.psd {
        Some(psd) => random(given, psd, &part, diagnostics),
        None => sine(given, &part, diagnostics),
    };
    let drive = drive(given, preset, diagnostics);
    let spec = Motion {
        kind: MotionKind::Vibration.into(),
        drive: Some(drive.into()),
        quality_factor: part.oscillator.map(|oscillator| oscillator.quality),
        waveform: None,
        // The number of cycles stands for it.
        duration_s: None,
        ..given.clone()
    };
    let cycles = duration.map(|duration| duration * demand.frequency_hz);
    ImposedMotion {
        duration_cycles: cycles.map(whole),
        ..demand.imposed(spec, drive, &how, diagnostics)
    }
}

fn part(given: &Motion, contact: HeldContact, diagnostics: &mut Diagnostics) -> Part {
    let needs = "`vibration` needs it";
    let mass_g = diagnostics.required("/motion/mass_g", given.mass_g, &MASS_G, needs);
    let contacts = given.contacts.unwrap_or_else(|| {
        diagnostics.missing(
            "/motion/contacts",
            "the number of contacts that hold the part",
        );
        1
    });
    diagnostics.check_count("/motion/contacts", contacts, &CONTACTS);
    let contacts = real(contacts);
    let friction_n = contact.friction_n(MotionKind::Vibration, diagnostics);
    let stiffness = diagnostics.optional(
        "/motion/tangential_stiffness_n_per_mm",
        given.tangential_stiffness_n_per_mm,
        &STIFFNESS_N_PER_MM,
    );
    let natural = diagnostics.optional(
        "/motion/natural_frequency_hz",
        given.natural_frequency_hz,
        &FREQUENCY_HZ,
    );
    let clearance = diagnostics.optional("/motion/clearance_mm", given.clearance_mm, &CLEARANCE_MM);
    let of_arms = stiffness
        .map(|stiffness| (contacts * stiffness / (mass_g * N_PER_G_MM_S2)).sqrt() / (2.0 * PI));
    let natural = natural.or(of_arms);
    let pointer = "/motion/quality_factor";
    let quality = diagnostics.optional(pointer, given.quality_factor, &QUALITY);
    if natural.is_none() && quality.is_some() {
        let detail = "belongs to an oscillator: give `natural_frequency_hz` or `tangential_stiffness_n_per_mm`";
        diagnostics.fault(pointer, detail);
    }
    let oscillator = natural.map(|natural_hz| Oscillator {
        natural_hz,
        quality: diagnostics.or_default(pointer, quality, assumed(DEFAULT_QUALITY)),
    });
    Part {
        mass_g,
        contacts,
        friction_n,
        limits: Limits::of(held_mm(friction_n, stiffness), clearance),
        oscillator,
    }
}

/// A sine of an acceleration and a frequency.
fn sine(given: &Motion, part: &Part, diagnostics: &mut Diagnostics) -> (Demand, String) {
    let needs = "`vibration` needs it, or a `psd`";
    let mut required = |field: &str, value, range| {
        diagnostics.required(&format!("/motion/{field}"), value, range, needs)
    };
    let acceleration_g = required("acceleration_g", given.acceleration_g, &ACCELERATION_G);
    let frequency_hz = required("frequency_hz", given.frequency_hz, &FREQUENCY_HZ);
    let acceleration = acceleration_g * STANDARD_GRAVITY_MM_S2;
    let how = format!("{acceleration_g} g at {frequency_hz} Hz");
    let Some(oscillator) = part.oscillator else {
        return (rigid(part, acceleration, frequency_hz), how);
    };
    let free_mm = acceleration * oscillator.compliance(frequency_hz);
    let from_g = acceleration_g * part.limits.held_mm / free_mm;
    let demand = Demand {
        slips_from_g: part.limits.let_slip().then_some(from_g),
        ..Demand::beyond(free_mm, part.limits, frequency_hz)
    };
    let how = format!("{how}, natural frequency {:.1} Hz", oscillator.natural_hz);
    (demand, how)
}

/// A rigid part that friction alone holds.
fn rigid(part: &Part, acceleration: f64, frequency_hz: f64) -> Demand {
    let friction = part.contacts * part.friction_n / (part.mass_g * N_PER_G_MM_S2);
    let angular = 2.0 * PI * frequency_hz;
    let range = shaken_block::range(friction / acceleration) * acceleration / angular.powi(2);
    // Without a stiffness its arm takes up nothing.
    let from_g = friction / STANDARD_GRAVITY_MM_S2;
    Demand {
        slips_from_g: part.limits.let_slip().then_some(from_g),
        ..Demand::beyond(0.5 * range, part.limits, frequency_hz)
    }
}

/// A random vibration of a power spectral density.
fn random(
    given: &Motion,
    psd: &[PsdPoint],
    part: &Part,
    diagnostics: &mut Diagnostics,
) -> (Demand, String) {
    for (field, is_given) in [
        ("acceleration_g", given.acceleration_g.is_some()),
        ("frequency_hz", given.frequency_hz.is_some()),
    ] {
        if is_given {
            diagnostics.exclusive_fields(&format!("/motion/{field}"), "psd");
        }
    }
    check_points(psd, diagnostics);
    let Some(oscillator) = part.oscillator else {
        let detail = "a `psd` needs it, or `tangential_stiffness_n_per_mm`";
        diagnostics.missing("/motion/natural_frequency_hz", detail);
        return (Demand::beyond(0.0, Limits::NONE, 1.0), String::new());
    };
    let density: Vec<(f64, f64)> = psd
        .iter()
        .map(|point| {
            (
                point.frequency_hz,
                point.g2_per_hz * STANDARD_GRAVITY_MM_S2.powi(2),
            )
        })
        .collect();
    let deviation = oscillator.deviation(&density);
    // An even motion of the amplitude A has the path 4 A.
    let even = |limits| 0.25 * gaussian_path(deviation, limits);
    let without_arm = Limits {
        held_mm: 0.0,
        ..part.limits
    };
    let (relative_mm, slip_mm) = (even(without_arm), even(part.limits));
    let demand = Demand {
        free_mm: even(Limits::NONE),
        relative_mm,
        held_mm: relative_mm - slip_mm,
        slip_mm,
        slips_from_g: None,
        frequency_hz: oscillator.natural_hz,
    };
    let how = format!(
        "random vibration, {:.3} um standard deviation at {:.1} Hz",
        1e3 * deviation,
        oscillator.natural_hz
    );
    (demand, how)
}

fn check_points(psd: &[PsdPoint], diagnostics: &mut Diagnostics) {
    diagnostics.check_length("/motion/psd", psd.len(), MOST_POINTS);
    if psd.len() < 2 {
        diagnostics.fault(
            "/motion/psd",
            "a power spectral density has two points or more",
        );
    }
    for (index, point) in psd.iter().enumerate().take(MOST_POINTS) {
        let pointer = |field: &str| format!("/motion/psd/{index}/{field}");
        diagnostics.check_range(&pointer("frequency_hz"), point.frequency_hz, &FREQUENCY_HZ);
        diagnostics.check_range(&pointer("g2_per_hz"), point.g2_per_hz, &G2_PER_HZ);
    }
    for (index, pair) in psd.windows(2).enumerate().take(MOST_POINTS) {
        if pair[1].frequency_hz <= pair[0].frequency_hz {
            let detail = format!(
                "{} Hz is not above the {} Hz of the point before",
                pair[1].frequency_hz, pair[0].frequency_hz
            );
            diagnostics.fault(&format!("/motion/psd/{}/frequency_hz", index + 1), detail);
        }
    }
}

#[cfg(test)]
mod tests;
