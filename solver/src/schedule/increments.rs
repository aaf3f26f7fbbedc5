//! Increments of a cycle: from turning point to turning point, +A -> -A -> +A, in equal steps of displacement.
//!
//! A cycle that began in the middle would begin and end with half a pass, and the halves would differ where the cycle
//! jump changes: a step would remain in the middle of the scar.
//!
//! Nothing in the contact problem depends on time, so steps are equal in displacement whatever the wave. A step
//! must stay a fraction of the contact's half-width, or its wear would leave ripples.

use crate::number::{count_at_least, real};
use crate::scene::{Accuracy, Motion};

/// Named positions of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// Slider at x = 0 on its way to +x.
    Neutral,
    /// Slider at its rightmost position.
    Rightmost,
    /// Slider at its leftmost position.
    Leftmost,
}

/// Most steps a quarter of a cycle: an arbitrary bound on the length of a computed cycle.
const MOST_STEPS: usize = 50_000;

/// One increment of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    /// Displacement of the slider at its end, mm.
    pub(crate) slider_x: f64,
    /// Additional slip of the slider's surface that does not move the contact, mm.
    pub(crate) surface_slip: f64,
    /// The named position at its end, if there is one.
    pub(crate) at: Option<Position>,
}

/// Number of increments of one cycle for a contact of a half-width, mm, part of which may stick through the whole stroke.
pub(crate) fn count(motion: Motion, accuracy: &Accuracy, contact: (f64, bool)) -> usize {
    match motion {
        Motion::Continuous { .. } => 1,
        Motion::Reciprocating { amplitude_mm, .. } => {
            4 * steps_per_quarter(accuracy, amplitude_mm, contact)
        }
    }
}

/// Indices of the increments, of so many in a cycle, that end at a named position.
pub(crate) fn named(count: usize) -> [usize; 3] {
    [2, 3, 4].map(|quarters| (quarters * (count / 4)).saturating_sub(1))
}

/// The increments of one cycle, so many if the motion reciprocates.
pub(crate) fn steps(motion: Motion, count: usize) -> Vec<Step> {
    match motion {
        Motion::Continuous { step_mm } => {
            vec![Step {
                slider_x: 0.0,
                surface_slip: step_mm,
                at: Some(Position::Neutral),
            }]
        }
        Motion::Reciprocating { amplitude_mm, .. } => there_and_back(amplitude_mm, count / 4),
    }
}

/// Whether a step is the first one after a turning point.
pub(crate) fn begins_a_stroke(steps: &[Step], step: usize) -> bool {
    match step.checked_sub(1) {
        Some(before) => steps[before].at == Some(Position::Leftmost),
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

fn steps_per_quarter(
    accuracy: &Accuracy,
    amplitude: f64,
    (half_width, sticks): (f64, bool),
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
        Some(given) => count_at_least(0.25 * refinement.increments * f64::from(given)),
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

    const CONTACT: (f64, bool) = (0.1, false);

    fn places(steps: &[Step]) -> Vec<f64> {
        steps.iter().map(|step| step.slider_x).collect()
    }

    #[test]
    fn a_cycle_goes_from_turning_point_to_turning_point() {
        let motion = Motion::Reciprocating {
            amplitude_mm: 2.0,
            period_s: 1.0,
        };
        let steps = steps(motion, count(motion, &ACCURACY, CONTACT));
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
        let places = places(&steps(motion, count(motion, &accuracy, CONTACT)));
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
            count(motion, &accuracy, CONTACT)
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
