//! Life documents: the cycles to each criterion with their scatter (`spec::scatter`).

use api::results::{LifeBand, LifeEntry, LifeStatus};
use api::spec::{Criterion, CriterionKind, EnumValue, LifeSettings};
use solver::record::{CriterionState, Life};
use solver::scene::{Motion, Scene};

use crate::number::real;
use crate::spec::scatter::{FollowsProduct, Ratios};

const SECONDS_PER_HOUR: f64 = 3_600.0;

const NO_BAND: &str = "no band: the life does not follow the product of coefficient and cycles, and errors are not estimated, or a contact of \
                       the band has not reached the criterion";

/// Life by the criteria of resolved settings. A criterion of the resistance is not modelled where something is lacking.
pub(crate) fn entries(
    settings: &LifeSettings,
    follows: FollowsProduct,
    resistance_lacks: &[String],
    scene: &Scene,
    life: &Life,
    done: u64,
) -> Vec<LifeEntry> {
    let (mut states, mut resistances) = (
        numbered(&life.criteria, 0),
        numbered(&life.resistance, life.criteria.len()),
    );
    let criteria = settings.criteria.iter().flatten();
    criteria
        .map(|criterion| {
            let state = match criterion.kind {
                EnumValue::Known(CriterionKind::Resistance) => resistances.next(),
                _ => states.next(),
            };
            match state {
                Some((number, state)) => {
                    let ratios = ratios(settings, follows, criterion, || {
                        let of_scenes = life.scattered.iter();
                        of_scenes
                            .map(|lives| lives.get(number).copied().flatten())
                            .collect()
                    });
                    entry(scene, ratios, criterion, state, done)
                }
                None => not_modelled(criterion, resistance_lacks),
            }
        })
        .collect()
}

/// States with their numbers among all criteria.
fn numbered(
    states: &[CriterionState],
    first: usize,
) -> impl Iterator<Item = (usize, &CriterionState)> {
    (first..).zip(states)
}

/// Lives over that of the median contact: by the product of coefficient and cycles where that decides, or those that were solved for.
fn ratios(
    settings: &LifeSettings,
    follows: FollowsProduct,
    criterion: &Criterion,
    solved: impl Fn() -> Option<Vec<f64>>,
) -> Option<Ratios> {
    let is_resistance = criterion.kind == EnumValue::Known(CriterionKind::Resistance);
    let follows = if is_resistance {
        follows.resistance
    } else {
        follows.depths
    };
    if follows
        || settings
            .coefficient_of_variation
            .is_none_or(|variation| variation <= 0.0)
    {
        return Some(Ratios::of(settings));
    }
    solved()?.try_into().ok().map(Ratios::from_scenes)
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
    scene: &Scene,
    ratios: Option<Ratios>,
    criterion: &Criterion,
    state: &CriterionState,
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
        band: ratios.map(|ratios| band(measure, ratios)),
        reason: ratios.is_none().then(|| NO_BAND.to_owned()),
        ..measured(LifeStatus::Reached)
    }
}

/// The scatter of a life, in its unit.
fn band(life: f64, ratios: Ratios) -> LifeBand {
    LifeBand {
        b10: ratios.b10 * life,
        b50: life,
        b90: ratios.b90 * life,
        first_of_contacts_b10: ratios.first_of_contacts_b10 * life,
    }
}
