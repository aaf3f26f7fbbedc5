//! The report of a computed cycle of a contact along a line: quantities per mm of depth are means over the line; depths, pressures and
//! widths are the largest of all stations.

use super::{CycleReport, ExtentReport, SideReport};
use crate::along_line::{StationCycle, StationProfile, StationReport};
use crate::interpolation;
use crate::law::plating::bottoms;
use crate::number::real_cycles;
use crate::record::{WornSurface, scar};
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// Inputs of a report of a contact along a line.
pub(crate) struct LineEnd<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) cycle: &'a StationCycle,
    pub(crate) profiles: &'a [StationProfile],
    /// The station whose depths at given positions are reported.
    pub(crate) reference: usize,
}

/// The report of a computed cycle.
pub(crate) fn line_report(end: &LineEnd<'_>) -> CycleReport {
    let LineEnd { scene, cycle, .. } = end;
    let length: f64 = cycle.stations.iter().map(|station| station.weight_mm).sum();
    let largest = |of: fn(&StationReport) -> f64| {
        let stations = cycle.stations.iter();
        stations.map(of).fold(0.0, f64::max)
    };
    let loaded = cycle.stations.iter();
    let loaded = loaded.filter(|station| station.line_load_n_per_mm > 0.0);
    let side = |side: Side| SideReport {
        ideal_area_mm2: known(cycle.ideal_volume_mm3, side).map(|volume| volume / length),
        worn_volume_mm3: Some(*cycle.worn_volume_mm3.of(side)),
        ideal_volume_mm3: known(cycle.ideal_volume_mm3, side),
        max_depth_mm: *cycle.max_depth_mm().of(side),
        worn_area_mm2: cycle.worn_volume_mm3.of(side) / length,
        scar_half_width_mm: end.largest_half_width(side),
    };
    CycleReport {
        cycle: cycle.cycle,
        jump: cycle.jump,
        jump_error: cycle.jump_error,
        sliding_distance_mm: scene.elapsed(real_cycles(cycle.cycle)).0,
        receptacle: side(Side::Receptacle),
        slider: side(Side::Slider),
        station_depth_mm: end.depths_at_positions(),
        exposed_length_mm: Sides::from_fn(|side| {
            let layers = bottoms(scene.plating(side));
            layers
                .map(|bottom| end.exposed_area(side, bottom) / length)
                .collect()
        }),
        resistance: None,
        temperature: None,
        extent: Some(ExtentReport {
            load_n: cycle.force_n,
            contact_half_length_across_mm: 0.5
                * loaded.map(|station| station.weight_mm).sum::<f64>(),
            dissipated_energy_mj: cycle.dissipated_energy_mj,
        }),
        stations: cycle.stations.clone(),
        load_n_per_mm: cycle.force_n / length,
        peak_pressure_mpa: largest(|station| station.peak_pressure_mpa),
        contact_half_width_mm: largest(|station| station.half_width_mm),
        dissipated_energy_mj_per_mm: cycle.dissipated_energy_mj / length,
        friction_coefficient: cycle.friction_coefficient,
    }
}

/// A volume that something wears, where the law has it.
fn known(volumes: Sides<Option<f64>>, side: Side) -> Option<f64> {
    volumes.of(side).filter(|volume| *volume > 0.0)
}

impl LineEnd<'_> {
    fn surface(&self, station: usize, side: Side) -> WornSurface<'_> {
        let profile = &self.profiles[station];
        WornSurface {
            x: profile.x_mm.of(side),
            depth: profile.depth_mm.of(side),
        }
    }

    fn largest_half_width(&self, side: Side) -> f64 {
        let stations = (0..self.profiles.len()).map(|station| {
            let surface = self.surface(station, side);
            scar::half_width(surface.x, surface.depth)
        });
        stations.fold(0.0, f64::max)
    }

    /// Area that is at least as deep as a limit, mm^2.
    fn exposed_area(&self, side: Side, limit: f64) -> f64 {
        let stations = self.cycle.stations.iter().enumerate();
        stations
            .map(|(number, station)| {
                station.weight_mm * self.surface(number, side).exposed_length(limit)
            })
            .sum()
    }

    fn depths_at_positions(&self) -> Vec<f64> {
        let floor = self.surface(self.reference, Side::Receptacle);
        let positions = self.scene.output.stations_mm.iter();
        positions
            .map(|position| interpolation::linear(floor.x, floor.depth, *position))
            .collect()
    }
}
