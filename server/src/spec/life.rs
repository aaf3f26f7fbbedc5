//! Life: its criteria, the scatter of the wear coefficients, and the number of contacts.

use std::ops::RangeInclusive;

use api::spec::{Criterion, CriterionKind, LifeSettings};
use solver::scene;
use solver::sides::Side;

use crate::spec::criterion::{self, Modelled, Surfaces};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::{assumed, typical};

/// Most criteria of a job.
pub(in crate::spec) const CRITERION_LIMIT: usize = 64;
/// Coefficient of variation of a wear coefficient, -; repeated tests of one contact have 0.2 to 1.
pub(in crate::spec) const VARIATION: RangeInclusive<f64> = 0.0..=10.0;
/// Contacts of a connector.
pub(in crate::spec) const CONTACTS: RangeInclusive<u64> = 1..=1_000_000;

/// Resolves the life: its settings, its criteria of depths, and limits of the resistance in mOhm.
pub(super) fn resolve(
    given: &LifeSettings,
    surfaces: Surfaces<'_>,
    diagnostics: &mut Diagnostics,
) -> (LifeSettings, Vec<scene::Criterion>, Vec<f64>) {
    let criteria = match &given.criteria {
        Some(given) => {
            diagnostics.check_length("/life/criteria", given.len(), CRITERION_LIMIT);
            let given = given.iter().take(CRITERION_LIMIT).enumerate();
            let resolved = given.flat_map(|(index, given)| {
                let pointer = format!("/life/criteria/{index}");
                criterion::resolve(&pointer, given, surfaces, diagnostics)
            });
            resolved.collect()
        }
        None => exposures(surfaces),
    };
    let (criteria, modelled): (Vec<_>, Vec<_>) = criteria.into_iter().unzip();
    let variation = diagnostics.or_default(
        "/life/coefficient_of_variation",
        given.coefficient_of_variation,
        typical(0.5),
    );
    diagnostics.check_range("/life/coefficient_of_variation", variation, &VARIATION);
    let contacts = diagnostics.or_default("/life/contacts", given.contacts, assumed(1));
    diagnostics.check_count("/life/contacts", contacts, &CONTACTS);
    let filled = LifeSettings {
        coefficient_of_variation: Some(variation),
        contacts: Some(contacts),
        criteria: Some(criteria),
    };
    let (depths, limits) = Modelled::apart(modelled.into_iter().flatten());
    (filled, depths, limits)
}

/// The first exposure of every layer below the outermost one, and of the base metal, of each plated side.
fn exposures(surfaces: Surfaces<'_>) -> Vec<(Criterion, Option<Modelled>)> {
    let mut diagnostics = Diagnostics::default();
    let of_side = |side: Side| {
        let layers = 2..=surfaces.plating.of(side).len();
        let exposed = layers.map(move |layer| Criterion {
            layer: u64::try_from(layer).ok(),
            ..criterion::of(CriterionKind::FirstExposure, Some(side))
        });
        exposed.chain([criterion::of(CriterionKind::BaseMetal, Some(side))])
    };
    let plated = Side::BOTH.into_iter();
    plated
        .filter(|side| !surfaces.plating.of(*side).is_empty())
        .flat_map(of_side)
        .flat_map(|given| criterion::resolve("", &given, surfaces, &mut diagnostics))
        .collect()
}
