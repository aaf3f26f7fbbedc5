//! Places of the sections along half or all of a straight line: evenly spaced about the place that touches first as far as the unworn
//! contact reaches, and farther apart beyond, each spacing larger than the one before by a common factor.

use crate::number::{count_at_least, nearest, real};
use crate::scene::LineShape;

/// Largest factor from one spacing to the next. Arbitrary: a contact that has grown to a place there has some spacings across.
const LARGEST_GROWTH: f64 = 1.5;
/// Halvings of the interval that holds the factor.
const HALVINGS: usize = 60;

/// Lengths of a straight line to either side of where it touches first, mm; of half of it where that stands for both.
pub(super) fn sides(shape: LineShape, at_mm: f64) -> (f64, f64) {
    let half = 0.5 * shape.length_mm();
    match shape {
        LineShape::Straight { tilt_mrad, .. } if tilt_mrad != 0.0 => (half + at_mm, half - at_mm),
        LineShape::Straight { .. } | LineShape::Ring { .. } => (0.0, half),
    }
}

/// Number of intervals that a length needs, from its beginning on, of which the first are a part of the unworn contact.
pub(super) fn intervals(length: f64, contact: f64, within: usize) -> usize {
    let first = contact / real(within);
    if first * real(within) >= length {
        return count_at_least(length / first);
    }
    let mut count = within;
    while reach(first, within, count, LARGEST_GROWTH) < length {
        count += 1;
    }
    count.min(count_at_least(length / first))
}

/// Places from 0 to a length in so many intervals; 0 alone in none.
pub(super) fn places(length: f64, contact: f64, within: usize, count: usize) -> Vec<f64> {
    if count == 0 {
        return vec![0.0];
    }
    let even = (0..=count).map(|j| length * real(j) / real(count));
    let first = contact / real(within);
    if count <= within || first * real(count) >= length {
        return even.collect();
    }
    let (mut low, mut high) = (1.0, length / first + 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if reach(first, within, count, middle) < length {
            low = middle;
        } else {
            high = middle;
        }
    }
    let factor = 0.5 * (low + high);
    let whole = reach(first, within, count, factor);
    (0..=count)
        .map(|j| length * reach(first, within, j, factor) / whole)
        .collect()
}

/// Where so many intervals end: the first ones are even.
fn reach(first: f64, within: usize, count: usize, factor: f64) -> f64 {
    let even = real(count.min(within));
    let (mut sum, mut spacing) = (even * first, first);
    for _ in within..count {
        spacing *= factor;
        sum += spacing;
    }
    sum
}

/// Divides intervals between two lengths in proportion, at least one to each that is not 0.
pub(super) fn divided(intervals: usize, left: f64, right: f64) -> (usize, usize) {
    let share = nearest(real(intervals) * left / (left + right));
    let least = usize::from(left > 0.0);
    let most = intervals - usize::from(right > 0.0).min(intervals);
    let of_left = share.clamp(least.min(most), most);
    (of_left, intervals - of_left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacings_are_even_in_the_contact_and_grow_beyond() {
        let count = intervals(1.0, 0.05, 4);
        let places = places(1.0, 0.05, 4, count);
        assert!((places[count] - 1.0).abs() < 1e-15 && places[0] == 0.0);
        let spacings: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
        for (j, pair) in spacings.windows(2).enumerate() {
            let growth = pair[1] / pair[0];
            if j < 3 {
                assert!((growth - 1.0).abs() < 1e-9, "{spacings:?}");
            } else {
                assert!(growth > 1.0 && growth < 1.5 + 1e-9, "{spacings:?}");
            }
        }
        assert!((spacings[0] / 0.0125 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_contact_as_long_as_the_line_is_evenly_divided() {
        assert_eq!(intervals(1.0, 1.0, 8), 8);
        // 4 of 1/8, then 0.1875, 0.28125 and what is left.
        assert_eq!(intervals(1.0, 0.5, 4), 7);
        let even = places(1.0, 0.5, 4, 10);
        assert!(
            even.windows(2)
                .all(|pair| (pair[1] - pair[0] - 0.1).abs() < 1e-15)
        );
        assert_eq!(places(0.0, 0.5, 4, 0), [0.0]);
        assert_eq!(divided(64, 31.0, 33.0), (31, 33));
        assert_eq!(divided(8, 0.0, 1.0), (0, 8));
        assert_eq!(divided(8, 1e-9, 1.0), (1, 7));
    }
}
