//! Temperature rises of the unworn contact, and what they change.

use super::Indicators;
use crate::electrical;
use crate::law::heating::spot;
use crate::law::resistance::Deformation;
use crate::law::wear::LocalState;
use crate::scene::{ContactHeat, Effect};
use crate::sides::Side;

/// Distance of 20 °C to the melting temperature of tin, K.
const TIN_K: f64 = 211.9;

impl Indicators<'_> {
    /// Mean and largest temperature rise of the unworn contact by friction, K; a wider one is cooler.
    pub(in crate::effects) fn frictional_heat_k(&self) -> [f64; 2] {
        let blocks = self.blocks.iter().map(Self::frictional_heat_k);
        let hotter = |one: [f64; 2], other: [f64; 2]| [one[0].max(other[0]), one[1].max(other[1])];
        blocks.reduce(hotter).unwrap_or_else(|| {
            let heat = self.frictional_heat_alone();
            [heat.mean_k(), heat.hottest_k()]
        })
    }

    pub(in crate::effects) fn frictional_heat_alone(&self) -> ContactHeat {
        let source = self.scene.mean_sliding_heat(self.sizes.hertz_half_width);
        let friction = self.friction * self.scene.load_n_per_mm;
        ContactHeat::new(&self.scene, source.map(|source| (source, friction)), 0.0)
    }

    /// Largest temperature rise by friction if one spot carried all of the load, K, where the force and the hardnesses are known.
    pub(in crate::effects) fn heat_of_one_spot_k(&self) -> Option<f64> {
        let electrical = self.scene.conduction.known()?;
        let (slider, receptacle) = (self.scene.slider.thermal?, self.scene.receptacle.thermal?);
        let force = electrical.width_mm * self.scene.load_n_per_mm;
        let hardness = Side::BOTH.map(|side| electrical.metals.of(side)[0].hardness_mpa);
        let radius = Deformation::Plastic.radius_mm(force, hardness[0].min(hardness[1]));
        let heat_mw = self.friction * force * self.scene.fastest_speed_mm_s();
        let conductivity = slider.conductivity_w_mk + receptacle.conductivity_w_mk;
        Some(spot::rise_k(heat_mw, radius, conductivity))
    }

    /// Temperature rise of the unworn contact by the current, K, at most.
    pub(in crate::effects) fn joule_heat_k(&self) -> f64 {
        let electrical = self.scene.conduction.known();
        let resistance = electrical
            .filter(|electrical| electrical.current_a.is_some())
            .map(|electrical| {
                electrical::largest_unworn_mohm(electrical, self.scene.load_n_per_mm)
            });
        self.scene.joule_rise_k(resistance.unwrap_or_default())
    }

    /// Largest change of a wear rate that a source of heat could make by materials that are not known: melting as early as tin.
    pub(in crate::effects) fn possible_change_by_heat(&self, effect: Effect) -> f64 {
        let rise_k = match effect {
            Effect::JouleHeating => self.joule_heat_k(),
            _ => self.frictional_heat_k()[0],
        };
        (rise_k / TIN_K).max(self.change_by_heat(rise_k))
    }

    /// Largest relative change of a wear rate by a temperature rise in K.
    pub(in crate::effects) fn change_by_heat(&self, rise_k: f64) -> f64 {
        let pace = self.scene.timed_motion().mean();
        let at = LocalState::mean(self.scene.load_n_per_mm, self.sizes.hertz_half_width, pace);
        let wear = self.scene.surface_wear_at(None);
        self.scene.change_by_heat(&wear, at, rise_k)
    }
}
