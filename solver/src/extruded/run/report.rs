//! Reports of a run.

use super::super::cycle::Work;
use super::super::record::{
    ExtrudedCycle, ExtrudedOutcome, ExtrudedSummary, PlaneProfile, PlaneReport,
};
use super::Run;
use crate::number::real_cycles;
use crate::sides::Sides;

impl Run<'_> {
    /// Integral of p |slip| of each plane so far, N/mm mm.
    pub(super) fn paths(&self) -> Vec<f64> {
        self.contact.states.iter().map(|state| state.path).collect()
    }

    /// Distances of the planes from the middle of the width, and the lengths that they stand for with their mirror images, mm.
    fn places(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (z, width) = (self.bodies.planes.z(), self.scene.width_mm);
        let shares = self.bodies.shares.iter();
        z.iter()
            .zip(shares)
            .map(move |(z, share)| (0.5 * width - z, share * width))
    }

    /// Reports a computed cycle that began with these paths and this work.
    pub(super) fn report(&self, jump: u64, paths: &[f64], work: Work) -> ExtrudedCycle {
        let per_cycle = self.plane.motion.distance_per_cycle_mm().abs();
        let slid = per_cycle * real_cycles(jump);
        let sections = &self.bodies.operators.sections;
        let x = &sections.of(self.contact.interface.slave).x;
        let states = &self.contact.states;
        let planes = self
            .places()
            .zip(states.iter().zip(&self.contact.contacts))
            .zip(paths);
        let planes: Vec<PlaneReport> = planes
            .map(
                |(((z_mm, length_mm), (state, contact)), before)| PlaneReport {
                    z_mm,
                    length_mm,
                    max_depth_mm: state.depth.largest_of_each(),
                    worn_area_mm2: Sides::from_fn(|side| {
                        let nodes = state.depth.of(side).iter().zip(&sections.of(side).widths);
                        nodes.map(|(depth, width)| depth * width).sum()
                    }),
                    line_load_n_per_mm: if jump > 0 {
                        (state.path - before) / slid
                    } else {
                        state.line_load
                    },
                    peak_pressure_mpa: contact.peak_pressure(),
                    half_width_mm: contact.half_width(x),
                },
            )
            .collect();
        let over_width = |of: &dyn Fn(usize) -> f64| -> f64 {
            let lengths = planes.iter().map(|plane| plane.length_mm);
            lengths.enumerate().map(|(k, length)| length * of(k)).sum()
        };
        let work_of_width = over_width(&|k| states[k].path);
        let distance = per_cycle * real_cycles(self.done);
        ExtrudedCycle {
            cycle: self.done,
            jump,
            approach_mm: -self.contact.contacts[0].height,
            force_n: over_width(&|k| states[k].line_load),
            worn_volume_mm3: Sides::from_fn(|side| {
                over_width(&|k| *planes[k].worn_area_mm2.of(side))
            }),
            sliding_work_volume_mm3: self.rates.map(|rate| rate * work_of_width),
            ideal_volume_mm3: self
                .rates
                .map(|rate| rate * self.scene.force_n() * distance),
            dissipated_energy_mj: over_width(&|k| states[k].energy),
            jump_error: self.jump.error,
            increments: self.contact.work.increments - work.increments,
            iterations: self.contact.work.iterations - work.iterations,
            planes,
        }
    }

    /// The result of the run.
    pub(super) fn finish(
        self,
        outcome: ExtrudedOutcome,
        initial: ExtrudedCycle,
        last: ExtrudedCycle,
    ) -> ExtrudedSummary {
        let sections = &self.bodies.operators.sections;
        let planes = self
            .places()
            .zip(self.contact.states.iter().zip(&self.contact.contacts));
        let profiles = planes
            .map(|((z_mm, _), (state, contact))| PlaneProfile {
                z_mm,
                x_mm: Sides::from_fn(|side| sections.of(side).x.clone()),
                depth_mm: state.depth.clone(),
                pressure_mpa: contact.pressure.clone(),
            })
            .collect();
        let work = self.contact.work;
        ExtrudedSummary {
            outcome,
            initial,
            last,
            computed_cycles: self.computed,
            solves: (work.increments, work.iterations),
            relocations: self.relocations,
            profiles,
        }
    }
}
