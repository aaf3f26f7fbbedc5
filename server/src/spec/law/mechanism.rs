//! The mechanism of wear by speed and temperature: Archard's law, mild or severe oxidational wear.

use api::spec::WearLaw;
use solver::law::wear::speed::SLOWEST_MM_S;
use solver::scene::{self, Mechanism, SpeedLaw, SurfaceState};

use super::oxidation::TRANSITION_SPEED_MM_S;
use super::{mild_oxidation, oxidation, severe_oxidation, wear_coefficient};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::sourced::assumed;

/// Resolves the law of a specification beside a coefficient of friction.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    let own = [
        "law",
        "k",
        "hardness_mpa",
        "contact_temperature_c",
        "transition_speed_mm_s",
    ];
    let constants = mild_oxidation::CONSTANTS
        .iter()
        .chain(&severe_oxidation::CONSTANTS);
    let fields: Vec<&str> = own.iter().chain(constants).copied().collect();
    diagnostics.check_fields(&side.pointer, given, &fields, "oxidation");
    let mut filled = wear_coefficient::with_hardness(side, given, diagnostics);
    let pointer = side.field("transition_speed_mm_s");
    let transition_mm_s =
        diagnostics.or_default(&pointer, given.transition_speed_mm_s, assumed(SLOWEST_MM_S));
    diagnostics.check_range(&pointer, transition_mm_s, &TRANSITION_SPEED_MM_S);
    filled.transition_speed_mm_s = Some(transition_mm_s);
    let mild = mild_oxidation::constants(side, given, diagnostics);
    let severe = severe_oxidation::constants(side, given, friction, diagnostics);
    let temperature = oxidation::temperature(side, given, diagnostics);
    let law = given.k.zip(filled.hardness_mpa).map(|(k, hardness_mpa)| {
        let surface = SurfaceState {
            hardness_mpa,
            temperature,
        };
        scene::WearLaw::OfSpeed(SpeedLaw::Mechanism(Mechanism {
            k,
            transition_mm_s,
            mild: mild(surface),
            severe: severe(surface),
        }))
    });
    (filled, law)
}
