//! Wear by dissipated energy: worn depth = alpha mu p |slip|.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearLaw};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 2] = ["law", "energy_coefficient_mm3_per_j"];

/// Worn volume per dissipated energy, mm^3/J: k/H = 1 1/MPa at mu = 1 is 1 000 mm^3/J.
pub(in crate::spec) const ENERGY_COEFFICIENT_MM3_PER_J: RangeInclusive<f64> = 0.0..=1e3;

/// Resolves the law of a specification beside a coefficient of friction.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "dissipated_energy");
    let pointer = side.field("energy_coefficient_mm3_per_j");
    let Some(mm3_per_j) = given.energy_coefficient_mm3_per_j else {
        diagnostics.missing(
            &pointer,
            "`dissipated_energy` needs the worn volume per energy",
        );
        return (given.clone(), None);
    };
    diagnostics.provenance(&pointer, Provenance::Given);
    diagnostics.check_range(&pointer, mm3_per_j, &ENERGY_COEFFICIENT_MM3_PER_J);
    let law = scene::WearLaw::DissipatedEnergy {
        mm3_per_j,
        friction,
    };
    (given.clone(), Some(law))
}
