//! A measured coefficient of friction: linear between the points of a table, constant beyond them.
//!
//! mu(x) = mu_i + (mu_i+1 - mu_i) (x - x_i)/(x_i+1 - x_i) for x_i <= x <= x_i+1; x in cycles or as a dose in MPa mm. Limiting case:
//! points of one coefficient are that coefficient, to the bit.

use std::cmp::Ordering;

/// A point of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Number of cycles, or dose in MPa mm.
    pub at: f64,
    /// Coefficient of friction there, -.
    pub coefficient: f64,
}

/// Coefficients of friction over cycles or doses. It has at least one point; their places ascend.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    points: Vec<Point>,
}

impl Table {
    /// A table of at least one point, place and coefficient, in ascending order. Points at which nothing changes are left out.
    pub fn new(points: &[(f64, f64)]) -> Self {
        debug_assert!(
            !points.is_empty() && points.windows(2).all(|pair| pair[0].0 < pair[1].0),
            "the points of a table ascend"
        );
        let last = points.len().saturating_sub(1);
        let coefficient = |i: usize| points[i.min(last)].1;
        let is_same = |a: f64, b: f64| a.total_cmp(&b) == Ordering::Equal;
        let changes = |i: &usize| {
            let here = coefficient(*i);
            !is_same(coefficient(i.saturating_sub(1)), here) || !is_same(here, coefficient(i + 1))
        };
        let mut kept: Vec<usize> = (0..points.len()).filter(changes).collect();
        if kept.is_empty() {
            kept.push(0);
        }
        let point = |i: usize| Point {
            at: points[i].0,
            coefficient: points[i].1,
        };
        Self {
            points: kept.into_iter().map(point).collect(),
        }
    }

    /// The points at which the coefficient begins or ceases to change, or changes at another rate.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Returns `true` if the coefficient is not the same everywhere.
    pub fn changes(&self) -> bool {
        self.points.len() > 1
    }

    /// The coefficient at a place, -.
    pub fn at(&self, at: f64) -> f64 {
        let next = self.points.partition_point(|point| point.at <= at);
        let (before, after) = self.around(next);
        if before.at >= after.at {
            return before.coefficient;
        }
        let share = (at - before.at) / (after.at - before.at);
        before.coefficient + share * (after.coefficient - before.coefficient)
    }

    /// The mean coefficient between two places, -.
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        let inside = self
            .points
            .iter()
            .map(|point| point.at)
            .filter(|at| *at > from && *at < to);
        // The coefficient is linear where no point lies between: exact, and to the bit where it does not change.
        if to <= from || inside.clone().next().is_none() {
            return self.at(0.5 * (from + to));
        }
        let (mut last, mut sum) = (from, 0.0);
        for at in inside.chain([to]) {
            sum += (at - last) * self.at(0.5 * (last + at));
            last = at;
        }
        sum / (to - from)
    }

    /// The largest coefficient, -.
    pub fn largest(&self) -> f64 {
        let points = self.points.iter();
        points.fold(0.0, |most, point| most.max(point.coefficient))
    }

    /// The part of the table up to a place, constant beyond.
    #[must_use]
    pub fn until(&self, to: f64) -> Self {
        let inside = self.points.iter().filter(|point| point.at < to);
        let points = inside.map(|point| (point.at, point.coefficient));
        let points: Vec<_> = points.chain([(to, self.at(to))]).collect();
        Self::new(&points)
    }

    /// The next point beyond a place.
    pub(crate) fn next_point(&self, after: f64) -> Option<f64> {
        let mut points = self.points.iter().map(|point| point.at);
        points.find(|at| *at > after)
    }

    /// Distance from a place within which the coefficient changes by a part of its larger value, at the rate of change there.
    pub(crate) fn distance_of_change(&self, from: f64, part: f64) -> f64 {
        let next = self.points.partition_point(|point| point.at <= from);
        let (before, after) = self.around(next);
        let change = after.coefficient - before.coefficient;
        if before.at >= after.at || change.abs() <= 0.0 {
            return f64::INFINITY;
        }
        let here = self.at(from);
        let allowed = if change > 0.0 {
            here * part / (1.0 - part).max(f64::MIN_POSITIVE)
        } else {
            here * part
        };
        allowed * (after.at - before.at) / change.abs()
    }

    /// The points on either side of a place, the next point being number `next`; twice the same beyond the ends.
    fn around(&self, next: usize) -> (Point, Point) {
        let last = self.points.len() - 1;
        (
            self.points[next.saturating_sub(1).min(last)],
            self.points[next.min(last)],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film() -> Table {
        Table::new(&[(0.0, 0.2), (1_000.0, 0.2), (5_000.0, 0.6), (6_000.0, 0.5)])
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-15
    }

    #[test]
    fn a_table_is_linear_between_its_points_and_constant_beyond() {
        let table = film();
        for (at, expected) in [
            (-1.0, 0.2),
            (0.0, 0.2),
            (500.0, 0.2),
            (1_000.0, 0.2),
            (3_000.0, 0.4),
            (5_000.0, 0.6),
            (5_500.0, 0.55),
            (6_000.0, 0.5),
            (1e9, 0.5),
        ] {
            assert!(close(table.at(at), expected), "{at}: {}", table.at(at));
        }
    }

    #[test]
    fn points_of_one_coefficient_are_that_coefficient_to_the_bit() {
        let constant = Table::new(&[(0.0, 0.3), (7.0, 0.3), (11.0, 0.3), (1e5, 0.3)]);
        assert_eq!(constant.points().len(), 1);
        for at in [0.0, 3.3, 7.0, 9.1, 1e6] {
            assert_eq!(constant.at(at).to_bits(), 0.3_f64.to_bits());
            assert_eq!(constant.mean(at, 1.7 * at).to_bits(), 0.3_f64.to_bits());
        }
        assert_eq!(constant.next_point(-1.0), Some(0.0));
        assert_eq!(constant.next_point(0.0), None);
        assert!(constant.distance_of_change(5.0, 0.02).is_infinite());
    }

    #[test]
    fn the_mean_is_the_integral_over_its_length() {
        let table = film();
        // 0.2 for 1 000, a mean of 0.4 for 4 000, of 0.55 for 1 000 and 0.5 for 2 000.
        let expected = (200.0 + 1_600.0 + 550.0 + 1_000.0) / 8_000.0;
        assert!(close(table.mean(0.0, 8_000.0), expected));
        let steps = 8_000;
        let sum: f64 = (0..steps)
            .map(|i| table.mean(f64::from(i), f64::from(i + 1)))
            .sum();
        assert!((sum / f64::from(steps) - expected).abs() < 1e-12, "{sum}");
        assert!(close(table.mean(3_000.0, 3_000.0), 0.4));
    }

    #[test]
    fn the_largest_coefficient_is_that_of_the_part_that_is_met() {
        assert!(close(film().largest(), 0.6));
        for (to, expected) in [
            (1.0, 0.2),
            (3_000.0, 0.4),
            (5_000.0, 0.6),
            (5_500.0, 0.6),
            (9_000.0, 0.6),
        ] {
            let met = film().until(to);
            assert!(close(met.largest(), expected), "{to}");
            for at in [0.0, 0.3 * to, 0.8 * to, to] {
                assert!(close(met.at(at), film().at(at)), "{to} {at}");
            }
            assert!(close(met.at(1e9), film().at(to)), "{to}");
        }
    }

    #[test]
    fn the_distance_of_a_change_is_relative_to_the_larger_coefficient() {
        let table = film();
        for (from, part) in [
            (1_000.0, 0.1),
            (3_000.0, 0.1),
            (5_000.0, 0.1),
            (2_000.0, 0.5),
        ] {
            let to = from + table.distance_of_change(from, part);
            let (a, b) = (table.at(from), table.at(to));
            assert!(
                ((a - b).abs() / a.max(b) - part).abs() < 1e-12,
                "{from}: {a} {b}"
            );
        }
        assert!(table.distance_of_change(0.0, 0.1).is_infinite());
        assert!(table.distance_of_change(6_000.0, 0.1).is_infinite());
        // From nothing the first cycle changes all of it.
        let rising = Table::new(&[(0.0, 0.0), (10.0, 0.5)]);
        assert!(rising.distance_of_change(0.0, 0.1) <= 0.0);
        assert_eq!(film().next_point(1_000.0), Some(5_000.0));
    }
}
