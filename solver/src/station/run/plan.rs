//! What the schedule of a run is chosen from: the jump that the worst station allows, and the increments that the finest one needs.

use super::Run;
use crate::scene::Motion;
use crate::schedule::jump::Stroke;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};

impl Run<'_> {
    /// The motion of a section across the line.
    pub(super) fn motion(&self, station: usize) -> Motion {
        let place = &self.line.stations[station].place;
        Motion::Reciprocating {
            amplitude_mm: place.amplitude_mm(self.amplitude_mm.abs()),
            period_s: self.plane.motion.period_s().unwrap_or(1.0),
        }
    }

    pub(super) fn largest(&self, of: impl Fn(&Self, usize) -> usize) -> usize {
        let numbers = (0..self.line.stations.len()).map(|j| of(self, j));
        numbers.fold(1, usize::max)
    }

    /// Limits of a station's jump besides its error. Every jump wears in the increments of one cycle: nothing is extrapolated in a groove.
    pub(super) fn stroke(&self, station: usize) -> Stroke {
        let state = &self.line.stations[station].state;
        let amplitude = self.motion(station).amplitude_mm();
        let mut stroke = Stroke::new(
            &self.plane.accuracy.tuning,
            self.rates,
            self.line.stations[station].section.model.interface.modulus,
            (amplitude, state.mean_half_width.max(self.single[station])),
            (1.0, false),
            self.plane.cycles,
        );
        stroke.is_groove = false;
        stroke
    }

    /// Number of increments of a cycle for a station.
    pub(super) fn increments(&self, station: usize, cycles: Cycles) -> usize {
        let followed = Followed {
            half_width: self.line.stations[station].state.mean_half_width,
            single: self.single[station],
            sticks: false,
        };
        let run = (self.motion(station), &self.plane.accuracy);
        CyclePlan::new(run, followed, (self.stroke(station), cycles), false).steps
    }
}
