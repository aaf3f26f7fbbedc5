//! The report of a computed cycle: every scalar of it is one line of a table here.

mod line;
mod point;

use crate::along_line::StationReport;
use crate::cycle::CycleState;
use crate::electrical::ContactResistance;
use crate::interpolation;
use crate::law::plating::bottoms;
use crate::model::{HeatSources, Model};
use crate::point::PointCycle;
use crate::record::channel::declare_report;
use crate::record::exposure::WornSurface;
use crate::record::scar;
use crate::scene::Scene;
use crate::sides::{Side, Sides};
pub(crate) use line::{LineEnd, line_report};
pub(crate) use point::{PointEnd, point_report};

declare_report! {
    /// Wear of one body.
    #[derive(Copy)]
    pub SideReport from surface: &Surface<'_>;
    fields {
        /// k P' s for the whole load sliding the whole imposed distance, mm^2; `None` where nothing wears or a spring
        /// changes the load. Part of the summary, not of the history.
        #[serde(skip)]
        ideal_area_mm2: Option<f64> = surface.ideal_area,
        /// Worn volume, mm^3; `None` of a section.
        #[serde(default)]
        worn_volume_mm3: Option<f64> = None,
        /// Specific wear rate times the sliding work, k F s in gross slip, mm^3; `None` of a section, and where the law has no such
        /// identity.
        #[serde(default)]
        ideal_volume_mm3: Option<f64> = None,
    }
    channels {
        /// Largest worn depth, mm.
        max_depth_mm ["mm", curve "deepest"] = surface.depth.iter().fold(0.0, |m: f64, d| m.max(*d)),
        /// Worn area of the section, mm^2.
        worn_area_mm2 ["mm2"] = surface.widths.iter().zip(surface.depth).map(|(w, d)| w * d).sum(),
        /// Half the width of the scar, mm.
        scar_half_width_mm ["mm"] = scar::half_width(surface.x, surface.depth),
    }
}

declare_report! {
    /// Resistance of the contact at the neutral position.
    #[derive(Copy)]
    pub ResistanceReport from found: &ContactResistance;
    fields {}
    channels {
        /// Resistance of the contact: constriction in both sides, films and the way through the bodies, mOhm.
        contact_resistance_mohm ["mohm"] = found.total_mohm,
        /// Part of it by the constriction in the slider and its layers, mOhm.
        slider_constriction_mohm ["mohm"] = found.constriction_mohm.slider,
        /// Part of it by the constriction in the receptacle and its layers, mOhm.
        receptacle_constriction_mohm ["mohm"] = found.constriction_mohm.receptacle,
        /// Part of it by films on exposed metals, mOhm.
        film_resistance_mohm ["mohm"] = found.film_mohm,
        /// Part of it by the way of the current through the slider to its far face, mOhm.
        slider_bulk_mohm ["mohm"] = found.bulk_mohm.slider,
        /// Part of it by the way of the current through the receptacle to its far face, mOhm.
        receptacle_bulk_mohm ["mohm"] = found.bulk_mohm.receptacle,
        /// Part of the contact's length on which a side shows a metal with a film, -.
        filmed_fraction ["fraction"] = found.filmed_fraction,
        /// Radius of a spot of real contact, um.
        spot_radius_um ["um"] = found.spot_radius_um,
    }
}

declare_report! {
    /// Temperature of a contact that friction or current heats.
    #[derive(Copy)]
    pub TemperatureReport from rise: &(f64, [f64; 2]);
    fields {}
    channels {
        /// Temperature at the hottest place of the contact, its mean over the distance of the last computed cycle, °C.
        contact_temperature_c ["c"] = rise.0 + rise.1[0],
        /// The highest temperature of the contact at any moment so far, °C.
        highest_temperature_c ["c"] = rise.0 + rise.1[1],
    }
}

declare_report! {
    /// A contact of finite width. Quantities per mm of depth beside it are those of its middle section.
    #[derive(Copy)]
    pub ExtentReport from cycle: &PointCycle;
    fields {}
    channels {
        /// Normal force, which a spring reduces as the bodies wear, N.
        load_n ["n"] = cycle.force_n,
        /// Half the length of the contact across the sliding direction, mm.
        contact_half_length_across_mm ["mm"] = cycle.half_length_across_mm,
        /// Accumulated energy dissipated by friction in the whole contact, mJ.
        dissipated_energy_mj ["mj"] = cycle.dissipated_energy_mj,
    }
}

declare_report! {
    /// State after a computed cycle; cycle 0 is the unworn, loaded state.
    pub CycleReport from end: &CycleEnd<'_>;
    fields {
        /// Physical cycles done.
        cycle: u64 = end.state.cycle,
        /// Physical cycles that the last computed cycle represents.
        jump: u64 = end.state.jump.last,
        /// Estimated relative error of worn depth made by the last jump.
        jump_error: f64 = end.state.jump.error,
        /// Accumulated imposed sliding distance, mm.
        sliding_distance_mm: f64 = end.state.sliding_distance,
        /// The receptacle's wear.
        receptacle: SideReport = SideReport::of(&end.surface(Side::Receptacle)),
        /// The slider's wear.
        slider: SideReport = SideReport::of(&end.surface(Side::Slider)),
        /// Worn depth of the receptacle at the stations of the scene, mm.
        station_depth_mm: Vec<f64> = end.station_depths(),
        /// Length on which each layer below the outermost one, or a deeper one, is exposed, mm: from the second layer down to the
        /// base; none without a plating.
        #[serde(default)]
        exposed_length_mm: Sides<Vec<f64>> = Sides::from_fn(|side| end.exposed_lengths(side)),
        /// Resistance of the contact; `None` where it is not computed.
        #[serde(default)]
        resistance: Option<ResistanceReport> = end.resistance.as_ref().map(ResistanceReport::of),
        /// Temperature of the contact; `None` where nothing heats it.
        #[serde(default)]
        temperature: Option<TemperatureReport> = end.temperature().as_ref().map(TemperatureReport::of),
        /// The contact beyond its middle section; `None` of a section.
        #[serde(default)]
        extent: Option<ExtentReport> = None,
        /// The sections along a line, in their order; none of another contact.
        #[serde(default)]
        stations: Vec<StationReport> = Vec::new(),
    }
    channels {
        /// Normal load, which a spring reduces as the bodies wear, N per mm of depth.
        #[serde(default)]
        load_n_per_mm ["n_per_mm"] = end.state.neutral.load,
        /// Highest contact pressure, MPa.
        peak_pressure_mpa ["mpa"] = end.state.neutral.peak_pressure,
        /// Half the width of the contact, mm.
        contact_half_width_mm ["mm"] = end.state.neutral.half_width,
        /// Accumulated energy dissipated by friction, mJ per mm of depth.
        dissipated_energy_mj_per_mm ["mj_per_mm"] = end.state.energy,
        /// Mean coefficient of friction over the contact, weighted by its pressure, -: the limit of the tangential force over the load.
        #[serde(default)]
        friction_coefficient ["coefficient"] = end.state.neutral.friction,
    }
}

impl CycleReport {
    /// The wear of a side.
    pub fn side(&self, side: Side) -> &SideReport {
        match side {
            Side::Slider => &self.slider,
            Side::Receptacle => &self.receptacle,
        }
    }
}

/// The surface of a side as it is worn in a state.
pub(crate) fn worn_surface<'a>(
    model: &'a Model,
    state: &'a CycleState,
    side: Side,
) -> WornSurface<'a> {
    WornSurface {
        x: model.bodies.of(side).contact_x(),
        depth: state.depth.of(side),
    }
}

/// The report of the present state, and of the resistance of its contact if that is computed.
pub fn report(
    scene: &Scene,
    model: &Model,
    state: &CycleState,
    resistance: Option<ContactResistance>,
) -> CycleReport {
    CycleReport::of(&CycleEnd {
        scene,
        model,
        state,
        resistance,
    })
}

/// Inputs of a report.
struct CycleEnd<'a> {
    scene: &'a Scene,
    model: &'a Model,
    state: &'a CycleState,
    resistance: Option<ContactResistance>,
}

/// A worn contact surface.
struct Surface<'a> {
    x: &'a [f64],
    widths: Vec<f64>,
    depth: &'a [f64],
    ideal_area: Option<f64>,
}

impl<'a> CycleEnd<'a> {
    fn surface(&self, side: Side) -> Surface<'a> {
        let interface = &self.model.interface;
        let body = self.model.bodies.of(side);
        // The identity is that of the law, also where nothing slides and the plan leaves wear out.
        let on = self.model.surface;
        let motion = self.scene.timed_motion();
        let wear = match side {
            Side::Slider => self.scene.slider.surface_wear(on, motion.constant()),
            Side::Receptacle => self.scene.receptacle.surface_wear(on, motion.constant()),
        };
        let rate = wear.and_then(|wear| wear.area_rate(motion.mean()));
        let ideal_area = rate
            .filter(|k| *k > 0.0)
            .map(|k| k * interface.load * self.state.sliding_distance)
            .filter(|_| interface.heated_by == HeatSources::default());
        Surface {
            x: body.contact_x(),
            widths: body.contact_widths(),
            depth: self.state.depth.of(side),
            ideal_area: ideal_area.filter(|_| self.scene.spring_n_per_mm2 <= 0.0),
        }
    }

    /// The temperature of the surroundings, °C, and the mean and the largest rise of the contact, K.
    fn temperature(&self) -> Option<(f64, [f64; 2])> {
        let is_heated = self.model.interface.heated_by != HeatSources::default();
        let state = self.state;
        let rises = [state.temperature_rise_k, state.hottest_rise_k];
        is_heated.then_some((self.scene.temperature_c, rises))
    }

    fn exposed_lengths(&self, side: Side) -> Vec<f64> {
        let worn = worn_surface(self.model, self.state, side);
        bottoms(self.scene.plating(side))
            .map(|bottom| worn.exposed_length(bottom))
            .collect()
    }

    fn station_depths(&self) -> Vec<f64> {
        let (x, depth) = (
            self.model.bodies.receptacle.contact_x(),
            &self.state.depth.receptacle,
        );
        let stations = self.scene.output.stations_mm.iter();
        stations
            .map(|&station| interpolation::linear(x, depth, station))
            .collect()
    }
}
