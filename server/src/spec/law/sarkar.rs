//! Sarkar's wear law: worn depth = (k/H) sqrt(1 + 3 mu^2) p |slip|.

use api::spec::WearLaw;
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wear_coefficient;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 4] = ["law", "k", "hardness_mpa", "k_over_h_per_mpa"];

/// Resolves the law of a specification beside a coefficient of friction.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "sarkar");
    let (filled, k_over_h) = wear_coefficient::resolve(side, given, diagnostics);
    let law = k_over_h.map(|k_over_h_per_mpa| scene::WearLaw::Sarkar {
        k_over_h_per_mpa,
        friction,
    });
    (filled, law)
}
