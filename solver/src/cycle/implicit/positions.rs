//! Positions of the slider at which the contacts of a cycle are solved.
//!
//! Both passes wear a place alike but for friction, so that each is solved at every other position: that toward -x at those with an even
//! number, both turning points among them, that toward +x between them. Weights are those of the trapezoidal rule and of the
//! midpoints: each pass has the path of the stroke. Positions are as far apart as increments, so that there are half as many.

use crate::contact::PassPosition;
use crate::number::real;

/// A position and the path in mm that it stands for in a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CyclePosition {
    pub(super) at: PassPosition,
    pub(super) path: f64,
}

/// Number of positions of a cycle of so many increments: odd, those between both turning points and these.
pub(crate) fn count(increments: usize) -> usize {
    2 * increments.div_ceil(4) + 1
}

/// So many positions from the rightmost to the leftmost one.
pub(super) fn positions(amplitude: f64, count: usize, reference_height: f64) -> Vec<CyclePosition> {
    let intervals = real(count - 1);
    let distance = 2.0 * amplitude / intervals;
    let position = |number: usize| {
        let is_end = number == 0 || number + 1 == count;
        let is_toward_left = number.is_multiple_of(2);
        CyclePosition {
            at: PassPosition {
                slider_x: amplitude * (1.0 - 2.0 * real(number) / intervals),
                direction: if is_toward_left { -1.0 } else { 1.0 },
                reference_height,
            },
            path: if is_end { distance } else { 2.0 * distance },
        }
    };
    (0..count).map(position).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pass_has_the_path_of_the_stroke() {
        for intervals in [2, 4, 10, 34] {
            let positions = positions(0.02, intervals + 1, 0.0);
            let path = |direction: f64| {
                let pass = positions
                    .iter()
                    .filter(|p| p.at.direction * direction > 0.0);
                pass.map(|position| position.path).sum::<f64>()
            };
            assert!((path(1.0) - 0.04).abs() < 1e-15);
            assert!((path(-1.0) - 0.04).abs() < 1e-15);
        }
    }

    #[test]
    fn more_increments_have_more_positions() {
        assert_eq!([4, 20, 24, 200].map(count), [3, 11, 13, 101]);
    }
}
