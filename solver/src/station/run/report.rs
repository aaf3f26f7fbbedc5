//! Reports of a run.

use super::super::cycle::Work;
use super::super::record::{
    StationCycle, StationOutcome, StationProfile, StationReport, StationSummary,
};
use super::super::section::Station;
use super::Run;
use crate::number::real_cycles;
use crate::sides::{Side, Sides};

impl Run<'_> {
    /// Integral of p |slip| of each station so far, N/mm mm.
    pub(super) fn paths(&self) -> Vec<f64> {
        let stations = self.line.stations.iter();
        stations.map(|station| station.state.path).collect()
    }

    /// Reports a computed cycle that began with these paths and this work.
    pub(super) fn report(&self, jump: u64, paths: &[f64], work: Work) -> StationCycle {
        let per_cycle = self.plane.motion.distance_per_cycle_mm().abs();
        let slid = per_cycle * real_cycles(jump);
        let stations: Vec<StationReport> = self
            .line
            .stations
            .iter()
            .zip(paths)
            .map(|(station, before)| StationReport {
                at: station.place.at,
                weight_mm: station.place.weight_mm,
                max_depth_mm: station.state.depth.largest_of_each(),
                worn_area_mm2: station.worn_section(),
                line_load_n_per_mm: if jump > 0 {
                    (station.state.path - before) / slid
                } else {
                    station.attempt.line_load
                },
                peak_pressure_mpa: station.state.contact.peak_pressure(),
                half_width_mm: station.half_width(),
            })
            .collect();
        let over_line = |of: &dyn Fn(usize) -> f64| -> f64 {
            let weights = stations.iter().map(|station| station.weight_mm);
            weights.enumerate().map(|(j, weight)| weight * of(j)).sum()
        };
        let states = &self.line.stations;
        let work_of_line = over_line(&|j| states[j].state.path);
        let distance = per_cycle * real_cycles(self.done);
        let errors = states.iter().map(|station| station.state.jump.error);
        StationCycle {
            cycle: self.done,
            jump,
            force_n: over_line(&|j| states[j].attempt.line_load),
            worn_volume_mm3: Sides::from_fn(|side| {
                over_line(&|j| *stations[j].worn_area_mm2.of(side))
            }),
            sliding_work_volume_mm3: self.rates.map(|rate| rate * work_of_line),
            ideal_volume_mm3: self.rates.map(|rate| rate * self.scene.force_n * distance),
            dissipated_energy_mj: over_line(&|j| states[j].state.energy),
            jump_error: errors.fold(0.0, f64::max),
            increments: self.line.work.increments - work.increments,
            iterations: self.line.work.iterations - work.iterations,
            stations,
        }
    }

    /// The result of the run.
    pub(super) fn finish(
        self,
        outcome: StationOutcome,
        initial: StationCycle,
        last: StationCycle,
    ) -> StationSummary {
        let profile = |station: Station| StationProfile {
            x_mm: Sides::from_fn(|side: Side| {
                station.section.condensed.operators.of(side).x.clone()
            }),
            depth_mm: station.state.depth,
        };
        StationSummary {
            outcome,
            initial,
            last,
            computed_cycles: self.computed,
            solves: (self.line.work.increments, self.line.work.iterations),
            relocations: self.relocations,
            profiles: self.line.stations.into_iter().map(profile).collect(),
        }
    }
}
