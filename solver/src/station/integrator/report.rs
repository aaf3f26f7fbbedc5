//! Reports of a run: the last computed cycle, its contacts, and what the stations have worn.

use super::LineIntegrator;
use crate::along_line::{Ending, StationCycle, StationProfile, StationReport};
use crate::condensation::Condensed;
use crate::contact::ContactState;
use crate::cycle::{Checks, FrictionLoop};
use crate::law::surface::SurfaceWear;
use crate::model::Model;
use crate::number::real_cycles;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};
use crate::station::section::Station;

impl LineIntegrator {
    /// Integral of p |slip| of each station so far, N/mm mm.
    pub(super) fn paths(&self) -> Vec<f64> {
        let stations = self.line.stations.iter();
        stations.map(|station| station.state.path).collect()
    }

    /// Reports a computed cycle of a jump that began with these paths, increments and iterations.
    pub(super) fn report(
        &self,
        jump: u64,
        paths: &[f64],
        increments: usize,
        iterations: usize,
    ) -> StationCycle {
        let (line, common) = (&self.line, &self.line.common);
        let per_cycle = self.plane.motion.distance_per_cycle_mm().abs();
        let slid = per_cycle * real_cycles(jump);
        let stations = line.stations.iter().zip(paths);
        let reports: Vec<StationReport> = stations
            .map(|(station, before)| {
                let worn = (station.state.path - before) / slid;
                station_report(station, (jump > 0).then_some(worn))
            })
            .collect();
        let over_line = |of: &dyn Fn(usize) -> f64| -> f64 {
            let weights = reports.iter().map(|station| station.weight_mm);
            weights.enumerate().map(|(j, weight)| weight * of(j)).sum()
        };
        let states = &line.stations;
        let distance = per_cycle * real_cycles(common.done);
        // No load of a spring, no law of layers has an identity.
        let dead = line.carrier.spring_n_per_mm <= 0.0;
        let wear = self.unworn.model.interface.wear;
        let ideal = |work| wear.map(|wear| SurfaceWear::volume_by_work(wear, work));
        let of_load = ideal(self.scene.force_n * distance);
        let errors = states.iter().map(|station| station.state.jump.error);
        StationCycle {
            cycle: common.done,
            jump,
            force_n: over_line(&|j| states[j].state.neutral.load),
            worn_volume_mm3: Sides::from_fn(|side| {
                over_line(&|j| *reports[j].worn_area_mm2.of(side))
            }),
            sliding_work_volume_mm3: ideal(over_line(&|j| states[j].state.path)),
            ideal_volume_mm3: of_load.map(|volume| volume.filter(|_| dead)),
            dissipated_energy_mj: over_line(&|j| states[j].state.energy),
            jump_error: errors.fold(0.0, f64::max),
            increments: common.increments - increments,
            iterations: common.iterations - iterations,
            stations: reports,
        }
    }

    /// Why the run ends here, if it does.
    pub(crate) fn ending(&self) -> Option<Ending> {
        let radius = self.plane.slider.shape.radius_mm;
        let stations = self.line.stations.iter().enumerate();
        let mut endings = stations.filter_map(|(number, station)| {
            if station.is_worn_through() {
                Some(Ending::WornThrough(number))
            } else {
                (station.groove_mm() >= radius).then_some(Ending::DeeperThanRadius(number))
            }
        });
        endings.next()
    }

    /// Cycles until the run ends by the depth of a station, at the present rates.
    pub(crate) fn cycles_left(&self) -> f64 {
        let radius = self.plane.slider.shape.radius_mm;
        let stations = self.line.stations.iter();
        stations
            .map(|station| station.cycles_left(radius))
            .fold(f64::INFINITY, f64::min)
    }

    /// The station that touches first: across the motion on a ring, in the middle of a crown, at the lower end of a tilt.
    pub(crate) fn reference(&self) -> usize {
        let raised = self
            .line
            .stations
            .iter()
            .map(|station| station.place.raised_mm);
        let lowest = raised
            .enumerate()
            .reduce(|lowest, next| if next.1 < lowest.1 { next } else { lowest });
        lowest.map_or(0, |(number, _)| number)
    }

    /// The friction loop of the last computed cycle, which begins at its turning point.
    pub(crate) fn friction_loop(&self) -> &FrictionLoop {
        &self.record.friction_loop
    }

    /// Contacts of a station at the named positions of the last computed cycle, with the displacement of the slider, mm.
    pub(crate) fn contacts(
        &self,
        station: usize,
    ) -> impl Iterator<Item = (Position, f64, &ContactState)> {
        let positions = self.record.positions.iter();
        positions.map(move |at| (at.position, at.slider_x, &at.contacts[station]))
    }

    /// The body that carries the tractions.
    pub(crate) fn slave(&self) -> Side {
        self.unworn.model.interface.slave
    }

    /// Worn depths of both bodies at a station.
    pub(crate) fn profile(&self, station: usize) -> StationProfile {
        let bodies = self.unworn.model.bodies.as_ref();
        StationProfile {
            weight_mm: self.line.stations[station].place.weight_mm,
            x_mm: bodies.map(|body| body.contact_x().to_vec()),
            depth_mm: self.line.stations[station].state.depth.clone(),
        }
    }

    /// Does work in the threads of the run.
    pub(crate) fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.threads.within(work)
    }

    /// The meshed section of a station with its operators, and its worn depths, mm.
    pub(crate) fn section(&self, station: usize) -> (&Model, &Condensed, &Sides<Vec<f64>>) {
        let station = &self.line.stations[station];
        let section = &station.section;
        (&section.model, &section.condensed, &station.state.depth)
    }

    /// Worst residuals so far, with those of the present worn areas.
    pub(crate) fn residuals(&self) -> Checks {
        let stations = self.line.stations.iter();
        let residuals = stations.map(|station| Checks {
            worn_area: station.worn_area_residual(),
            ..station.state.checks
        });
        let own = Checks {
            force_balance: self.line.common.height.imbalance,
            force_balance_present_normals: self.line.common.imbalance,
            ..Checks::default()
        };
        residuals.fold(own, Checks::worse_of)
    }

    /// Degrees of freedom of both meshes, contact elements of the receptacle, and their size in mm.
    pub(crate) fn size(&self) -> (usize, usize, f64) {
        let model = &self.unworn.model;
        let bodies = &model.bodies;
        let nodes = bodies.receptacle.contact_x().len();
        let stations = self.line.stations.len();
        (
            stations * (bodies.slider.dofs() + bodies.receptacle.dofs()),
            stations * (nodes - 1),
            model.sizes.contact_element,
        )
    }
}

/// A station with the mean line load over a computed cycle; the present vertical one without.
fn station_report(station: &Station, mean_load: Option<f64>) -> StationReport {
    let state = &station.state;
    StationReport {
        at: station.place.at,
        weight_mm: station.place.weight_mm,
        max_depth_mm: state.depth.largest_of_each(),
        worn_area_mm2: station.worn_section(),
        line_load_n_per_mm: mean_load.unwrap_or(station.state.neutral.load),
        peak_pressure_mpa: state.neutral.peak_pressure,
        half_width_mm: state.neutral.half_width,
    }
}
