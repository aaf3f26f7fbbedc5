//! Where increments end: from turning point to turning point, +A -> -A -> +A, in equal steps of displacement.
//!
//! A cycle that began in the middle would begin and end with half a pass, and where the cycle jump changes the two
//! halves would not fit: a step would stay in the middle of the scar.
//!
//! Nothing in the contact problem depends on time, so steps are equal in displacement whatever the wave. A step
//! must stay a fraction of the contact's half-width, or the wear that it sweeps would leave ripples.

use crate::number::{count_at_least, real};
use crate::scene::Accuracy;

/// Largest step over the contact's half-width, and fewest steps a quarter of a cycle, by tolerance.
fn rule(tolerance: f64) -> (f64, usize) {
    match tolerance {
        t if t > 0.05 => (1.0, 3),
        t if t > 0.01 => (0.5, 5),
        _ => (0.25, 10),
    }
}

/// Most steps a quarter of a cycle: beyond, a cycle takes longer than anyone would wait.
const MOST_STEPS: usize = 50_000;

/// Displacements at which the increments of one cycle end, mm, a multiple of four: the leftmost place is after one
/// half, the neutral one on the way to +x after three quarters.
pub(super) fn targets(accuracy: &Accuracy, amplitude: f64, half_width: f64) -> Vec<f64> {
    let (fraction, fewest) = rule(accuracy.tolerance);
    let quarter = match accuracy.increments_per_cycle {
        Some(n) => usize::try_from(n).unwrap_or(MOST_STEPS).div_ceil(4),
        None => count_at_least(amplitude / (fraction * half_width.max(1e-12))).max(fewest),
    }
    .clamp(1, MOST_STEPS);
    (1..=4 * quarter)
        .map(|i| amplitude * (real(i.abs_diff(2 * quarter)) / real(quarter) - 1.0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACCURACY: Accuracy = Accuracy {
        tolerance: 0.02,
        contact_element_mm: None,
        increments_per_cycle: Some(8),
        cycle_jump: None,
    };

    #[test]
    fn a_cycle_goes_from_turning_point_to_turning_point() {
        let targets = targets(&ACCURACY, 2.0, 0.1);
        assert_eq!(targets, vec![1.0, 0.0, -1.0, -2.0, -1.0, 0.0, 1.0, 2.0]);
    }

    #[test]
    fn steps_stay_below_half_the_contact() {
        let accuracy = Accuracy {
            increments_per_cycle: None,
            ..ACCURACY
        };
        let targets = targets(&accuracy, 2.0, 0.1);
        assert!(
            targets
                .windows(2)
                .all(|w| (w[1] - w[0]).abs() <= 0.05 + 1e-12)
        );
        assert!(targets.len().is_multiple_of(4));
    }
}
