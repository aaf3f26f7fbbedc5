//! The contact of a scene as a source of heat.

use std::borrow::Cow;

use crate::law::heating::{joule, sliding::SlidingHeat};
use crate::law::softening::Margins;
use crate::law::surface::SurfaceWear;
use crate::law::wear::{LocalState, WearLaw};
use crate::number::real_cycles;
use crate::scene::{Conductor, MissingInput, Motion, Scene, TimedMotion};
use crate::sides::{Side, Sides};

/// Part 1/e of a time T at which a logarithm of the time has its mean from 0 to T.
const MEAN_OF_LOGARITHM: f64 = 0.367_879_441_171_442_33;

/// The poorest conductor among metals: less than stainless steels' 16 W/(m K). Arbitrary.
const POOREST: Conductor = Conductor {
    conductivity_w_mk: 10.0,
    diffusivity_mm2_s: None,
};

/// Heat of a contact in its motion.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ContactHeat {
    /// Heat of friction in proportion to the speed; none where it is left out.
    friction: Option<(SlidingHeat, f64)>,
    motion: TimedMotion,
    /// Temperature rise by the current, K.
    joule_k: f64,
}

impl ContactHeat {
    /// The heat of a contact whose friction dissipates an energy per depth and distance, N/mm, and which the current heats by a
    /// temperature rise in K.
    pub(crate) fn new(scene: &Scene, friction: Option<(SlidingHeat, f64)>, joule_k: f64) -> Self {
        Self {
            friction,
            motion: scene.timed_motion(),
            joule_k,
        }
    }

    /// Temperature rise at a speed in mm/s, K.
    pub(crate) fn rise_k(&self, speed_mm_s: f64) -> f64 {
        let friction = self.friction.map_or(0.0, |(heat, n_per_mm)| {
            n_per_mm * heat.rise(speed_mm_s, self.motion.mean().speed())
        });
        friction + self.joule_k
    }

    /// Largest temperature rise, K.
    pub(crate) fn hottest_k(&self) -> f64 {
        self.rise_k(self.motion.fastest().speed())
    }

    /// Mean temperature rise over the distance of a cycle, K: that which counts for wear by distance.
    pub(crate) fn mean_k(&self) -> f64 {
        self.motion.mean_by_distance(|speed| self.rise_k(speed))
    }
}

impl Scene {
    /// Contact of a half-width in mm as a source of frictional heat after so many cycles, if both conductivities are known. Heat of
    /// other blocks of a mission is left out.
    pub(crate) fn sliding_heat(&self, half_width_mm: f64, cycles: f64) -> Option<SlidingHeat> {
        let (slider, receptacle) = (self.slider.thermal?, self.receptacle.thermal?);
        let (resting, passed) = match self.motion {
            Motion::Continuous { .. } => (receptacle, slider),
            Motion::Reciprocating { .. } | Motion::Periodic { .. } => (slider, receptacle),
        };
        let (slider, block) = (self.slider.shape, self.receptacle.shape);
        Some(SlidingHeat {
            half_width_mm,
            amplitude_mm: self.motion.amplitude_mm().abs(),
            period_s: self.motion.period_s().unwrap_or(f64::INFINITY),
            duration_s: self.motion.period_s().map_or(f64::INFINITY, |period| {
                let most = self.cycles_at_a_time.map_or(f64::INFINITY, |cycles| {
                    MEAN_OF_LOGARITHM * real_cycles(cycles)
                });
                period * cycles.min(most)
            }),
            distance_mm: slider.height_mm.max(block.height_mm),
            resting,
            passed,
        })
    }

    /// The same for its mean temperature from the beginning to the end of its cycles; an unknown body conducts as the poorest metal.
    pub(crate) fn mean_sliding_heat(&self, half_width_mm: f64) -> Option<SlidingHeat> {
        let mut known = Cow::Borrowed(self);
        if self.slider.thermal.is_none() || self.receptacle.thermal.is_none() {
            let scene = known.to_mut();
            scene.slider.thermal.get_or_insert(POOREST);
            scene.receptacle.thermal.get_or_insert(POOREST);
        }
        known.sliding_heat(half_width_mm, MEAN_OF_LOGARITHM * real_cycles(self.cycles))
    }

    /// Returns the input that the temperature of the contact, or its effect on the wear, lacks.
    pub(crate) fn heat_lacks(&self, by_friction: bool) -> Option<MissingInput> {
        if by_friction && (self.slider.thermal.is_none() || self.receptacle.thermal.is_none()) {
            return Some(MissingInput::Conductivity);
        }
        let lacks = Sides {
            slider: self.slider.softening.lacks_melting,
            receptacle: self.receptacle.softening.lacks_melting,
        };
        (lacks.slider || lacks.receptacle).then_some(MissingInput::MeltingTemperature(lacks))
    }

    /// Temperature rise, K, by the current through a resistance of the contact in mOhm.
    pub(crate) fn joule_rise_k(&self, contact_mohm: f64) -> f64 {
        let electrical = self.conduction.known();
        let current_a = electrical.and_then(|electrical| electrical.current_a);
        current_a.map_or(0.0, |current| {
            joule::rise_k(1e-3 * contact_mohm * current, self.temperature_c)
        })
    }

    /// Least distance of the surroundings to the melting temperature of a material, K, if one is known.
    pub(crate) fn to_melting_k(&self) -> Option<f64> {
        let sides = [&self.slider.softening, &self.receptacle.softening];
        let known = sides.into_iter().filter_map(|side| side.to_melting_k);
        known.reduce(f64::min)
    }

    /// Distances of both surfaces to the melting temperatures of their layers.
    pub(crate) fn margins(&self) -> Sides<Margins> {
        Sides {
            slider: self.slider.softening.margins(),
            receptacle: self.receptacle.softening.margins(),
        }
    }

    /// Largest relative change of a wear rate by a temperature rise in K.
    pub(crate) fn change_by_heat(
        &self,
        wear: &Sides<Option<SurfaceWear>>,
        at: LocalState,
        rise_k: f64,
    ) -> f64 {
        let (margins, motion) = (self.margins(), self.timed_motion());
        let rate = |law: WearLaw| {
            let mean = motion.mean_wear(SurfaceWear::Law(law)).uniform();
            mean.unwrap_or_else(|| law.rate(at).value)
        };
        let change = |side: Side| {
            let wear = wear.of(side).as_ref();
            wear.map_or(0.0, |wear| {
                wear.change_by_heat(margins.of(side), at, rate, rise_k)
            })
        };
        change(Side::Slider).max(change(Side::Receptacle))
    }
}
