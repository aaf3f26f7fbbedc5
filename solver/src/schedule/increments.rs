//! Increments of a cycle: from turning point to turning point, +A -> -A -> +A, in equal steps of displacement.
//!
//! A cycle that began in the middle would begin and end with half a pass, and the halves would differ where the cycle
//! jump changes: a step would remain in the middle of the scar.
//!
//! Nothing in the contact problem depends on time, so steps are equal in displacement whatever the wave. A step
//! must stay a fraction of the contact's half-width, or its wear would leave ripples.

use super::step::{MOST_STEPS, Named, Step};
use super::turning_steps;
use crate::number::{count_at_least, real};
use crate::scene::{Accuracy, Motion};

pub use super::step::Position;

/// Amplitude over the path of a cycle of a reciprocating motion.
const QUARTER: f64 = 0.25;

/// Number of increments of one cycle for a contact of a half-width, mm, part of which may stick through the whole stroke.
pub(crate) fn count(motion: Motion, accuracy: &Accuracy, half_width: f64, sticks: bool) -> usize {
    match motion {
        Motion::Continuous { .. } => 1,
        Motion::Reciprocating { amplitude_mm, .. } => {
            4 * steps_per_quarter(accuracy, amplitude_mm, QUARTER, half_width, sticks)
        }
        Motion::Periodic { turns, .. } => {
            let amplitude = turns.amplitude_mm().abs();
            let share = amplitude / turns.path_mm();
            let quarter = steps_per_quarter(accuracy, amplitude, share, half_width, sticks);
            turning_steps::count(&turns, quarter)
        }
    }
}

/// The leftmost, the neutral and the rightmost position in a cycle of so many increments.
pub(crate) fn named(motion: Motion, count: usize) -> [Named; 3] {
    match motion {
        Motion::Periodic { turns, .. } => turning_steps::named(&turns, count),
        Motion::Reciprocating { .. } | Motion::Continuous { .. } => {
            [2, 3, 4].map(|quarters| Named {
                from: 0,
                end: (quarters * (count / 4)).saturating_sub(1),
            })
        }
    }
}

/// The increments of one cycle, so many if the motion is not continuous.
pub(crate) fn steps(motion: Motion, count: usize) -> Vec<Step> {
    match motion {
        Motion::Continuous { step_mm } => {
            vec![Step {
                slider_x: 0.0,
                surface_slip: step_mm,
                at: Some(Position::Neutral),
                stroke: 0,
            }]
        }
        Motion::Reciprocating { amplitude_mm, .. } => there_and_back(amplitude_mm, count / 4),
        Motion::Periodic { turns, .. } => turning_steps::steps(&turns, count),
    }
}

/// Returns `true` if a step is the first one after a turning point.
pub(crate) fn begins_a_stroke(steps: &[Step], step: usize) -> bool {
    match step.checked_sub(1) {
        Some(before) => steps[before].stroke != steps[step].stroke,
        None => steps.len() > 1,
    }
}

/// The steps of the initial quarter, from the neutral position to the turning point where cycles begin.
pub(crate) fn initial_quarter(steps: &[Step]) -> &[Step] {
    let neutral = steps
        .iter()
        .rposition(|step| step.at == Some(Position::Neutral));
    match neutral {
        Some(last) if last + 1 < steps.len() => &steps[last + 1..],
        _ => steps,
    }
}

/// The steps of the first quarter of a cycle, from the turning point where it begins to the neutral position.
pub(crate) fn first_quarter(steps: &[Step]) -> &[Step] {
    &steps[..steps.len() / 4]
}

/// Steps over the amplitude of a motion, which is a share of its path in a cycle.
fn steps_per_quarter(
    accuracy: &Accuracy,
    amplitude: f64,
    share: f64,
    half_width: f64,
    sticks: bool,
) -> usize {
    let Accuracy {
        tolerance,
        tuning,
        refinement,
        ..
    } = accuracy;
    let fewest = if sticks {
        tuning.sticking_steps_per_quarter
    } else {
        tuning.steps_per_quarter
    };
    let fewest = fewest.at(*tolerance) * refinement.increments;
    match accuracy.increments_per_cycle {
        Some(given) => count_at_least(share * refinement.increments * f64::from(given)),
        // Without a contact there is nothing to resolve.
        None if half_width <= 0.0 => count_at_least(fewest.round()),
        None => {
            let long = amplitude / accuracy.largest_step(half_width);
            let short = long / tuning.short_step;
            let short = if sticks { 0.0 } else { short };
            count_at_least(long.max(short.min(2.0 * fewest))).max(count_at_least(fewest.round()))
        }
    }
    .clamp(1, MOST_STEPS)
}

/// +A -> -A -> +A.
fn there_and_back(amplitude: f64, quarter: usize) -> Vec<Step> {
    (1..=4 * quarter)
        .map(|i| Step {
            slider_x: amplitude * (real(i.abs_diff(2 * quarter)) / real(quarter) - 1.0),
            surface_slip: 0.0,
            at: match i {
                i if i == 2 * quarter => Some(Position::Leftmost),
                i if i == 3 * quarter => Some(Position::Neutral),
                i if i == 4 * quarter => Some(Position::Rightmost),
                _ => None,
            },
            stroke: usize::from(i > 2 * quarter),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Refinement;

    const ACCURACY: Accuracy = Accuracy {
        increments_per_cycle: Some(8),
        ..Accuracy::from_tolerance(0.02)
    };

    const HALF_WIDTH: f64 = 0.1;

    fn places(steps: &[Step]) -> Vec<f64> {
        steps.iter().map(|step| step.slider_x).collect()
    }

    #[test]
    fn a_cycle_goes_from_turning_point_to_turning_point() {
        let motion = Motion::Reciprocating {
            amplitude_mm: 2.0,
            period_s: 1.0,
        };
        let steps = steps(motion, count(motion, &ACCURACY, HALF_WIDTH, false));
        assert_eq!(
            places(&steps),
            vec![1.0, 0.0, -1.0, -2.0, -1.0, 0.0, 1.0, 2.0]
        );
        assert_eq!(steps[3].at, Some(Position::Leftmost));
        assert_eq!(steps[5].at, Some(Position::Neutral));
        assert_eq!(places(initial_quarter(&steps)), vec![1.0, 2.0]);
    }

    #[test]
    fn steps_stay_below_half_the_contact() {
        let accuracy = Accuracy {
            increments_per_cycle: None,
            ..ACCURACY
        };
        let motion = Motion::Reciprocating {
            amplitude_mm: 2.0,
            period_s: 1.0,
        };
        let places = places(&steps(motion, count(motion, &accuracy, HALF_WIDTH, false)));
        assert!(
            places
                .windows(2)
                .all(|w| (w[1] - w[0]).abs() <= 0.05 + 1e-12)
        );
        assert!(places.len().is_multiple_of(4));
    }

    #[test]
    fn refined_increments_are_in_proportion_also_where_they_are_given() {
        let motion = Motion::Reciprocating {
            amplitude_mm: 2.0,
            period_s: 1.0,
        };
        let count = |given, increments| {
            let refinement = Refinement {
                increments,
                ..Refinement::NONE
            };
            let accuracy = Accuracy {
                increments_per_cycle: given,
                refinement,
                ..ACCURACY
            };
            count(motion, &accuracy, HALF_WIDTH, false)
        };
        assert_eq!((count(Some(8), 1.0), count(Some(8), 2.0)), (8, 16));
        assert_eq!((count(None, 1.0), count(None, 0.25)), (400, 100));
    }

    #[test]
    fn a_continuous_motion_stays_where_it_is() {
        let steps = steps(Motion::Continuous { step_mm: 0.3 }, 1);
        assert_eq!((steps.len(), places(&steps)), (1, vec![0.0]));
        assert_eq!(initial_quarter(&steps), steps);
    }
}
