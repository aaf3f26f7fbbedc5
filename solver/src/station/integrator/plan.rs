//! Inputs of the schedule of a run: the jump that the worst leading station allows, and the increments that the finest one needs.

use crate::along_line::FollowedSection;
use crate::scene::{LineShape, Motion};
use crate::schedule::increments;
use crate::schedule::plan::{CyclePlan, Cycles};
use crate::station::cycle::LineContact;
use crate::station::section::Station;
use crate::station::state::StationState;

/// Least line load, over the largest, of a section of a straight line that decides on the schedule. The half-width of a contact goes with the
/// root of its load, and what long increments leave with the square of their length over it: below it they leave as much of a smaller depth.
const LEADING: f64 = 0.5;

impl LineContact {
    /// A section, with its motion across the line.
    fn followed(&self, station: usize) -> FollowedSection<'_> {
        self.followed_in(self.plane.motion, station)
    }

    /// A section in a motion of the slider.
    fn followed_in(&self, motion: Motion, station: usize) -> FollowedSection<'_> {
        let station = &self.stations[station];
        let state = &station.state;
        FollowedSection {
            plane: &self.plane,
            motion: Motion::Reciprocating {
                amplitude_mm: station.place.amplitude_mm(motion.amplitude_mm().abs()),
                period_s: motion.period_s().unwrap_or(1.0),
            },
            wear: self.unworn.model.interface.wear,
            depth: state.depth.largest_of_each(),
            unworn_half_width: state.unworn_half_width,
            neutral_half_width: state.neutral.half_width,
            mean_half_width: state.mean_half_width,
        }
    }

    /// Increments of a cycle of a motion for the present contacts: those of the station that needs most.
    pub(super) fn most_increments(&self, motion: Motion) -> usize {
        let stations = self.stations.iter().enumerate();
        let counts = stations.map(|(j, station)| {
            let half_width = station.state.mean_half_width;
            increments::count(
                self.followed_in(motion, j).motion,
                &self.plane.accuracy,
                half_width,
                false,
            )
        });
        counts.fold(1, usize::max)
    }

    /// Returns `true` if a station decides on the schedule: of a ring all do, whose loads change within a stroke; of a straight line those that carry
    /// enough, because a narrow contact where a crown touches next wears little.
    fn leads(&self, station: usize) -> bool {
        if let LineShape::Ring { .. } = self.scene.line {
            return true;
        }
        let load = |station: &Station| station.state.neutral.load;
        let largest = self.stations.iter().map(load).fold(0.0, f64::max);
        load(&self.stations[station]) >= LEADING * largest
    }

    /// The jump that the leading stations allow, at most that of `most`.
    pub(super) fn jump_of_leading(&mut self, most: Cycles) -> u64 {
        let mut jump = most.jump;
        for j in 0..self.stations.len() {
            let stroke = self.followed(j).stroke_after(most.done);
            let leads = self.leads(j);
            let control = &mut self.stations[j].state.jump;
            let next = control.next(&self.plane.accuracy, stroke, most.jump);
            if leads {
                jump = jump.min(next);
            }
        }
        jump
    }

    /// Measures what the next jump depends on, after one from these states.
    pub(super) fn measure_jump(&mut self, before: &[StationState], jump: u64) {
        for (station, before) in self.stations.iter_mut().zip(before) {
            station.measure_jump(&self.friction, &before.depth, jump);
        }
    }

    /// A shorter jump where the estimated error of a station far exceeds what it may be.
    pub(super) fn shorter_jump(&self, jump: u64) -> Option<u64> {
        let stations = self.stations.iter().enumerate();
        let shorter = stations.filter_map(|(j, station)| {
            let control = &station.state.jump;
            self.followed(j).shorter_jump(control, jump)
        });
        shorter.min()
    }

    /// Increments and replays of a cycle: those of the leading station that needs most.
    pub(super) fn plan_of_leading(&self, cycles: Cycles) -> CyclePlan {
        let leading = (0..self.stations.len()).filter(|j| self.leads(*j));
        let plans = leading.map(|j| self.followed(j).plan(cycles));
        plans
            .reduce(|most, plan| if plan.steps > most.steps { plan } else { most })
            .unwrap_or_else(|| self.followed(0).plan(cycles))
    }
}
