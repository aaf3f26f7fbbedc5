//! Life documents: the cycles to each criterion with their scatter.
//!
//! Depths depend on a wear coefficient k and the number of cycles N by their product, so that a life is N ~ 1/k: with k lognormal,
//! ln N is normal with the standard deviation s = sqrt(ln(1 + CV^2)), and a part F of all contacts lives no longer than
//!   N exp(s z(F)),  z the quantile of the normal distribution.
//! The computed life is taken as the median. Of n independent contacts the first one ends in a part 0.1 of all connectors where
//! F = 1 - 0.9^(1/n).

use api::results::{LifeBand, LifeEntry, LifeStatus};
use api::spec::{Criterion, CriterionKind, EnumValue, LifeSettings};
use solver::record::{CriterionState, Life};
use solver::scene::{Motion, Scene};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::number::real;

const SECONDS_PER_HOUR: f64 = 3_600.0;

/// Part of all contacts, or connectors, that b10 belongs to.
const TENTH: f64 = 0.1;

/// Life by the criteria of resolved settings. A criterion of the resistance is not modelled where something is lacking.
pub(crate) fn entries(
    (settings, resistance_lacks): (&LifeSettings, &[String]),
    scene: &Scene,
    life: &Life,
    done: u64,
) -> Vec<LifeEntry> {
    let (mut states, mut resistances) = (life.criteria.iter(), life.resistance.iter());
    let criteria = settings.criteria.iter().flatten();
    criteria
        .map(|criterion| {
            let state = match criterion.kind {
                EnumValue::Known(CriterionKind::Resistance) => resistances.next(),
                _ => states.next(),
            };
            match state {
                Some(state) => entry(settings, scene, (criterion, state), done),
                None => not_modelled(criterion, resistance_lacks),
            }
        })
        .collect()
}

fn not_modelled(criterion: &Criterion, lacks: &[String]) -> LifeEntry {
    let lacks = if lacks.is_empty() {
        "a computed cycle".to_owned()
    } else {
        lacks.join(", ")
    };
    LifeEntry {
        reason: Some(format!(
            "the contact resistance is not modelled: it needs {lacks}"
        )),
        ..empty(criterion, LifeStatus::NotModelled)
    }
}

fn empty(criterion: &Criterion, status: LifeStatus) -> LifeEntry {
    let side = match &criterion.side {
        Some(EnumValue::Known(part)) => Some(part.as_str().to_owned()),
        _ => None,
    };
    LifeEntry {
        criterion: criterion.clone(),
        side,
        status,
        cycles: None,
        repetitions: None,
        sliding_distance_mm: None,
        duration_h: None,
        estimated_relative_error: None,
        band: None,
        value: None,
        limit: None,
        reason: None,
    }
}

fn entry(
    settings: &LifeSettings,
    scene: &Scene,
    (criterion, state): (&Criterion, &CriterionState),
    done: u64,
) -> LifeEntry {
    let measured = |status| LifeEntry {
        value: Some(state.value),
        limit: Some(state.limit),
        ..empty(criterion, status)
    };
    let Some(cycles) = state.cycles else {
        let share = 100.0 * state.value / state.limit;
        let reason = match scene.motion {
            Motion::Reciprocating { .. } | Motion::Periodic { .. } => {
                format!("{share:.1} % of the limit after {done} cycles")
            }
            Motion::Continuous { step_mm } => {
                format!(
                    "{share:.1} % of the limit after {} mm",
                    step_mm * real(done)
                )
            }
        };
        return LifeEntry {
            reason: Some(reason),
            ..measured(LifeStatus::NotReached)
        };
    };
    let is_resistance = criterion.kind == EnumValue::Known(CriterionKind::Resistance);
    let by_wear = !(is_resistance && has_growing_film(scene));
    let (distance_mm, seconds) = scene.elapsed(cycles);
    let mission = scene.mission.as_ref();
    // The parts of a continuous motion are no cycles of the user.
    let (counted, measure) = match scene.motion {
        Motion::Reciprocating { .. } | Motion::Periodic { .. } => (Some(cycles), cycles),
        Motion::Continuous { .. } => (None, distance_mm),
    };
    LifeEntry {
        cycles: counted,
        repetitions: mission.map(|mission| cycles / real(mission.cycles())),
        sliding_distance_mm: Some(distance_mm),
        duration_h: seconds.map(|seconds| seconds / SECONDS_PER_HOUR),
        estimated_relative_error: state.error,
        band: by_wear.then(|| {
            band(
                measure,
                settings.coefficient_of_variation.unwrap_or_default(),
                settings.contacts.unwrap_or(1),
            )
        }),
        reason: (!by_wear).then(|| {
            "no band: a film that grows with the time makes the life depend on more than the product of coefficient and cycles"
                .to_owned()
        }),
        ..measured(LifeStatus::Reached)
    }
}

/// Whether the resistance depends on the time.
fn has_growing_film(scene: &Scene) -> bool {
    let electrical = scene.conduction.known().into_iter();
    let mut metals =
        electrical.flat_map(|known| known.metals.slider.iter().chain(&known.metals.receptacle));
    metals.any(|metal| metal.film.is_some_and(|film| film.growth.is_some()))
}

/// Lives of the first tenth and of nine tenths of all contacts over the median one; `None` where the coefficients are certain.
pub(crate) fn scatter(settings: &LifeSettings) -> Option<[f64; 2]> {
    let variation = settings.coefficient_of_variation?;
    let ends = [TENTH, 1.0 - TENTH].map(|part| lognormal(variation, part));
    (variation > 0.0).then_some(ends)
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

/// The scatter of a life for a coefficient of variation of k and a number of independent contacts.
fn band(cycles: f64, variation: f64, contacts: u64) -> LifeBand {
    let part = |part: f64| cycles * lognormal(variation, part);
    // Exact where the part is far below the precision of 1 - 0.9^(1/n).
    let first = -((-TENTH).ln_1p() / real(contacts)).exp_m1();
    LifeBand {
        b10: part(TENTH),
        b50: cycles,
        b90: part(1.0 - TENTH),
        first_of_contacts_b10: part(first),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_mean_as_deviation_scatters_the_life_by_a_factor_of_1_8() {
        let band_of = |contacts| band(1_000.0, 0.5, contacts);
        let LifeBand { b10, b50, b90, .. } = band_of(1);
        assert!(
            (b10 - 545.87).abs() < 0.01 && (b90 - 1_831.95).abs() < 0.01,
            "{b10} {b90}"
        );
        assert!((b50 - 1_000.0).abs() < 1e-12);
        assert!((band_of(1).first_of_contacts_b10 - b10).abs() < 1e-9);
        let nine = band_of(9).first_of_contacts_b10;
        assert!((nine - 342.40).abs() < 0.01, "{nine}");
        let certain = band(1_000.0, 0.0, 9);
        assert!((certain.b10 - 1_000.0).abs() < 1e-9 && (certain.b90 - 1_000.0).abs() < 1e-9);
    }
}
