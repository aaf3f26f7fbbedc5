//! Life: its criteria, the scatter of the wear coefficients, and the number of contacts.

use std::ops::RangeInclusive;

use api::problem::Fault;
use api::spec::{Criterion, CriterionKind, LifeSettings};
use solver::scene;
use solver::sides::Side;

use crate::number::{real, whole};
use crate::spec::criterion::{self, Modelled, Surfaces};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::motion::CYCLES;
use crate::spec::scatter::Scatter;
use crate::spec::sourced::{assumed, typical};

/// Most criteria of a job.
pub(in crate::spec) const CRITERION_LIMIT: usize = 64;
/// Coefficient of variation of a wear coefficient, -; repeated tests of one contact have 0.2 to 1.
pub(in crate::spec) const VARIATION: RangeInclusive<f64> = 0.0..=10.0;
/// Shares that have to last, and most of them. Beyond, the tail of a distribution is no more known.
pub(in crate::spec) const RELIABILITY: RangeInclusive<f64> = 0.001..=0.999_999;
pub(in crate::spec) const MOST_SHARES: usize = 8;
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
    if let Some(target) = given.target_cycles {
        diagnostics.check_count("/life/target_cycles", target, &CYCLES);
    }
    let reliability = diagnostics.or_default(
        "/life/reliability",
        given.reliability.clone(),
        typical(vec![0.9, 0.99]),
    );
    diagnostics.check_length("/life/reliability", reliability.len(), MOST_SHARES);
    if given.target_cycles.is_some() && reliability.is_empty() {
        diagnostics.fault("/life/reliability", "a target needs one share at least");
    }
    for (index, share) in reliability.iter().enumerate() {
        diagnostics.check_range(&format!("/life/reliability/{index}"), *share, &RELIABILITY);
    }
    let filled = LifeSettings {
        coefficient_of_variation: Some(variation),
        contacts: Some(contacts),
        target_cycles: given.target_cycles,
        reliability: Some(reliability),
        criteria: Some(criteria),
    };
    let (depths, limits) = Modelled::apart(modelled.into_iter().flatten());
    (filled, depths, limits)
}

/// Refuses a target in cycles for a motion that has none.
pub(super) fn check_motion(
    given: &LifeSettings,
    motion: scene::Motion,
    diagnostics: &mut Diagnostics,
) {
    if given.target_cycles.is_some() && matches!(motion, scene::Motion::Continuous { .. }) {
        diagnostics.fault(
            "/life/target_cycles",
            "a continuous motion has no cycles; compare `life.at_reliability`, in mm, with the distance",
        );
    }
}

/// Warns where a run ends before it can show that the target is met.
pub(super) fn warnings(filled: &LifeSettings, cycles: u64) -> Vec<Fault> {
    let Some(target) = filled.target_cycles else {
        return Vec::new();
    };
    let scatter = Scatter::of(filled);
    let shares = filled.reliability.iter().flatten().copied();
    let highest = shares.fold(0.0, f64::max);
    let least = scatter.not_survived_by_connectors(1.0 - highest);
    let needed = whole((real(target) / least).ceil());
    if highest <= 0.0 || cycles >= needed {
        return Vec::new();
    }
    let detail = format!(
        "a run of {cycles} cycles cannot show that {} % of the connectors last {target}: the median contact has to last {needed}; give as many \
         cycles, or expect `undecided` where the criterion is not reached",
        100.0 * highest
    );
    vec![Fault::new("/life/target_cycles", detail)]
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
