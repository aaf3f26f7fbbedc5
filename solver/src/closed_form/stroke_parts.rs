//! Parts of a stroke in which a contact has one pressure.
//!
//! A long stroke wears a groove that is even but for its ends: the contact sees the same shapes all along it. Some half-lengths of the
//! contact from the turning point parts begin to be longer, the more so the farther away.

use crate::number::{nearest, real};

/// Distance from the turning point over the half-length of the contact from which on parts are longer. Arbitrary: with 1.5 and 4 a stroke of 25
/// half-lengths has 15 and 25 pressures instead of 19, and wears the same within 0.1 %.
const EVEN_FROM: f64 = 2.5;

/// Lengths of the parts, all in one unit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrokeParts {
    /// Length of a part near the turning point.
    pub(crate) length: f64,
    /// Half-length of the contact.
    pub(crate) half_length: f64,
    /// Length of a part over its distance from where parts are longer (`PointAccuracy::part_over_distance`).
    pub(crate) part_over_distance: f64,
}

impl StrokeParts {
    /// Lengths near the turning point that the part so far from it has.
    pub(crate) fn lengths(&self, from_end: f64) -> usize {
        let beyond = from_end - EVEN_FROM * self.half_length;
        let lengths = self.part_over_distance * beyond.max(0.0) / self.length;
        nearest(lengths.floor()).max(1)
    }

    /// Number of pressures from the middle of a stroke of an amplitude to a turning point.
    pub(crate) fn pressures(&self, amplitude: f64) -> usize {
        let (mut from_end, mut pressures) = (0.0, 0);
        while from_end <= amplitude {
            from_end += self.length * real(self.lengths(from_end));
            pressures += 1;
        }
        pressures
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_longer_far_from_the_turning_point() {
        let mut parts = StrokeParts {
            length: 0.5,
            half_length: 1.0,
            part_over_distance: 1.0,
        };
        assert_eq!(
            [0.0, 2.5, 3.5, 8.5].map(|at| parts.lengths(at)),
            [1, 1, 2, 12]
        );
        // One for each length in 100 half-lengths, 6 in 2.5 and few more.
        assert_eq!(parts.pressures(2.5), 6);
        assert!((8..15).contains(&parts.pressures(100.0)));
        parts.part_over_distance = 0.0;
        assert_eq!(parts.pressures(100.0), 201);
    }
}
