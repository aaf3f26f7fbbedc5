//! Course of a run: how much of its work is done at a cycle.

use crate::number::real_cycles;

/// Points of a course are kept apart by at least this share of the work.
const LEAST_SHARE: f64 = 0.002;

/// Work of a run over its physical cycles, from none at cycle 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Course {
    points: Vec<Point>,
}

/// Work that is done at a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    cycle: u64,
    increments: f64,
}

impl Course {
    /// Adds increments that end at a cycle.
    pub(super) fn add(&mut self, cycle: u64, increments: f64) {
        let increments = self.increments() + increments;
        let before = self.points.iter().rev().nth(1);
        let done = before.map_or(0.0, |point| point.increments);
        match self.points.last_mut() {
            Some(last) if last.increments - done < LEAST_SHARE * increments => {
                *last = Point { cycle, increments };
            }
            _ => self.points.push(Point { cycle, increments }),
        }
    }

    /// Increments of the whole run.
    fn increments(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.increments)
    }

    /// Physical cycles at the end of the run.
    pub fn end(&self) -> u64 {
        self.points.last().map_or(0, |point| point.cycle)
    }

    /// The share of the work that is done at a cycle, 0 to 1.
    pub fn share(&self, cycle: u64) -> f64 {
        let next = self.points.partition_point(|point| point.cycle <= cycle);
        let Some(to) = self.points.get(next) else {
            return 1.0;
        };
        let from = next.checked_sub(1).map(|before| self.points[before]);
        let (start, done) = from.map_or((0, 0.0), |point| (point.cycle, point.increments));
        let part = real_cycles(cycle - start) / real_cycles(to.cycle - start);
        (done + part * (to.increments - done)) / self.increments()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_interpolated_between_computed_cycles() {
        let mut course = Course::default();
        assert!((course.share(5) - 1.0).abs() < 1e-15);
        course.add(10, 30.0);
        course.add(100, 60.0);
        course.add(1_000, 10.0);
        assert_eq!(course.end(), 1_000);
        for (cycle, share) in [
            (0, 0.0),
            (5, 0.15),
            (10, 0.3),
            (55, 0.6),
            (550, 0.95),
            (2_000, 1.0),
        ] {
            assert!((course.share(cycle) - share).abs() < 1e-12, "{cycle}");
        }
    }

    #[test]
    fn points_of_a_long_run_are_merged_without_a_change_of_its_end() {
        let mut course = Course::default();
        for cycle in 1..=100_000 {
            course.add(cycle, 1.0);
        }
        assert!(course.points.len() < 5_000, "{}", course.points.len());
        assert_eq!(course.end(), 100_000);
        assert!((course.share(50_000) - 0.5).abs() < 1e-3);
    }
}
