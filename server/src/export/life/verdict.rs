//! Verdict on the target of a specification.
//!
//! A connector of n contacts lasts in a share R of all where its life at R, that of the first of its contacts, is at least the target. The
//! error e of the computed life leaves a ratio of both between 1/(1 + e) and 1/(1 - e) open: the estimated error, or the tolerance where there is none.

use api::results::{LifeAtReliability, LifeEntry, Verdict};
use api::spec::LifeSettings;

use crate::number::real;
use crate::spec::scatter::Scatter;

/// The lives of the contacts of a criterion.
#[derive(Clone, Copy)]
pub(super) struct Lives<'a> {
    pub(super) settings: &'a LifeSettings,
    /// Their scatter, if it is known.
    pub(super) scatter: Option<&'a Scatter>,
    pub(super) tolerance: f64,
}

/// States lives at each share of the reliability, and the verdict on the target, of a life that was reached, in its unit.
pub(super) fn judge(entry: &mut LifeEntry, lives: Lives<'_>, life: f64) {
    let target = lives.settings.target_cycles.map(real);
    if let Some(scatter) = lives.scatter {
        let failed = target.map(|target| scatter.failed(target / life));
        entry.share_failed_at_target = failed;
        entry.connectors_failed_at_target = failed.map(|failed| scatter.connectors_failed(failed));
    }
    entry.at_reliability = lives.at_reliability(life);
    let error = entry.estimated_relative_error.unwrap_or(lives.tolerance);
    entry.verdict = target.map(|_| verdict(&entry.at_reliability, error));
}

/// The verdict on a life that is longer than a run of so many cycles: it does not fail by that.
pub(super) fn of_unreached(lives: Lives<'_>, done: u64) -> Option<Verdict> {
    lives.settings.target_cycles?;
    let shortest = lives.at_reliability(real(done));
    Some(match verdict(&shortest, lives.tolerance) {
        Verdict::Fail => Verdict::Undecided,
        verdict => verdict,
    })
}

/// The verdict on lives of a relative error.
fn verdict(lives: &[LifeAtReliability], error: f64) -> Verdict {
    let margins = lives.iter().filter_map(|at| at.margin);
    match margins.reduce(f64::min) {
        Some(margin) if margin * (1.0 - error) >= 1.0 => Verdict::Pass,
        Some(margin) if margin * (1.0 + error) < 1.0 => Verdict::Fail,
        _ => Verdict::Undecided,
    }
}

impl Lives<'_> {
    /// Lives at each share, of a life of the median contact; none without a scatter.
    fn at_reliability(self, life: f64) -> Vec<LifeAtReliability> {
        let Some(scatter) = self.scatter else {
            return Vec::new();
        };
        let target = self.settings.target_cycles.map(real);
        let shares = self.settings.reliability.iter().flatten();
        let at = |share: &f64| {
            let failed = 1.0 - share;
            let of_contacts = scatter.not_survived_by_connectors(failed) * life;
            LifeAtReliability {
                share: *share,
                cycles: scatter.not_survived_by(failed) * life,
                of_contacts,
                margin: target.map(|target| of_contacts / target),
            }
        };
        shares.map(at).collect()
    }
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

    /// Lives of a run at 2 %.
    fn lives<'a>(settings: &'a LifeSettings, scatter: Option<&'a Scatter>) -> Lives<'a> {
        Lives {
            settings,
            scatter,
            tolerance: 0.02,
        }
    }

    /// The verdict on a life of 10 000 cycles of this error, of which nine contacts last 2359 in 99 % of all connectors.
    fn judged(target: u64, error: f64) -> LifeEntry {
        let (settings, scatter) = settings(target);
        let criteria = settings.criteria.clone().expect("there are some");
        let mut entry = LifeEntry {
            estimated_relative_error: Some(error),
            ..super::super::empty(&criteria[0], LifeStatus::Reached)
        };
        judge(&mut entry, lives(&settings, Some(&scatter)), 10_000.0);
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
        let verdict = |done| of_unreached(lives(&settings, Some(&scatter)), done);
        assert_eq!(verdict(5_000), Some(Verdict::Pass));
        // 4 239 cycles without the error.
        assert_eq!(verdict(4_300), Some(Verdict::Undecided));
        assert_eq!(verdict(4_000), Some(Verdict::Undecided));
        let unknown = of_unreached(lives(&settings, None), 5_000);
        assert_eq!(unknown, Some(Verdict::Undecided));
        let without = LifeSettings {
            target_cycles: None,
            ..settings
        };
        assert_eq!(of_unreached(lives(&without, Some(&scatter)), 5_000), None);
    }

    #[test]
    fn a_life_without_an_estimated_error_has_the_tolerance_of_the_run() {
        let (settings, scatter) = settings(2_330);
        let criteria = settings.criteria.clone().expect("there are some");
        let mut entry = super::super::empty(&criteria[0], LifeStatus::Reached);
        // 1.2 % above the target.
        judge(&mut entry, lives(&settings, Some(&scatter)), 10_000.0);
        assert_eq!(entry.verdict, Some(Verdict::Undecided));
    }
}
