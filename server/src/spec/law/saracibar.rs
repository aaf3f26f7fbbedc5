//! Saracibar and Chiumenti's wear law: worn depth = (k/H) (mu/mu0) p |slip|.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearLaw};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wear_coefficient;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 5] = [
    "law",
    "k",
    "hardness_mpa",
    "k_over_h_per_mpa",
    "reference_friction",
];

/// Coefficient of friction mu0, -: that of a measurement, which is not 0.
pub(in crate::spec) const REFERENCE_FRICTION: RangeInclusive<f64> = 1e-3..=2.0;

/// Resolves the law of a specification beside a coefficient of friction.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "saracibar");
    let (filled, k_over_h) = wear_coefficient::resolve(side, given, diagnostics);
    let pointer = side.field("reference_friction");
    let Some(reference_friction) = given.reference_friction else {
        diagnostics.missing(
            &pointer,
            "`saracibar` needs the coefficient of friction at which k was measured",
        );
        return (filled, None);
    };
    diagnostics.provenance(&pointer, Provenance::Given);
    diagnostics.check_range(&pointer, reference_friction, &REFERENCE_FRICTION);
    let law = k_over_h.map(|k_over_h_per_mpa| scene::WearLaw::Saracibar {
        k_over_h_per_mpa,
        friction,
        reference_friction,
    });
    (filled, law)
}
