//! Whether contacts and connectors last the target of a specification.
//!
//! A connector of n contacts lasts in a share R of all where its life at R, that of the first of its contacts, is at least the target. The
//! estimated error e of the computed life leaves a ratio of both between 1 - e and 1 + e open.

use api::results::{LifeAtReliability, LifeEntry, Verdict};
use api::spec::LifeSettings;

use crate::number::real;
use crate::spec::scatter::Scatter;

/// States lives at each share of the reliability, and the verdict on the target, of a life that was reached, in its unit.
pub(super) fn judge(
    entry: &mut LifeEntry,
    settings: &LifeSettings,
    scatter: Option<&Scatter>,
    life: f64,
) {
    let target = settings.target_cycles.map(real);
    if let Some(scatter) = scatter {
        entry.at_reliability = at_reliability(settings, scatter, life);
        let failed = target.map(|target| scatter.failed(target / life));
        entry.share_failed_at_target = failed;
        entry.connectors_failed_at_target = failed.map(|failed| scatter.connectors_failed(failed));
    }
    let margins = entry.at_reliability.iter().filter_map(|at| at.margin);
    let least = margins.reduce(f64::min);
    let error = entry.estimated_relative_error.unwrap_or_default();
    entry.verdict = target.map(|_| match least {
        Some(margin) if margin * (1.0 - error) >= 1.0 => Verdict::Pass,
        Some(margin) if margin * (1.0 + error) < 1.0 => Verdict::Fail,
        _ => Verdict::Undecided,
    });
}

/// The verdict on a life that is longer than a run of so many cycles.
pub(super) fn of_unreached(
    settings: &LifeSettings,
    scatter: Option<&Scatter>,
    done: u64,
) -> Option<Verdict> {
    let target = settings.target_cycles.map(real)?;
    let lasts = |scatter: &Scatter| {
        let shares = settings.reliability.iter().flatten();
        let mut lives = shares.map(|share| scatter.not_survived_by_connectors(1.0 - share));
        lives.all(|ratio| ratio * real(done) >= target)
    };
    Some(if scatter.is_some_and(lasts) {
        Verdict::Pass
    } else {
        Verdict::Undecided
    })
}

fn at_reliability(settings: &LifeSettings, scatter: &Scatter, life: f64) -> Vec<LifeAtReliability> {
    let shares = settings.reliability.iter().flatten();
    shares
        .map(|share| {
            let failed = 1.0 - share;
            let of_contacts = scatter.not_survived_by_connectors(failed) * life;
            LifeAtReliability {
                share: *share,
                cycles: scatter.not_survived_by(failed) * life,
                of_contacts,
                margin: settings
                    .target_cycles
                    .map(|target| of_contacts / real(target)),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec;
    use api::results::LifeStatus;

    /// Settings of nine contacts with a target, and their scatter.
    fn settings(target: u64) -> (LifeSettings, Scatter) {
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"life":{{"contacts":9,"target_cycles":{target},"reliability":[0.9,0.99]}}}}"#
        );
        let settings = spec::read(text.as_bytes()).expect("accepted").spec.life;
        let scatter = Scatter::of(&settings);
        (settings, scatter)
    }

    /// The verdict on a life of 10 000 cycles of this error, of which nine contacts last 2359 in 99 % of all connectors.
    fn judged(target: u64, error: f64) -> LifeEntry {
        let (settings, scatter) = settings(target);
        let criteria = settings.criteria.clone().expect("there are some");
        let mut entry = LifeEntry {
            estimated_relative_error: Some(error),
            ..super::super::empty(&criteria[0], LifeStatus::Reached)
        };
        judge(&mut entry, &settings, Some(&scatter), 10_000.0);
        entry
    }

    #[test]
    fn a_target_passes_or_fails_beyond_the_error_of_the_life() {
        let entry = judged(2_300, 0.02);
        assert_eq!(entry.verdict, Some(Verdict::Pass));
        let [tenth, hundredth] = &entry.at_reliability[..] else {
            panic!("two shares: {entry:?}");
        };
        assert!((tenth.cycles - 5_458.7).abs() < 0.1 && (tenth.of_contacts - 3_424.0).abs() < 0.1);
        assert!(
            (hundredth.of_contacts - 2359.1).abs() < 0.1,
            "{hundredth:?}"
        );
        let margin = hundredth.margin.expect("there is a target");
        assert!((margin - hundredth.of_contacts / 2_300.0).abs() < 1e-12);
        for (target, error, verdict) in [
            (2_300, 0.05, Verdict::Undecided),
            (2_400, 0.02, Verdict::Undecided),
            (2_400, 0.005, Verdict::Fail),
            (3_000, 0.02, Verdict::Fail),
        ] {
            assert_eq!(judged(target, error).verdict, Some(verdict), "{target}");
        }
        // Of the connectors a tenth fails before the life that nine tenths last.
        let failed = judged(3_424, 0.02).connectors_failed_at_target;
        assert!(
            (failed.expect("there is a target") - 0.1).abs() < 1e-4,
            "{failed:?}"
        );
    }

    #[test]
    fn a_life_beyond_the_run_passes_only_a_target_that_the_run_covers() {
        let (settings, scatter) = settings(1_000);
        let verdict = |done| of_unreached(&settings, Some(&scatter), done);
        assert_eq!(verdict(5_000), Some(Verdict::Pass));
        assert_eq!(verdict(4_000), Some(Verdict::Undecided));
        assert_eq!(
            of_unreached(&settings, None, 5_000),
            Some(Verdict::Undecided)
        );
        let without = LifeSettings {
            target_cycles: None,
            ..settings
        };
        assert_eq!(of_unreached(&without, Some(&scatter), 5_000), None);
    }
}
