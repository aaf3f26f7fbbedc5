//! Constants of the oxidational wear laws; all of them are required from the user. Published are those of steels alone.

use std::ops::RangeInclusive;

use solver::law::wear::speed::SLOWEST_MM_S;

use crate::spec::law::definition::{Absent, FieldGroup, each, number};

/// °C: asperities from the coldest surroundings to where every oxide melts.
pub(super) const CONTACT_TEMPERATURE_C: RangeInclusive<f64> = -273.0..=3_000.0;
/// J/mol; those of diffusion in oxides are 1e5 to 3e5.
pub(super) const ACTIVATION_ENERGY_J_MOL: RangeInclusive<f64> = 1e3..=1e6;
/// um, from some atoms to beyond any oxide that holds together; also lengths of asperities and of the diffusion of heat.
pub(super) const LENGTH_UM: RangeInclusive<f64> = 1e-3..=1e4;
/// Arrhenius constants, in their units: that of steels changes by eight orders of magnitude from oxide to oxide.
pub(super) const ARRHENIUS_CONSTANT: RangeInclusive<f64> = 1e-20..=1e20;
/// Fractions and shares, -.
pub(super) const FRACTION: RangeInclusive<f64> = 1e-6..=1.0;

/// Wear coefficient below which no wear has been measured; those of lubricated contacts end at 1e-9.
pub(super) const SMALLEST: f64 = 1e-12;

/// A constant without a default.
pub(super) const REQUIRED: Absent = Absent::Required(
    "the oxidational laws have no default constants: published are those of steels alone",
);

/// The temperature of the contact, which also other laws take.
pub(super) const TEMPERATURE: FieldGroup = FieldGroup {
    numbers: &[number!(
        contact_temperature_c,
        "T",
        CONTACT_TEMPERATURE_C,
        Absent::Other(
            "that of the surroundings, and what friction and current heat the contact by"
        )
    )],
    resolve: each,
};

/// Warning of a wear coefficient at a mean speed in mm/s that is none of oxidational wear.
pub(super) fn implausible(coefficient: f64, mean: f64) -> Option<String> {
    if coefficient < SMALLEST {
        return Some(format!(
            "the law gives a wear coefficient of {coefficient:.0e}, which is no wear: its temperature is that of the surroundings and of \
             the heat of the contact as a whole unless `contact_temperature_c` states that of the asperities, which flashes heat"
        ));
    }
    if coefficient > 1.0 {
        return Some(format!(
            "the law gives {coefficient:.2} particles for each encounter of asperities at {mean:.4} mm/s: at most one can come off"
        ));
    }
    (mean < SLOWEST_MM_S).then(|| {
        format!(
            "the contact slides at {mean:.4} mm/s on average: oxidational wear is that of asperities that friction heats, from some \
             {SLOWEST_MM_S} mm/s on for steels; below, Archard's law holds"
        )
    })
}
