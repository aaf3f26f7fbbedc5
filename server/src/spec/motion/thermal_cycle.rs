//! Thermal cycles: two parts of a length that expand differently move by U = |delta alpha| |delta T| L in each half of a cycle, at most
//! by the clearance c between them, and their contact rubs by that less what its arm takes up: slip range min(U, c) - 2 mu N/k_t.

use std::ops::RangeInclusive;

use api::spec::{Motion, MotionKind};

use super::contact::{Demand, HeldContact, Limits, held_mm};
use super::imposed::{ImposedMotion, drive, period};
use super::vibration::{CLEARANCE_MM, STIFFNESS_N_PER_MM};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::typical;
use crate::spec::system::Preset;

/// K, heated or cooled.
pub(in crate::spec) const DELTA_T_K: RangeInclusive<f64> = -1e3..=1e3;
/// mm, from the contact to where both parts are fixed to each other.
pub(in crate::spec) const LENGTH_MM: RangeInclusive<f64> = 1e-3..=1e4;
/// 1/K, of either sign.
pub(in crate::spec) const MISMATCH_PER_K: RangeInclusive<f64> = -1e-3..=1e-3;
/// A cycle of a climatic chamber, s.
const PERIOD_S: f64 = 3_600.0;

pub(super) fn resolve(
    given: &Motion,
    preset: &Preset,
    contact: HeldContact,
    diagnostics: &mut Diagnostics,
) -> ImposedMotion {
    let fields = [
        "kind",
        "delta_t_k",
        "length_mm",
        "expansion_mismatch_per_k",
        "tangential_stiffness_n_per_mm",
        "clearance_mm",
        "frequency_hz",
        "period_s",
        "drive",
    ];
    diagnostics.check_fields("/motion", given, &fields, "thermal_cycle");
    let needs = "`thermal_cycle` needs it";
    let mut required = |field: &str, value, range| {
        diagnostics.required(&format!("/motion/{field}"), value, range, needs)
    };
    let delta_t_k = required("delta_t_k", given.delta_t_k, &DELTA_T_K);
    let length_mm = required("length_mm", given.length_mm, &LENGTH_MM);
    let mismatch = given.expansion_mismatch_per_k;
    let mismatch = required("expansion_mismatch_per_k", mismatch, &MISMATCH_PER_K);
    let stiffness = given.tangential_stiffness_n_per_mm;
    let stiffness = diagnostics.optional(
        "/motion/tangential_stiffness_n_per_mm",
        stiffness,
        &STIFFNESS_N_PER_MM,
    );
    let clearance = diagnostics.optional("/motion/clearance_mm", given.clearance_mm, &CLEARANCE_MM);
    // Without a stiffness the arm takes up nothing, whatever the force.
    let held = if stiffness.is_some() {
        held_mm(
            contact.friction_n(MotionKind::ThermalCycle, diagnostics),
            stiffness,
        )
    } else {
        0.0
    };
    let drive = drive(given, preset, diagnostics);
    let mut spec = Motion {
        kind: MotionKind::ThermalCycle.into(),
        drive: Some(drive.into()),
        period_s: None,
        frequency_hz: None,
        waveform: None,
        ..given.clone()
    };
    let period_s = period(given, typical(PERIOD_S), &mut spec, diagnostics);
    let range_mm = (mismatch * delta_t_k * length_mm).abs();
    let limits = Limits::of(held, clearance);
    let demand = Demand::beyond(0.5 * range_mm, limits, 1.0 / period_s);
    let how = format!("{mismatch:e} 1/K times {delta_t_k} K over {length_mm} mm");
    demand.imposed(spec, drive, &how, diagnostics)
}
