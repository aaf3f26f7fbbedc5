//! Histories of the quantities whose errors are estimated, and how far two runs of one scene differ in them.

use serde::{Deserialize, Serialize};

use crate::interpolation;
use crate::number::real_cycles;
use crate::record::{CycleReport, Life};

/// A quantity whose error is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Largest worn depth.
    WornDepth,
    /// Half the width of the scar.
    ScarHalfWidth,
    /// Worn area of the section.
    WornArea,
    /// Highest contact pressure at the neutral position.
    PeakPressure,
    /// Resistance of the contact at the neutral position, where it is computed.
    ContactResistance,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::WornDepth,
        Self::ScarHalfWidth,
        Self::WornArea,
        Self::PeakPressure,
        Self::ContactResistance,
    ];

    /// The values that it stands for: that of the receptacle and that of the slider, or that of the contact.
    fn values(self, report: &CycleReport) -> [f64; 2] {
        let CycleReport {
            receptacle, slider, ..
        } = report;
        match self {
            Self::WornDepth => [receptacle.max_depth_mm, slider.max_depth_mm],
            Self::ScarHalfWidth => [receptacle.scar_half_width_mm, slider.scar_half_width_mm],
            Self::WornArea => [receptacle.worn_area_mm2, slider.worn_area_mm2],
            Self::PeakPressure => [report.peak_pressure_mpa; 2],
            Self::ContactResistance => {
                let found = report.resistance;
                [found.map_or(0.0, |found| found.contact_resistance_mohm); 2]
            }
        }
    }
}

/// Parts of the last common cycle at which two histories are compared: at one instant alone, a difference that changes
/// its sign would be underestimated.
const COMPARED_AT: [f64; 6] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5];

/// Most points of a history: it is part of every checkpoint.
const MOST_POINTS: usize = 1_024;

/// Largest difference; any number far beyond every tolerance does the same.
const LARGEST: f64 = 1e6;

/// Histories of the quantities over the cycles of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    cycles: Vec<f64>,
    /// Values of a quantity at twice its place in [`Quantity::ALL`] and the next.
    values: [Vec<f64>; 2 * Quantity::ALL.len()],
    /// Relative change of the outputs by the effects that were skipped to the end.
    pub(crate) skipped_change: f64,
    /// Cycles at which the criteria of the life were reached, those of the resistance last.
    pub(crate) lives: Vec<Option<f64>>,
}

impl Compared {
    /// Appends the values of a report; a long history is thinned.
    pub(crate) fn push(&mut self, report: &CycleReport) {
        if self.cycles.len() >= MOST_POINTS {
            let columns = self.values.iter_mut().chain([&mut self.cycles]);
            columns.for_each(|column| *column = column.iter().copied().step_by(2).collect());
        }
        self.cycles.push(real_cycles(report.cycle));
        for (columns, quantity) in self.values.chunks_mut(2).zip(Quantity::ALL) {
            for (column, value) in columns.iter_mut().zip(quantity.values(report)) {
                column.push(value);
            }
        }
    }

    /// The histories of a run that has ended.
    pub(crate) fn ended(&self, skipped_change: f64, life: &Life) -> Self {
        Self {
            skipped_change,
            lives: life.cycles(),
            ..self.clone()
        }
    }

    /// Largest relative difference of another run's quantity from this one's over the last half of the cycles that both
    /// have done; 0 for a quantity that is 0 here.
    pub(crate) fn difference(&self, other: &Self, quantity: Quantity) -> f64 {
        let last = |run: &Self| run.cycles.last().copied().unwrap_or_default();
        let end = last(self).min(last(other));
        let place = Quantity::ALL.iter().position(|q| *q == quantity);
        let columns = place.map_or(0..0, |place| 2 * place..2 * place + 2);
        columns
            .flat_map(|column| COMPARED_AT.map(|part| (column, part * end)))
            .map(|(column, at)| {
                let here = interpolation::linear(&self.cycles, &self.values[column], at);
                let there = interpolation::linear(&other.cycles, &other.values[column], at);
                if here > f64::MIN_POSITIVE {
                    (there / here - 1.0).abs().min(LARGEST)
                } else {
                    0.0
                }
            })
            .fold(0.0, f64::max)
    }

    /// Returns `true` if the resistance of the contact is among the quantities.
    pub(crate) fn has_resistance(&self) -> bool {
        let last = self.values.last().and_then(|column| column.last());
        last.is_some_and(|found| *found > 0.0)
    }

    /// Relative difference of another run's life by a criterion from this one's; `None` where one of them has not reached it.
    pub(crate) fn difference_of_life(&self, other: &Self, criterion: usize) -> Option<f64> {
        let of = |run: &Self| run.lives.get(criterion).copied().flatten();
        let (here, there) = (of(self)?, of(other)?);
        let least = here.max(1.0);
        Some(((there - here) / least).abs().min(LARGEST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::SideReport;

    fn run(depth: impl Fn(f64) -> f64, every: u64, cycles: u64) -> Compared {
        let mut run = Compared::default();
        for cycle in (0..=cycles).filter(|cycle| cycle.is_multiple_of(every)) {
            run.push(&CycleReport {
                cycle,
                receptacle: SideReport {
                    max_depth_mm: depth(real_cycles(cycle)),
                    ..SideReport::default()
                },
                ..CycleReport::default()
            });
        }
        run
    }

    #[test]
    fn the_largest_difference_of_the_last_half_counts() {
        let one = run(|cycle| cycle, 10, 100);
        // 10 % more at cycle 60, as much at the end, twice as much at first.
        let bumped = |cycle: f64| match cycle {
            60.0 => 66.0,
            10.0 => 20.0,
            cycle => cycle,
        };
        let other = run(bumped, 10, 100);
        let difference = one.difference(&other, Quantity::WornDepth);
        assert!((difference - 0.1).abs() < 1e-12, "{difference}");
        assert!(one.difference(&other, Quantity::WornArea).abs() < 1e-15);
    }

    #[test]
    fn long_histories_are_thinned() {
        let long = run(|cycle| cycle, 1, 5_000);
        assert!(long.cycles.len() <= MOST_POINTS && long.cycles.last() == Some(&5_000.0));
        let short = run(|cycle| cycle, 100, 5_000);
        assert!(long.difference(&short, Quantity::WornDepth) < 1e-12);
    }

    #[test]
    fn a_run_that_ended_earlier_is_compared_as_far_as_it_came() {
        let (one, other) = (run(|cycle| cycle, 10, 100), run(|cycle| 1.2 * cycle, 5, 40));
        let difference = one.difference(&other, Quantity::WornDepth);
        assert!((difference - 0.2).abs() < 1e-12, "{difference}");
    }
}
