//! Reports of a run: the last computed cycle, its contacts, and what the planes have worn.

use super::ExtrudedIntegrator;
use crate::along_line::{self, Along, Ending, StationCycle, StationProfile, StationReport};
use crate::condensation::ExtrudedOperators;
use crate::contact::ContactState;
use crate::cycle::{Checks, FrictionLoop};
use crate::law::surface::{self, SurfaceWear};
use crate::mesh::NodePlanes;
use crate::model::Model;
use crate::number::real_cycles;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

impl ExtrudedIntegrator {
    /// Integral of p |slip| of each plane so far, N/mm mm.
    pub(super) fn paths(&self) -> Vec<f64> {
        let states = self.contact.planes.states.iter();
        states.map(|state| state.path).collect()
    }

    /// Distances of the planes from the middle of the width, and the lengths that they stand for with their mirror images, mm.
    fn places(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (z, width) = (self.contact.bodies.planes.z(), self.scene.width_mm);
        let shares = self.contact.bodies.shares.iter();
        z.iter()
            .zip(shares)
            .map(move |(z, share)| (0.5 * width - z, share * width))
    }

    /// Reports a computed cycle of a jump that began with these paths, increments and iterations.
    pub(super) fn report(
        &self,
        jump: u64,
        paths: &[f64],
        increments: usize,
        iterations: usize,
    ) -> StationCycle {
        let per_cycle = self.plane.motion.distance_per_cycle_mm().abs();
        let slid = per_cycle * real_cycles(jump);
        let states = &self.contact.planes.states;
        let planes = self.places().zip(states).zip(paths);
        let stations: Vec<StationReport> = planes
            .map(|(((z_mm, weight_mm), state), before)| StationReport {
                at: Along::DistanceMm(z_mm),
                weight_mm,
                max_depth_mm: state.depth.largest_of_each(),
                worn_area_mm2: self.worn_section(&state.depth),
                line_load_n_per_mm: if jump > 0 {
                    (state.path - before) / slid
                } else {
                    state.line_load
                },
                peak_pressure_mpa: state.neutral.peak_pressure,
                half_width_mm: state.neutral.half_width,
            })
            .collect();
        let over_width = |of: &dyn Fn(usize) -> f64| -> f64 {
            let lengths = stations.iter().map(|plane| plane.weight_mm);
            lengths.enumerate().map(|(k, length)| length * of(k)).sum()
        };
        let work = over_width(&|k| states[k].path);
        let distance = per_cycle * real_cycles(self.common.done);
        // No load of a spring, no law of layers has an identity.
        let dead = self.contact.interface.spring <= 0.0;
        let wear = self.contact.interface.wear;
        let ideal = |work| wear.map(|wear| SurfaceWear::volume_by_work(wear, work));
        let of_load = ideal(self.scene.force_n() * distance);
        let effort = &self.contact.effort;
        StationCycle {
            cycle: self.common.done,
            jump,
            force_n: over_width(&|k| states[k].neutral.load),
            worn_volume_mm3: Sides::from_fn(|side| {
                over_width(&|k| *stations[k].worn_area_mm2.of(side))
            }),
            sliding_work_volume_mm3: ideal(work),
            ideal_volume_mm3: of_load.map(|volume| volume.filter(|_| dead)),
            dissipated_energy_mj: over_width(&|k| states[k].energy),
            jump_error: self.common.jump.error,
            increments: effort.increments - increments,
            iterations: effort.iterations - iterations,
            stations,
        }
    }

    /// Integrals of worn depths of a plane, mm^2.
    fn worn_section(&self, depth: &Sides<Vec<f64>>) -> Sides<f64> {
        let sections = &self.contact.bodies.operators.sections;
        Sides::from_fn(|side| {
            let nodes = depth.of(side).iter().zip(&sections.of(side).widths);
            nodes.map(|(depth, width)| depth * width).sum()
        })
    }

    /// Why the run ends here, if it does.
    pub(crate) fn ending(&self) -> Option<Ending> {
        let radius = self.plane.slider.shape.radius_mm;
        let planes = self.contact.planes.states.iter().enumerate();
        let mut endings = planes.filter_map(|(plane, state)| {
            if self.contact.spines.are_worn_through(&state.depth) {
                Some(Ending::WornThrough(plane))
            } else {
                let groove = along_line::groove_mm(&state.depth.receptacle);
                (groove >= radius).then_some(Ending::DeeperThanRadius(plane))
            }
        });
        endings.next()
    }

    /// Cycles until the run ends by the depth of a plane, at the present rates.
    pub(crate) fn cycles_left(&self) -> f64 {
        let radius = self.plane.slider.shape.radius_mm;
        let mut left = f64::INFINITY;
        let (states, rates) = (&self.contact.planes.states, self.common.jump.rates());
        for (plane, state) in states.iter().enumerate() {
            let wear = &self.contact.interface.wear;
            let own = Sides::from_fn(|side| {
                let depth = state.depth.of(side);
                let nodes = depth.len();
                let own = rates.of(side).get(plane * nodes..(plane + 1) * nodes);
                surface::at_relative_rates(*wear.of(side), own.unwrap_or_default(), depth)
            });
            let own = own.as_ref().map(|rates| &rates[..]);
            let fastest = own
                .receptacle
                .iter()
                .copied()
                .fold(f64::MIN_POSITIVE, f64::max);
            let groove = (radius - along_line::groove_mm(&state.depth.receptacle)) / fastest;
            let spines = self.contact.spines.cycles_left(&state.depth, own);
            left = left.min(spines).min(groove.max(0.0));
        }
        left
    }

    /// The plane in the middle of the width.
    pub(crate) fn reference(&self) -> usize {
        self.contact.bodies.planes.count() - 1
    }

    /// Distance by which the slider has sunk since first touch, by deformation and wear, mm.
    pub(crate) fn approach_mm(&self) -> f64 {
        -self.contact.planes.contacts[0].height
    }

    /// The friction loop of the last computed cycle, which begins at its turning point.
    pub(crate) fn friction_loop(&self) -> &FrictionLoop {
        &self.record.friction_loop
    }

    /// Contacts of a plane at the named positions of the last computed cycle, with the displacement of the slider, mm.
    pub(crate) fn contacts(
        &self,
        plane: usize,
    ) -> impl Iterator<Item = (Position, f64, &ContactState)> {
        let positions = self.record.positions.iter();
        positions.map(move |at| (at.position, at.slider_x, &at.contacts[plane]))
    }

    /// Pressures at the nodes of the body that carries them, plane by plane, MPa.
    pub(crate) fn pressures_mpa(&self) -> Vec<Vec<f64>> {
        let contacts = self.contact.planes.contacts.iter();
        contacts.map(|contact| contact.pressure.clone()).collect()
    }

    /// Node planes, and the section in each of them as when the operators were built, with these.
    pub(crate) fn condensed(&self) -> (&NodePlanes, &[Model], &ExtrudedOperators) {
        let bodies = &self.contact.bodies;
        (&bodies.planes, &bodies.models, &bodies.operators)
    }

    /// Worn depths of each plane, mm.
    pub(crate) fn depths(&self) -> impl Iterator<Item = &Sides<Vec<f64>>> {
        self.contact.planes.states.iter().map(|state| &state.depth)
    }

    /// Contacts of all planes at the named positions of the last computed cycle.
    pub(crate) fn contacts_at_positions(
        &self,
    ) -> impl Iterator<Item = (Position, &[ContactState])> {
        let positions = self.record.positions.iter();
        positions.map(|at| (at.position, &at.contacts[..]))
    }

    /// The body that carries the tractions.
    pub(crate) fn slave(&self) -> Side {
        self.contact.interface.slave
    }

    /// Worn depths of both bodies in a plane.
    pub(crate) fn profile(&self, plane: usize) -> StationProfile {
        let sections = &self.contact.bodies.operators.sections;
        StationProfile {
            weight_mm: self.contact.bodies.shares[plane] * self.scene.width_mm,
            x_mm: sections.as_ref().map(|section| section.x.clone()),
            depth_mm: self.contact.planes.states[plane].depth.clone(),
        }
    }

    /// Worst residuals so far, with those of the present worn areas.
    pub(crate) fn residuals(&self) -> Checks {
        let planes = self.contact.planes.states.iter();
        let areas = planes.map(|state| {
            let worn = self.worn_section(&state.depth);
            along_line::worn_area_residual(worn, state.worn_area)
        });
        Checks {
            worn_area: areas.fold(0.0, f64::max),
            ..self.contact.effort.checks
        }
    }

    /// Degrees of freedom of both meshes, contact elements of the receptacle, and their size in mm.
    pub(crate) fn size(&self) -> (usize, usize, f64) {
        let model = self.contact.bodies.unworn();
        let nodes = model.bodies.receptacle.contact_x().len();
        (
            self.contact.bodies.dofs(),
            self.contact.bodies.planes.count() * (nodes - 1),
            model.sizes.contact_element,
        )
    }
}
