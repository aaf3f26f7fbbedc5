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

/// Part of all contacts, or connectors, that b10 belongs to.
const TENTH: f64 = 0.1;
/// Cycles of a run with smaller coefficients over those that the product would take: its lives may be longer. Arbitrary.
const LONGER: f64 = 1.25;

/// Lives over the median one of the contacts that the ends of a band belong to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ratios {
    pub(crate) b10: f64,
    pub(crate) b90: f64,
    /// Of the first of all contacts in a tenth of all connectors.
    pub(crate) first_of_contacts_b10: f64,
}

impl Ratios {
    /// Ratios of lives in inverse proportion to the coefficients.
    pub(crate) fn of(settings: &LifeSettings) -> Self {
        let variation = settings.coefficient_of_variation.unwrap_or_default();
        let contacts = settings.contacts.unwrap_or(1);
        // Exact where the part is far below the precision of 1 - 0.9^(1/n).
        let first = -((-TENTH).ln_1p() / real(contacts)).exp_m1();
        Self {
            b10: lognormal(variation, TENTH),
            b90: lognormal(variation, 1.0 - TENTH),
            first_of_contacts_b10: lognormal(variation, first),
        }
    }

    /// In the order of [`scenes`].
    fn all(self) -> [f64; 3] {
        [self.b10, self.b90, self.first_of_contacts_b10]
    }

    /// From lives in the order of [`scenes`] over that of the median contact.
    pub(crate) fn from_scenes(ratios: [f64; 3]) -> Self {
        let [b10, b90, first_of_contacts_b10] = ratios;
        Self {
            b10,
            b90,
            first_of_contacts_b10,
        }
    }
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
    let scattered = Ratios::of(&filled.life).all().map(with);
    scattered
        .into_iter()
        .collect::<Option<_>>()
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::tests::accepted;

    fn settings(variation: f64, contacts: u64) -> LifeSettings {
        LifeSettings {
            coefficient_of_variation: Some(variation),
            contacts: Some(contacts),
            criteria: None,
        }
    }

    #[test]
    fn half_of_the_mean_as_deviation_scatters_the_life_by_a_factor_of_1_8() {
        let one = Ratios::of(&settings(0.5, 1));
        assert!((one.b10 - 0.545_87).abs() < 1e-5 && (one.b90 - 1.831_95).abs() < 1e-5);
        assert!((one.first_of_contacts_b10 - one.b10).abs() < 1e-12);
        let nine = Ratios::of(&settings(0.5, 9)).first_of_contacts_b10;
        assert!((nine - 0.342_40).abs() < 1e-5, "{nine}");
        let certain = Ratios::of(&settings(0.0, 9));
        assert!(
            certain
                .all()
                .iter()
                .all(|ratio| (ratio - 1.0).abs() < 1e-12)
        );
        assert!((median(545.87, 0.1, &settings(0.5, 1)) - 1_000.0).abs() < 0.01);
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
        let [b10, b90, first] = scene.scattered.as_slice() else {
            panic!("{} scenes", scene.scattered.len());
        };
        assert_eq!(
            [b10.cycles, b90.cycles, first.cycles],
            [1_000, 2_290, 1_000]
        );
        // The whole table, not that of the median contact.
        assert!((b90.largest_friction() - 0.6).abs() < 1e-12);
        let rate = |scene: &Scene| scene.slider.plating[0].rate_per_mpa;
        assert!((rate(b10) / rate(&scene) - 1.831_95).abs() < 1e-4);
        assert!(first.scattered.is_empty());
    }
}
