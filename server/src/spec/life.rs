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
pub(super) fn warnings(filled: &LifeSettings, scene: &scene::Scene) -> Vec<Fault> {
    let Some(target) = filled.target_cycles else {
        return Vec::new();
    };
    let scatter = Scatter::of(filled);
    let shares = filled.reliability.iter().flatten().copied();
    let highest = shares.fold(0.0, f64::max);
    let least = scatter.not_survived_by_connectors(1.0 - highest);
    // As long as the verdict asks for.
    let needed = whole((real(target) / (least * (1.0 - scene.accuracy.tolerance))).ceil());
    let cycles = scene.cycles;
    if highest <= 0.0 || cycles >= needed {
        return Vec::new();
    }
    let detail = format!(
        "a run of {cycles} cycles cannot show that {} % of the connectors last {target}: the median contact has to last {needed}; give as many \
         cycles ({} at most), or expect `undecided` where the criterion is not reached",
        100.0 * highest,
        CYCLES.end()
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

#[cfg(test)]
mod tests {
    use crate::spec::{self, Refused};
    use api::problem::Fault;

    /// Faults or warnings of a memory card with this life, at `/life`.
    fn said(life: &str, others: &str) -> Vec<Fault> {
        let text = format!(r#"{{"system":{{"kind":"sd_card"}},"life":{life}{others}}}"#);
        let faults = match spec::read(text.as_bytes()) {
            Ok(resolved) => resolved.warnings,
            Err(Refused::Faults(faults)) => faults,
            Err(Refused::Parse(error)) => panic!("{error}"),
        };
        let of_life = |fault: &Fault| fault.pointer.starts_with("/life");
        faults.into_iter().filter(of_life).collect()
    }

    #[test]
    fn targets_and_shares_outside_of_their_limits_are_refused_with_both() {
        let continuous = r#","motion":{"kind":"continuous","distance_mm":10}"#;
        for (life, others, pointer, detail) in [
            (
                r#"{"target_cycles":0}"#,
                "",
                "/life/target_cycles",
                "0 is outside 1 to 1000000000",
            ),
            (
                r#"{"target_cycles":9}"#,
                continuous,
                "/life/target_cycles",
                "no cycles",
            ),
            (
                r#"{"target_cycles":9,"reliability":[]}"#,
                "",
                "/life/reliability",
                "one share",
            ),
            (
                r#"{"reliability":[0.9,1]}"#,
                "",
                "/life/reliability/1",
                "1 is outside 0.001 to 0.999999",
            ),
            (
                r#"{"reliability":[-0.5]}"#,
                "",
                "/life/reliability/0",
                "-0.5 is outside 0.001",
            ),
            (
                r#"{"reliability":[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9]}"#,
                "",
                "/life/reliability",
                "9 entries, at most 8",
            ),
        ] {
            let said = said(life, others);
            assert_eq!(said.len(), 1, "{life}: {said:?}");
            assert_eq!(said[0].pointer, pointer);
            assert!(said[0].detail.contains(detail), "{said:?}");
        }
    }

    #[test]
    fn a_run_that_is_too_short_for_its_target_is_warned_of() {
        // 10 000 over 0.235914 and 0.98.
        let life = r#"{"target_cycles":10000,"contacts":9,"reliability":[0.9,0.99]}"#;
        let warned = said(life, r#","cycles":43253"#);
        assert!(
            warned.len() == 1 && warned[0].detail.contains("last 43254;"),
            "{warned:?}"
        );
        assert_eq!(said(life, r#","cycles":43254"#), []);
        assert_eq!(said(r#"{"contacts":9}"#, r#","cycles":1"#), []);
    }
}
