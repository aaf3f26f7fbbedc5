//! The mechanism of wear by speed and temperature: Archard's law, mild or severe oxidational wear.

use api::spec::WearLaw;
use solver::law::wear::speed::SLOWEST_MM_S;
use solver::scene::{self, Mechanism, MildOxidation, SevereOxidation, SpeedLaw};

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
    let (mut filled, rate) = wear_coefficient::resolve(side, given, diagnostics);
    let pointer = side.field("transition_speed_mm_s");
    let transition_mm_s =
        diagnostics.or_default(&pointer, given.transition_speed_mm_s, assumed(SLOWEST_MM_S));
    diagnostics.check_range(&pointer, transition_mm_s, &TRANSITION_SPEED_MM_S);
    filled.transition_speed_mm_s = Some(transition_mm_s);
    let hardness = filled.hardness_mpa;
    let temperature = oxidation::temperature(side, given, diagnostics);
    let mild = mild_oxidation::constants(side, given, temperature, diagnostics);
    let severe = severe_oxidation::constants(side, given, (temperature, friction), diagnostics);
    let law = rate.zip(hardness).map(|(k_over_h_per_mpa, hardness_mpa)| {
        let mild = MildOxidation {
            hardness_mpa,
            ..mild
        };
        let severe = SevereOxidation {
            hardness_mpa,
            ..severe
        };
        scene::WearLaw::OfSpeed(SpeedLaw::Mechanism(Mechanism {
            k_over_h_per_mpa,
            transition_mm_s,
            mild,
            severe,
        }))
    });
    (filled, law)
}
