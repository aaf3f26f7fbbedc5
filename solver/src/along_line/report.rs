//! Reports of a run of sections: the last computed cycle, its contacts, and what the sections have worn.

use super::contact::{SectionedContact, WornSection};
use super::integrator::{Before, SectionsIntegrator};
use super::record::SectionContact;
use super::state::Progress;
use super::{Ending, StationCycle, StationProfile, StationReport, groove_mm, worn_area_residual};
use crate::cycle::{Checks, FrictionLoop};
use crate::law::friction::Coefficients;
use crate::law::surface::{self, SurfaceWear};
use crate::number::real_cycles;
use crate::schedule::mission_state::BlockWear;
use crate::sides::{Side, Sides};

impl<C: SectionedContact> SectionsIntegrator<C> {
    /// Reports a computed cycle of a jump.
    pub(super) fn report(&self, jump: u64, before: &Before) -> StationCycle {
        let contact = &self.contact;
        let motion = contact.plane().motion;
        let per_cycle = motion.distance_per_cycle_mm().abs();
        let slid = per_cycle * real_cycles(jump);
        let worn = contact.worn();
        let sections = worn.iter().zip(&before.paths);
        let stations: Vec<StationReport> = sections
            .map(|(section, path)| StationReport {
                at: section.at,
                weight_mm: section.weight_mm,
                max_depth_mm: section.depth.largest_of_each(),
                worn_area_mm2: section.area_mm2(),
                line_load_n_per_mm: if slid > 0.0 {
                    (section.path - path) / slid
                } else {
                    section.neutral.load
                },
                peak_pressure_mpa: section.neutral.peak_pressure,
                half_width_mm: section.neutral.half_width,
            })
            .collect();
        let over_line = |of: &dyn Fn(usize) -> f64| -> f64 {
            let weights = stations.iter().map(|station| station.weight_mm);
            weights.enumerate().map(|(j, weight)| weight * of(j)).sum()
        };
        let interface = contact.interface();
        // No load of a spring, no law of layers has an identity.
        let dead = interface.spring <= 0.0;
        let ideal = |work| (interface.wear).map(|wear| SurfaceWear::volume_by_work(wear, work));
        let of_load = ideal(contact.force_n() * self.progress.distance_mm(motion));
        let (increments, iterations) = contact.solves();
        StationCycle {
            cycle: self.progress.done,
            jump,
            force_n: over_line(&|j| worn[j].neutral.load),
            worn_volume_mm3: Sides::from_fn(|side| {
                over_line(&|j| *stations[j].worn_area_mm2.of(side))
            }),
            sliding_work_volume_mm3: ideal(over_line(&|j| worn[j].path)),
            ideal_volume_mm3: of_load.map(|volume| volume.filter(|_| dead)),
            dissipated_energy_mj: over_line(&|j| worn[j].energy),
            friction_coefficient: mean_friction(&worn),
            jump_error: contact.jump_error(),
            increments: increments - before.increments,
            iterations: iterations - before.iterations,
            stations,
        }
    }

    /// Why the run ends here, if it does.
    pub(crate) fn ending(&self) -> Option<Ending> {
        let radius = self.contact.plane().slider.shape.radius_mm;
        let sections = self.contact.worn().into_iter().enumerate();
        let mut endings = sections.filter_map(|(number, section)| {
            if section.spines.are_worn_through(section.depth) {
                Some(Ending::WornThrough(number))
            } else {
                let groove = groove_mm(&section.depth.receptacle);
                (groove >= radius).then_some(Ending::DeeperThanRadius(number))
            }
        });
        endings.next()
    }

    /// Cycles until the run ends by the depth of a section, at the present rates.
    pub(crate) fn cycles_left(&self) -> f64 {
        self.cycles_left_by(|section, _| section.rates)
    }

    /// The same at rates of the nodes of all sections one after the other, mm a cycle.
    pub(crate) fn cycles_left_at(&self, rates: Sides<&[f64]>) -> f64 {
        self.cycles_left_by(|section, before| {
            Sides::from_fn(|side: Side| {
                let (first, nodes) = (*before.of(side), section.depth.of(side).len());
                let own = rates.of(side).get(first..first + nodes);
                own.unwrap_or_default()
            })
        })
    }

    /// The same at rates of each section, which has so many nodes of all sections before it.
    fn cycles_left_by<'a>(
        &'a self,
        rates: impl Fn(&WornSection<'a>, Sides<usize>) -> Sides<&'a [f64]>,
    ) -> f64 {
        let radius = self.contact.plane().slider.shape.radius_mm;
        let wear = self.contact.interface().wear;
        let sections = self.contact.worn().into_iter();
        let mut nodes = Sides::default();
        let left = sections.map(|section| {
            let depth = section.depth;
            let of_nodes = rates(&section, nodes);
            for side in Side::BOTH {
                *nodes.of_mut(side) += depth.of(side).len();
            }
            let rates = Sides::from_fn(|side: Side| {
                surface::at_relative_rates(*wear.of(side), of_nodes.of(side), depth.of(side))
            });
            let fastest = rates.receptacle.iter();
            let fastest = fastest.fold(f64::MIN_POSITIVE, |most, rate| rate.max(most));
            let groove = (radius - groove_mm(&depth.receptacle)) / fastest;
            let rates = rates.as_ref().map(|rates| &rates[..]);
            section
                .spines
                .cycles_left(depth, rates)
                .min(groove.max(0.0))
        });
        left.fold(f64::INFINITY, f64::min)
    }

    /// Totals of the wear so far, as means over the line, at the nodes of all sections one after the other.
    pub(crate) fn totals(&self) -> BlockWear {
        let Progress { done, last, .. } = &self.progress;
        let weights = last.stations.iter().map(|station| station.weight_mm);
        let length: f64 = weights.sum();
        let wear = self.contact.interface().wear;
        let totals = BlockWear::whole(
            *done,
            self.progress.distance_mm(self.contact.plane().motion),
            last.dissipated_energy_mj / length,
            last.worn_volume_mm3.map(|volume| volume / length),
        );
        let sections = self.contact.worn();
        totals.with_equivalents(Sides::from_fn(|side| {
            let depths = sections.iter().map(|section| section.depth.of(side));
            let equivalents = depths.map(|depth| surface::equivalents(*wear.of(side), depth));
            equivalents.collect::<Vec<_>>().concat()
        }))
    }

    /// Worn depths at these nodes, mm.
    pub(crate) fn nodal_depths(&self) -> Sides<Vec<f64>> {
        let sections = self.contact.worn();
        Sides::from_fn(|side| {
            let depths = sections.iter().map(|section| &section.depth.of(side)[..]);
            depths.collect::<Vec<_>>().concat()
        })
    }

    /// The friction loop of the last computed cycle, which begins at its turning point.
    pub(crate) fn friction_loop(&self) -> &FrictionLoop {
        &self.record.friction_loop
    }

    /// Contacts of a section at the named positions of the last computed cycle.
    pub(crate) fn contacts(&self, section: usize) -> impl Iterator<Item = SectionContact<'_>> {
        let positions = self.record.positions.iter();
        positions.map(move |at| SectionContact {
            position: at.position,
            slider_x_mm: at.slider_x,
            contact: &at.contacts[section],
            friction: &at.friction[section],
        })
    }

    /// Worn depths of both bodies in a section.
    pub(crate) fn profile(&self, section: usize) -> StationProfile {
        let section = self.contact.worn().swap_remove(section);
        StationProfile {
            weight_mm: section.weight_mm,
            x_mm: section.x_mm.map(<[f64]>::to_vec),
            depth_mm: section.depth.clone(),
        }
    }

    /// Worst residuals so far, with those of the present worn areas.
    pub(crate) fn residuals(&self) -> Checks {
        let sections = self.contact.worn().into_iter();
        let areas =
            sections.map(|section| worn_area_residual(section.area_mm2(), section.worn_area));
        Checks {
            worn_area: areas.fold(0.0, f64::max),
            ..self.contact.checks()
        }
    }
}

/// Mean coefficient of friction of sections at the neutral position, weighted by their forces, -.
fn mean_friction(sections: &[WornSection<'_>]) -> f64 {
    let coefficients = sections.iter().map(|section| section.neutral.friction);
    let coefficients: Vec<f64> = coefficients.collect();
    let forces = sections.iter();
    Coefficients::Local(&coefficients)
        .mean(forces.map(|section| section.weight_mm * section.neutral.load))
}
