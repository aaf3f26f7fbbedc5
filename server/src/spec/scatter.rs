//! Scatter of lives by that of the wear coefficients.
//!
//! Depths depend on a wear coefficient k and the number of cycles N by their product, so that a life is N ~ 1/k: with k lognormal,
//! ln N is normal with the standard deviation s = sqrt(ln(1 + CV^2)), and a part F of all contacts lives no longer than
//!   N exp(s z(F)),  z the quantile of the normal distribution.
//! The computed life is taken as the median. Of n independent contacts the first one ends in a part 0.1 of all connectors where
//! F = 1 - 0.9^(1/n).
//!
//! The product does not decide where the friction changes by cycle or by dose, nor a resistance where films grow with the time. There the
//! run is solved with the coefficients of these contacts, too, on the settings of its first companion (`solver::error_control`).

use api::spec::{Friction, Interface, LifeSettings, Spec};
use solver::scene::Scene;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::number::{real, whole};
use crate::spec::coefficients;

/// Parts of all contacts, or connectors, that b1, b10 and b90 belong to.
const HUNDREDTH: f64 = 0.01;
const TENTH: f64 = 0.1;
/// Parts that differ by less, relatively, are one.
const SAME: f64 = 1e-9;
/// Cycles of a run with smaller coefficients over those that the product would take: its lives may be longer. Arbitrary.
const LONGER: f64 = 1.25;

/// The life that a part of all contacts does not survive.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Quantile {
    /// The part.
    failed: f64,
    /// The life over the median one.
    ratio: f64,
}

/// Lives over the median one that parts of all contacts do not survive.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scatter {
    /// In the order of their parts; the median is none of them.
    quantiles: Vec<Quantile>,
    contacts: u64,
}

impl Scatter {
    /// Of lives in inverse proportion to the coefficients.
    pub(crate) fn of(settings: &LifeSettings) -> Self {
        let variation = settings.coefficient_of_variation.unwrap_or_default();
        let contacts = settings.contacts.unwrap_or(1);
        let of_connectors = |part: f64| of_first(part, 1.0 / real(contacts));
        let mut parts = vec![HUNDREDTH, TENTH, 1.0 - TENTH, of_connectors(TENTH)];
        for share in settings.reliability.iter().flatten() {
            parts.extend([1.0 - share, of_connectors(1.0 - share)]);
        }
        parts.sort_by(f64::total_cmp);
        parts.dedup_by(|part, before| *part - *before < SAME * *part);
        let quantile = |failed| Quantile {
            failed,
            ratio: lognormal(variation, failed),
        };
        Self {
            quantiles: parts.into_iter().map(quantile).collect(),
            contacts,
        }
    }

    /// Of lives in the order of [`scenes`] over that of the median contact; `None` if there is not one for each scene.
    pub(crate) fn solved(settings: &LifeSettings, ratios: &[f64]) -> Option<Self> {
        let mut scatter = Self::of(settings);
        if ratios.len() != scatter.quantiles.len() {
            return None;
        }
        for (quantile, ratio) in scatter.quantiles.iter_mut().zip(ratios) {
            quantile.ratio = *ratio;
        }
        Some(scatter)
    }

    /// Lives over the median one of the contacts that are solved for where the product does not decide.
    fn ratios(&self) -> impl Iterator<Item = f64> {
        self.quantiles.iter().map(|quantile| quantile.ratio)
    }

    pub(crate) fn b1(&self) -> f64 {
        self.not_survived_by(HUNDREDTH)
    }

    pub(crate) fn b10(&self) -> f64 {
        self.not_survived_by(TENTH)
    }

    pub(crate) fn b90(&self) -> f64 {
        self.not_survived_by(1.0 - TENTH)
    }

    /// Life over the median one that a part of all contacts does not survive, straight in ln N over z(F) between the known ones.
    pub(crate) fn not_survived_by(&self, failed: f64) -> f64 {
        let known = self.quantiles.iter();
        let same = |quantile: &&Quantile| (quantile.failed - failed).abs() < SAME * failed;
        if let Some(quantile) = known.clone().find(same) {
            return quantile.ratio;
        }
        let points = self.points();
        let z = Normal::standard().inverse_cdf(failed);
        let [a, b] = segment(&points, |point| point.z, z);
        (a.ln_ratio + (b.ln_ratio - a.ln_ratio) * (z - a.z) / (b.z - a.z)).exp()
    }

    /// The same of all connectors, of which each fails with the first of its contacts.
    pub(crate) fn not_survived_by_connectors(&self, failed: f64) -> f64 {
        self.not_survived_by(of_first(failed, 1.0 / real(self.contacts)))
    }

    /// Part of all contacts that fails before a life over the median one.
    pub(crate) fn failed(&self, ratio: f64) -> f64 {
        let points = self.points();
        let ln_ratio = ratio.ln();
        let [a, b] = segment(&points, |point| point.ln_ratio, ln_ratio);
        let rise = b.ln_ratio - a.ln_ratio;
        if rise <= 0.0 {
            // All contacts live equally long.
            return if ln_ratio < a.ln_ratio { 0.0 } else { 1.0 };
        }
        let z = a.z + (b.z - a.z) * (ln_ratio - a.ln_ratio) / rise;
        Normal::standard().cdf(z)
    }

    /// Part of all connectors that fails while a part of all contacts does: 1 - (1 - F)^n.
    pub(crate) fn connectors_failed(&self, failed: f64) -> f64 {
        of_first(failed, real(self.contacts))
    }

    /// The known quantiles with the median.
    fn points(&self) -> Vec<Point> {
        let point = |quantile: &Quantile| Point {
            z: Normal::standard().inverse_cdf(quantile.failed),
            ln_ratio: quantile.ratio.ln(),
        };
        let mut points: Vec<Point> = self.quantiles.iter().map(point).collect();
        points.push(Point {
            z: 0.0,
            ln_ratio: 0.0,
        });
        points.sort_by(|a, b| a.z.total_cmp(&b.z));
        points.dedup_by(|point, before| point.z - before.z < SAME);
        points
    }
}

/// A quantile by its normal deviate.
#[derive(Debug, Clone, Copy)]
struct Point {
    z: f64,
    ln_ratio: f64,
}

/// The points on both sides of a value, or the two nearest ones.
fn segment(points: &[Point], of: impl Fn(&Point) -> f64, value: f64) -> [Point; 2] {
    let above = points.partition_point(|point| of(point) <= value);
    let end = above.clamp(1, points.len() - 1);
    [points[end - 1], points[end]]
}

/// Part of all groups in which one of a number of members has failed, 1 - (1 - part)^number, exact where that is small; by 1/number the part of all
/// members for that of all groups.
fn of_first(part: f64, number: f64) -> f64 {
    -(number * (-part).ln_1p()).exp_m1()
}

/// Median life of a contact of whose kind a part has failed after some cycles.
pub(crate) fn median(cycles: f64, failing: f64, settings: &LifeSettings) -> f64 {
    let variation = settings.coefficient_of_variation.unwrap_or_default();
    cycles / lognormal(variation, failing)
}

/// Cycles that a part of all contacts does not survive over the median ones.
fn lognormal(variation: f64, part: f64) -> f64 {
    let s = variation.powi(2).ln_1p().sqrt();
    (s * Normal::standard().inverse_cdf(part)).exp()
}

/// Quantities that depend on coefficient and cycles by their product.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FollowsProduct {
    pub(crate) depths: bool,
    pub(crate) resistance: bool,
}

impl FollowsProduct {
    /// Determines these quantities of a contact.
    pub(crate) fn of(interface: &Interface) -> Self {
        let changes =
            |friction: &Friction| friction.by_cycle.is_some() || friction.by_dose.is_some();
        let depths = !interface.friction.as_ref().is_some_and(changes);
        let mut films = interface.films.iter();
        Self {
            depths,
            resistance: depths && films.all(|film| film.growth_exponent.is_none()),
        }
    }
}

/// The scenes of the contacts at the ends of the band; none where the product decides. `scene_of` makes a scene of a specification.
pub(super) fn scenes(
    filled: &Spec,
    scene: &Scene,
    scene_of: impl Fn(&Spec) -> Option<Scene>,
) -> Vec<Scene> {
    let limits = scene.conduction.known();
    let has_limits = limits.is_some_and(|known| !known.life_mohm.is_empty());
    let follows = FollowsProduct::of(&filled.interface);
    let follows = (scene.life.is_empty() || follows.depths) && (!has_limits || follows.resistance);
    let variation = filled.life.coefficient_of_variation.unwrap_or_default();
    if follows || variation <= 0.0 || !scene.accuracy.estimate_errors {
        return Vec::new();
    }
    let with = |ratio: f64| {
        let mut spec = filled.clone();
        coefficients::scale(&mut spec, 1.0 / ratio);
        let longer = (LONGER * ratio).max(1.0);
        let lengthen = |count: u64| whole((longer * real(count)).ceil());
        spec.cycles = spec.cycles.map(lengthen);
        spec.repeat = spec.repeat.map(lengthen);
        // The cycles say it.
        if let Some(motion) = spec.motion.as_mut().filter(|_| spec.cycles.is_some()) {
            motion.duration_s = None;
        }
        spec.output.snapshots_at_cycles = None;
        scene_of(&spec)
    };
    let scatter = Scatter::of(&filled.life);
    let scattered = scatter.ratios().map(with);
    scattered.collect::<Option<_>>().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::tests::accepted;

    fn settings(variation: f64, contacts: u64) -> LifeSettings {
        LifeSettings {
            coefficient_of_variation: Some(variation),
            contacts: Some(contacts),
            reliability: Some(vec![0.9, 0.99]),
            ..LifeSettings::default()
        }
    }

    #[test]
    fn half_of_the_mean_as_deviation_scatters_the_life_by_a_factor_of_1_8() {
        let one = Scatter::of(&settings(0.5, 1));
        assert!((one.b10() - 0.545_87).abs() < 1e-5 && (one.b90() - 1.831_95).abs() < 1e-5);
        // exp(-2.326348 s), s = sqrt(ln 1.25) = 0.472381.
        assert!((one.b1() - 0.333_23).abs() < 1e-5, "{}", one.b1());
        assert!((one.not_survived_by_connectors(TENTH) - one.b10()).abs() < 1e-12);
        let nine = Scatter::of(&settings(0.5, 9)).not_survived_by_connectors(TENTH);
        assert!((nine - 0.342_40).abs() < 1e-5, "{nine}");
        let certain = Scatter::of(&settings(0.0, 9));
        assert!(certain.ratios().all(|ratio| (ratio - 1.0).abs() < 1e-12));
        assert!(certain.failed(0.9) < 1e-12 && certain.failed(1.1) > 1.0 - 1e-12);
        assert!((median(545.87, 0.1, &settings(0.5, 1)) - 1_000.0).abs() < 0.01);
    }

    /// Between and beyond the known parts as well: the logarithm of a lognormal life is straight over the normal deviate.
    #[test]
    fn parts_that_fail_are_those_of_the_distribution() {
        let scatter = Scatter::of(&settings(0.5, 9));
        for failed in [1e-6, 3e-3, 0.01, 0.05, 0.3, 0.5, 0.7, 0.97, 0.9999] {
            let ratio = scatter.not_survived_by(failed);
            assert!(
                (ratio / lognormal(0.5, failed) - 1.0).abs() < 1e-6,
                "{failed}"
            );
            assert!(
                (scatter.failed(ratio) / failed - 1.0).abs() < 1e-6,
                "{failed}"
            );
        }
        let tenth = scatter.failed(scatter.not_survived_by_connectors(TENTH));
        assert!((scatter.connectors_failed(tenth) - TENTH).abs() < 1e-9);
        // Of lives that were solved for.
        let solved = Scatter::solved(&settings(0.5, 1), &[0.4, 0.6, 1.5]).expect("three parts");
        let found = [solved.b1(), solved.b10(), solved.b90()];
        let same = found.iter().zip([0.4, 0.6, 1.5]);
        assert!(
            same.into_iter().all(|(a, b)| (a - b).abs() < 1e-12),
            "{found:?}"
        );
        assert!((solved.failed(0.6) - 0.1).abs() < 1e-9 && (solved.failed(1.0) - 0.5).abs() < 1e-9);
        assert_eq!(Scatter::solved(&settings(0.5, 1), &[0.4]), None);
    }

    #[test]
    fn contacts_are_solved_for_where_friction_changes_by_cycle() {
        let text = |friction: &str| {
            format!(
                r#"{{"system":{{"kind":"sd_card"}},"cycles":1000,"interface":{{"friction":{{"law":"coulomb",{friction}}}}}}}"#
            )
        };
        let constant = accepted(&text(r#""coefficient":0.3"#)).scene;
        assert!(constant.scattered.is_empty());
        let table =
            r#""by_cycle":[{"cycle":0,"coefficient":0.2},{"cycle":1200,"coefficient":0.6}]"#;
        let scene = accepted(&text(table)).scene;
        let [b1, b10, b90] = scene.scattered.as_slice() else {
            panic!("{} scenes", scene.scattered.len());
        };
        assert_eq!([b1.cycles, b10.cycles, b90.cycles], [1_000, 1_000, 2_290]);
        // The whole table, not that of the median contact.
        assert!((b90.largest_friction() - 0.6).abs() < 1e-12);
        let rate = |scene: &Scene| scene.slider.plating[0].rate_per_mpa;
        assert!((rate(b10) / rate(&scene) - 1.831_95).abs() < 1e-4);
        assert!(b1.scattered.is_empty());
    }
}
