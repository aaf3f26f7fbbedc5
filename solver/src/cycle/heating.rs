//! Heat of friction and current: one temperature of the contact at each moment, from the load, the width and the friction of the last
//! computed cycle.
//!
//! Wear by distance feels the mean of a cycle's temperatures by distance, which the laws of whole cycles have (jumps, extrapolation);
//! each increment has that of its own speed.

use super::CycleState;
use crate::law::softening::Margins;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::model::{HeatSources, Interface};
use crate::number::real_cycles;
use crate::scene::{ContactHeat, Scene};
use crate::sides::Sides;

/// Largest change of a rate within a stroke, over the tolerance, at which a pass still counts as even: it is an error of the shape of a
/// groove, not of its area. The share of the tolerance of one skipped effect.
const EVEN_SHARE: f64 = 0.2;

/// Heat of the contact in the computed cycles of a run.
#[derive(Debug, Clone)]
pub(super) struct Heating {
    sources: HeatSources,
    margins: Sides<Margins>,
    /// Least distance to a melting temperature, K.
    to_melting_k: Option<f64>,
    /// Wear at the temperature of the surroundings.
    cold: Sides<Option<SurfaceWear>>,
    heat: ContactHeat,
    /// True if a pass wears a floor evenly although its temperature changes with the speed.
    pub(super) is_even: bool,
}

impl Heating {
    /// Heating of an interface whose wear is the one at the temperature of the surroundings; `None` where nothing heats the contact.
    pub(super) fn of(
        scene: &Scene,
        interface: &Interface,
        cold: &Sides<Option<SurfaceWear>>,
    ) -> Option<Self> {
        let sources = interface.heated_by;
        (sources != HeatSources::default()).then(|| Self {
            sources,
            margins: scene.margins(),
            to_melting_k: scene.to_melting_k(),
            cold: *cold,
            heat: ContactHeat::new(scene, None, 0.0),
            is_even: true,
        })
    }

    /// Takes the contact at the beginning of a computed cycle, whose mean temperature rise, K, it returns with the wear at it.
    pub(super) fn begin_cycle(
        &mut self,
        scene: &Scene,
        interface: &Interface,
        state: &CycleState,
    ) -> (f64, Sides<Option<SurfaceWear>>) {
        let friction = (self.sources.friction && state.mean_half_width > 0.0)
            .then(|| scene.sliding_heat(state.mean_half_width, real_cycles(state.cycle) + 0.5))
            .flatten()
            .map(|heat| (heat, friction_per_distance(scene, interface, state)));
        let joule = if self.sources.current {
            scene.joule_rise_k(state.constriction_mohm)
        } else {
            0.0
        };
        self.heat = ContactHeat::new(scene, friction, joule);
        let at = LocalState::mean(
            interface.load,
            state.mean_half_width,
            scene.timed_motion().mean(),
        );
        let change = |rise| scene.change_by_heat(&self.cold, at, rise);
        let mean = self.heat.mean_k();
        let uneven = change(self.heat.hottest_k()) - change(mean);
        self.is_even = uneven <= EVEN_SHARE * scene.accuracy.tolerance;
        (mean, self.at(mean))
    }

    /// Largest temperature rise, K.
    pub(super) fn hottest_k(&self) -> f64 {
        self.heat.hottest_k()
    }

    /// Largest temperature rise and that at which a material melts, K, if it does.
    pub(super) fn melts(&self) -> Option<(f64, f64)> {
        self.to_melting_k
            .map(|margin| (self.heat.hottest_k(), margin))
            .filter(|(hottest, margin)| hottest >= margin)
    }

    /// The wear at a speed in mm/s.
    pub(super) fn at_speed(&self, speed_mm_s: f64) -> Sides<Option<SurfaceWear>> {
        self.at(self.heat.rise_k(speed_mm_s))
    }

    fn at(&self, rise_k: f64) -> Sides<Option<SurfaceWear>> {
        let surfaces = self.cold.zip(self.margins);
        surfaces.map(|(wear, margins)| wear.map(|wear| wear.heated(&margins, rise_k)))
    }
}

/// Energy that friction dissipates per depth and distance, N/mm: that of the last computed cycle, at first of gross slip.
fn friction_per_distance(scene: &Scene, interface: &Interface, state: &CycleState) -> f64 {
    let distance = scene.motion.distance_per_cycle_mm();
    if state.energy_per_cycle > 0.0 && distance > 0.0 {
        state.energy_per_cycle / distance
    } else if interface.sticks {
        // How much of the motion slips is not known yet.
        0.0
    } else {
        interface.friction * state.neutral.load
    }
}
