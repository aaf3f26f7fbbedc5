//! The report of a computed cycle of a point contact: everything of a section is that of its middle section, z = 0.

use super::{CycleReport, ExtentReport, ResistanceReport, SideReport};
use crate::electrical::ContactResistance;
use crate::interpolation;
use crate::law::plating::bottoms;
use crate::number::real_cycles;
use crate::point::{DepthMap, PointCycle};
use crate::record::{WornSurface, scar};
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// Inputs of a report of a point contact.
pub(crate) struct PointEnd<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) cycle: &'a PointCycle,
    pub(crate) depth: &'a Sides<DepthMap>,
    pub(crate) resistance: Option<&'a ContactResistance>,
}

/// The report of a computed cycle.
pub(crate) fn point_report(end: &PointEnd<'_>) -> CycleReport {
    let PointEnd { scene, cycle, .. } = end;
    let sections = end.depth.as_ref().map(DepthMap::section);
    let surface = |side: Side| WornSurface {
        x: &end.depth.of(side).x_mm,
        depth: sections.of(side),
    };
    let side = |side: Side| SideReport {
        ideal_area_mm2: cycle.ideal_area_mm2.of(side).filter(|area| *area > 0.0),
        worn_volume_mm3: Some(*cycle.worn_volume_mm3.of(side)),
        ideal_volume_mm3: cycle
            .ideal_volume_mm3
            .of(side)
            .filter(|volume| *volume > 0.0),
        // The deepest place of the map: that of the middle section, unless a spot off it is deeper.
        max_depth_mm: *cycle.max_depth_mm.of(side),
        worn_area_mm2: end.depth.of(side).cell_mm().0 * sections.of(side).iter().sum::<f64>(),
        scar_half_width_mm: scar::half_width(surface(side).x, surface(side).depth),
    };
    let stations = scene.output.stations_mm.iter();
    let floor = surface(Side::Receptacle);
    CycleReport {
        cycle: cycle.cycle,
        jump: cycle.jump,
        jump_error: cycle.jump_error,
        sliding_distance_mm: scene.elapsed(real_cycles(cycle.cycle)).0,
        receptacle: side(Side::Receptacle),
        slider: side(Side::Slider),
        station_depth_mm: stations
            .map(|station| interpolation::linear(floor.x, floor.depth, *station))
            .collect(),
        exposed_length_mm: Sides::from_fn(|side| {
            let layers = bottoms(scene.plating(side));
            layers
                .map(|bottom| surface(side).exposed_length(bottom))
                .collect()
        }),
        resistance: end.resistance.map(ResistanceReport::of),
        temperature: None,
        extent: Some(ExtentReport::of(cycle)),
        stations: Vec::new(),
        load_n_per_mm: cycle.line_load_n_per_mm,
        peak_pressure_mpa: cycle.peak_pressure_mpa,
        contact_half_width_mm: cycle.half_length_along_mm,
        dissipated_energy_mj_per_mm: cycle.dissipated_energy_mj_per_mm,
        friction_coefficient: cycle.friction_coefficient,
    }
}
