//! Indicators: how much an effect changes the outputs, relative, at given worn depths.
//!
//! R radius of relative curvature, A amplitude, A_c displacement of gross slip, h worn depth, P load, k spring.

mod heat;

use std::borrow::Cow;
use std::f64::consts::PI;

use super::across_width;
use super::bending;
use super::dimension;
use super::plasticity::{self, Yield};
use super::small_strain;
use crate::closed_form::{expected_wear, unworn_contact};
use crate::law::elastic::dundurs_beta;
use crate::law::skin_effect;
use crate::law::surface::SurfaceWear;
use crate::number::{real, real_cycles};
use crate::resolution::{self, Sizes};
use crate::scene::{Drive, Effect, Motion, Scene};
use crate::sides::{Side, Sides};

/// Relative change of the outputs without rebuilt stiffness, over the square of the worn part of the height and what is left of it. Measured:
/// the peak pressure changed by 0.7 % at 46 % of the height (fuzz button), by 2.0 % at 53 % and 1.7 % at 97 % (blocks 0.02 mm high
/// under scars of 0.7 and 1 mm), a third of that over its wider tolerance; depths by 0.01 %.
const CHANGE_PER_LOST_HEIGHT: f64 = 0.0125;

/// Largest change by lost slip along a line, where it is part of the stated errors alone, over that of an unworn contact. Walls that jam have no
/// bound; measured on the plane section of the thesis' wire at 0.35 N/mm and mu = 1.21: 0.5 % of the depth of 32 um for a lost slip
/// of 0.1 %.
const LOST_AT_WALLS: f64 = 5.0;

/// Inputs of the indicators of a scene, besides its worn depths.
pub(super) struct Indicators<'a> {
    scene: Cow<'a, Scene>,
    /// Indicators of the blocks of a mission; none without a mission.
    blocks: Vec<Indicators<'a>>,
    sizes: Sizes,
    /// Wear of the sides that are not switched off, and its rates.
    wear: Sides<Option<SurfaceWear>>,
    rates: Sides<f64>,
    /// The largest coefficient of the run, -.
    friction: f64,
    radius: f64,
    /// A_c/A.
    lost_slip: f64,
}

impl<'a> Indicators<'a> {
    pub(super) fn of(scene: &'a Scene) -> Self {
        let mut blocks = Vec::new();
        if scene.mission.is_some() {
            let moving = scene.blocks().into_iter();
            let moving = moving.filter(|block| block.motion.distance_per_cycle_mm() > 0.0);
            blocks.extend(moving.map(|block| Self::alone(block, Vec::new())));
        }
        Self::alone(Cow::Borrowed(scene), blocks)
    }

    fn alone(scene: Cow<'a, Scene>, blocks: Vec<Self>) -> Self {
        let sizes = resolution::choose(&scene);
        Self {
            blocks,
            wear: scene.surface_wear(),
            rates: expected_wear::wear_rates(&scene, sizes.hertz_half_width),
            friction: scene.largest_friction(),
            radius: unworn_contact::radius(&scene),
            lost_slip: lost_slip(&scene, sizes.hertz_half_width),
            sizes,
            scene,
        }
    }

    /// Estimated largest worn depths after so many cycles, mm.
    pub(super) fn worn_depth_after(&self, cycles: u64) -> Sides<f64> {
        let half_width = self.sizes.hertz_half_width;
        expected_wear::worn_depth_after(&self.scene, half_width, &self.wear, cycles)
    }

    /// Those at the end.
    pub(super) fn worn_depth_at_end(&self) -> Sides<f64> {
        let cycles = expected_wear::expected_cycles(&self.scene, self.sizes.hertz_half_width);
        self.worn_depth_after(cycles)
    }

    /// Hertz half-width of the unworn contact, mm.
    pub(super) fn hertz_half_width(&self) -> f64 {
        self.sizes.hertz_half_width
    }

    /// The indicator of an effect at these largest worn depths, mm: the largest of all blocks of a mission.
    pub(super) fn value(&self, effect: Effect, depth: Sides<f64>) -> f64 {
        let blocks = self.blocks.iter().map(|block| block.value(effect, depth));
        let largest = blocks.reduce(f64::max);
        largest.unwrap_or_else(|| self.value_alone(effect, depth))
    }

    fn value_alone(&self, effect: Effect, depth: Sides<f64>) -> f64 {
        if let Some(value) = dimension::value(&self.scene, effect) {
            return value;
        }
        match effect {
            Effect::Elasticity | Effect::Resistance => 1.0,
            Effect::Friction => self.friction(depth),
            Effect::StickMemory if self.scene.dimension.has_sections() => {
                self.lost_slip(depth).min(LOST_AT_WALLS * self.lost_slip)
            }
            Effect::StickMemory => self.lost_slip(depth),
            Effect::ReceptacleWear => self.wear(Side::Receptacle, depth),
            Effect::SliderWear => {
                let flat = (2.0 * self.radius * depth.slider).sqrt();
                let amplitude = self.scene.motion.amplitude_mm();
                let wider = if amplitude > 0.0 {
                    flat / amplitude
                } else {
                    0.0
                };
                self.wear(Side::Slider, depth).max(wider)
            }
            Effect::Plating => {
                let through = |side| {
                    let outer = self.scene.plating(side).first();
                    outer.map_or(0.0, |layer| depth.of(side) / layer.thickness_mm)
                };
                through(Side::Slider).max(through(Side::Receptacle))
            }
            Effect::ThermalSoftening => {
                let (slider, receptacle) = (&self.scene.slider, &self.scene.receptacle);
                slider.softening.change().max(receptacle.softening.change())
            }
            Effect::FrictionalHeating => self.change_by_heat(self.frictional_heat_alone().mean_k()),
            Effect::JouleHeating => self.change_by_heat(self.joule_heat_k()),
            Effect::Relocation => self.relocation(depth),
            Effect::SpringFading => {
                let Scene {
                    spring_n_per_mm2: spring,
                    load_n_per_mm: load,
                    ..
                } = *self.scene;
                0.5 * (depth.slider + depth.receptacle) * spring / load
            }
            Effect::SkinEffect => {
                let ratios = self.over_skin_depth().map(skin_effect::wire_ratio);
                ratios.slider.max(ratios.receptacle) - 1.0
            }
            Effect::GeometricNonlinearity => small_strain::cost(&self.scene),
            Effect::Plasticity => Yield::of(&self.scene).map_or(0.0, |unworn| unworn.ratio()),
            Effect::AcrossWidth => 1.0 - self.life_of_ball(depth),
            Effect::Oxidation
            | Effect::Relaxation
            | Effect::Inertia
            | Effect::ThirdBody
            | Effect::MetalTransfer
            | Effect::Fatigue => 0.0,
        }
    }

    /// Peak pressure over hardness at which the contact begins to yield, -.
    pub(super) fn onset_of_yield(&self) -> f64 {
        plasticity::onset(&self.scene, self.friction)
    }

    /// Life of a ball over that of the section, at these depths if the tip is not plated; 1 where the width is not known.
    pub(super) fn life_of_ball(&self, depth: Sides<f64>) -> f64 {
        let known = self.scene.conduction.known();
        known.map_or(1.0, |known| {
            across_width::life_of_ball(known.width_mm, self.radius, self.depth_of_life(depth))
        })
    }

    /// Thickness of the outermost layer of the tip, or of the pad beside one that does not wear; these depths of bare parts, mm.
    pub(super) fn depth_of_life(&self, depth: Sides<f64>) -> f64 {
        let side = if self.wear.slider.is_some() {
            Side::Slider
        } else {
            Side::Receptacle
        };
        let outermost = self.scene.plating(side).first();
        outermost.map_or(*depth.of(side), |layer| layer.thickness_mm)
    }

    /// Half of the smaller dimension of each body over the skin depth of its base; 0 for a direct current.
    fn over_skin_depth(&self) -> Sides<f64> {
        let (slider, block) = (self.scene.slider.shape, self.scene.receptacle.shape);
        let half = Sides {
            slider: slider.half_width_mm.min(0.5 * slider.height_mm),
            receptacle: 0.5 * block.length_mm.min(block.height_mm),
        };
        half.zip(self.skin_depth_mm())
            .map(|(half, depth)| half / depth)
    }

    /// Skin depth in the base of each body, mm; without bound for a direct current.
    pub(super) fn skin_depth_mm(&self) -> Sides<f64> {
        let known = self.scene.conduction.known();
        let depth = |side| {
            let electrical = known?;
            let base = electrical.metals.of(side).last()?;
            Some(skin_effect::depth_mm(
                base.resistivity_ohm_m,
                electrical.frequency_hz?,
            ))
        };
        Sides::from_fn(|side| depth(side).unwrap_or(f64::INFINITY))
    }

    /// Largest part of either body's height that is worn off.
    fn relocation(&self, depth: Sides<f64>) -> f64 {
        let Scene {
            slider, receptacle, ..
        } = &*self.scene;
        let slider = depth.slider / slider.shape.height_mm;
        let lost = slider.max(depth.receptacle / receptacle.shape.height_mm);
        // The mesh is part of the fields.
        let changed = CHANGE_PER_LOST_HEIGHT * lost * lost / (1.0 - lost).max(0.0);
        if self.scene.output.fields {
            changed.max(lost)
        } else {
            changed
        }
    }

    fn friction(&self, depth: Sides<f64>) -> f64 {
        let (slider, receptacle) = (self.scene.slider.elastic, self.scene.receptacle.elastic);
        let held = [self.scene.drive == Drive::WholeBody, false];
        let unlike = self.friction * dundurs_beta(slider, receptacle, held);
        let stress = if self.scene.output.fields {
            self.friction
        } else {
            0.0
        };
        let climbs = self.climb(depth).powi(2);
        // Where nothing may stick, no slip is lost.
        let lost = match self.scene.effects.of(Effect::StickMemory) {
            Some(false) => 0.0,
            _ => self.lost_slip(depth),
        };
        lost.max(climbs)
            .max(unlike * unlike)
            .max(stress)
            .max(bending::indicator(
                &self.scene,
                self.friction,
                self.radius,
                depth,
            ))
    }

    /// The tangential deformation grows with the normal force of a slider that climbs the edge of its scar, which is without
    /// bound where it jams.
    fn lost_slip(&self, depth: Sides<f64>) -> f64 {
        let lost = self.lost_slip / (1.0 - self.climb(depth)).max(0.0);
        let by_time = |wear: Option<SurfaceWear>| {
            wear.is_some_and(|wear| {
                wear.is_by_time() || matches!(wear, SurfaceWear::ByPower { .. })
            })
        };
        if by_time(self.wear.slider) || by_time(self.wear.receptacle) {
            lost.max(share_of_time(lost))
        } else {
            lost
        }
    }

    /// mu times the steepest slope that the slider climbs: that of the arc at the edge of the scar, at the half-width
    /// sqrt(2 R h), and on the corner of a block that it leaves.
    fn climb(&self, depth: Sides<f64>) -> f64 {
        let worn = depth.slider + depth.receptacle;
        let scar = (2.0 * worn / self.radius).sqrt();
        self.friction * scar.max(self.corner_slope())
    }

    /// Slope of the arc on the corner of the block at the turning point.
    fn corner_slope(&self) -> f64 {
        let half_block = 0.5 * self.scene.receptacle.shape.length_mm;
        let over = self.scene.motion.amplitude_mm().abs() - half_block;
        let radius = self.scene.slider.shape.radius_mm;
        if over <= 0.0 {
            0.0
        } else if over < radius {
            over / (radius * radius - over * over).sqrt()
        } else {
            f64::INFINITY
        }
    }

    /// The more it wears beside the other body, the more it changes.
    fn wear(&self, side: Side, depth: Sides<f64>) -> f64 {
        // The worn depth of the side decides about the friction.
        if self.scene.friction.follows_wear_of(side) {
            return 1.0;
        }
        let share = |values: Sides<f64>, factor: f64| {
            let (own, other) = (*values.of(side), *values.of(side.other()));
            if own > 0.0 {
                own / (factor * other).max(own)
            } else {
                0.0
            }
        };
        share(depth, 1.0).max(share(self.rates, 3.0))
    }
}

/// Part of the time of a pass of a sine that the first part of its displacement takes.
fn share_of_time(part: f64) -> f64 {
    (1.0 - 2.0 * part.min(1.0)).acos() / PI
}

/// Slip that the tangential deformation takes at a reversal, over the displacement that it is taken from; a continuous motion
/// reverses nowhere and loses it once.
fn lost_slip(scene: &Scene, half_width: f64) -> f64 {
    let displacement = match scene.motion {
        Motion::Reciprocating { amplitude_mm, .. } => amplitude_mm.abs(),
        // As if all strokes had the mean length.
        Motion::Periodic { turns, .. } => turns.path_mm() / (2.0 * real(turns.as_slice().len())),
        Motion::Continuous { step_mm } => step_mm.abs() * real_cycles(scene.cycles),
    };
    let lost = unworn_contact::gross_slip(scene, half_width);
    if lost > 0.0 { lost / displacement } else { 0.0 }
}
