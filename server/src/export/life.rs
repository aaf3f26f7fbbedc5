//! Life documents: the cycles to each criterion with their scatter (`spec::scatter`).

mod verdict;

use api::results::{LifeBand, LifeEntry, LifeStatus, Verdict};
use api::spec::{Criterion, CriterionKind, EnumValue, LifeSettings};
use solver::record::{CriterionState, Life};
use solver::scene::{Motion, Scene};

use crate::number::real;
use crate::spec::scatter::{FollowsProduct, Scatter};
use verdict::Lives;

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
                    let scatter = scatter(settings, follows, criterion, || {
                        let of_scenes = life.scattered.iter();
                        of_scenes
                            .map(|lives| lives.get(number).copied().flatten())
                            .collect()
                    });
                    let of_run = OfRun {
                        scene,
                        settings,
                        done,
                    };
                    entry(of_run, scatter.as_ref(), criterion, state)
                }
                None => LifeEntry {
                    verdict: settings.target_cycles.map(|_| Verdict::NotModelled),
                    ..not_modelled(criterion, resistance_lacks)
                },
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
fn scatter(
    settings: &LifeSettings,
    follows: FollowsProduct,
    criterion: &Criterion,
    solved: impl Fn() -> Option<Vec<f64>>,
) -> Option<Scatter> {
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
        return Some(Scatter::of(settings));
    }
    Scatter::solved(settings, &solved()?)
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
        at_reliability: Vec::new(),
        share_failed_at_target: None,
        connectors_failed_at_target: None,
        verdict: None,
        value: None,
        limit: None,
        reason: None,
    }
}

/// The run and the settings of all criteria.
#[derive(Clone, Copy)]
struct OfRun<'a> {
    scene: &'a Scene,
    settings: &'a LifeSettings,
    /// Cycles of the run.
    done: u64,
}

fn entry(
    of_run: OfRun<'_>,
    scatter: Option<&Scatter>,
    criterion: &Criterion,
    state: &CriterionState,
) -> LifeEntry {
    let OfRun {
        scene,
        settings,
        done,
    } = of_run;
    let lives = Lives {
        settings,
        scatter,
        tolerance: scene.accuracy.tolerance,
    };
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
            verdict: verdict::of_unreached(lives, done),
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
    let mut entry = LifeEntry {
        cycles: counted,
        repetitions: mission.map(|mission| cycles / real(mission.cycles())),
        sliding_distance_mm: Some(distance_mm),
        duration_h: seconds.map(|seconds| seconds / SECONDS_PER_HOUR),
        estimated_relative_error: state.error,
        band: scatter.map(|scatter| band(measure, scatter)),
        reason: scatter.is_none().then(|| NO_BAND.to_owned()),
        ..measured(LifeStatus::Reached)
    };
    verdict::judge(&mut entry, lives, measure);
    entry
}

/// The scatter of a life, in its unit.
fn band(life: f64, scatter: &Scatter) -> LifeBand {
    LifeBand {
        b1: Some(scatter.b1() * life),
        b10: scatter.b10() * life,
        b50: life,
        b90: scatter.b90() * life,
        first_of_contacts_b10: scatter.not_survived_by_connectors(0.1) * life,
    }
}
