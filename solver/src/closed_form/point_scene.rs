//! Input of a run of a point contact.

use super::hertz;
use super::point_accuracy::PointAccuracy;
use super::stroke_parts::StrokeParts;
use crate::law::elastic::{Elastic, Lame, contact_modulus};
use crate::law::surface::SurfaceWear;
use crate::number::{real, real_cycles};
use crate::scene::{Motion, Scene, TurningPoints};
use crate::sides::Sides;

/// Largest amplitude over the half-length of a contact whose surfaces wear in place: what they are displaced over each other by is then
/// small against the scar. Arbitrary.
const LARGEST_PARTIAL: f64 = 0.1;

/// A body: its shape at the contact, its material and its surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointBody {
    /// Radius in the plane of the sliding direction, mm; `None` is straight.
    pub radius_along_mm: Option<f64>,
    /// Radius in the plane across it, mm; `None` is straight.
    pub radius_across_mm: Option<f64>,
    /// Elastic constants.
    pub elastic: Elastic,
    /// Wear of its surface by the dose, with its layers; `None` does not wear.
    pub wear: Option<SurfaceWear>,
}

/// How the contact slips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlipRegime {
    /// All of it, by the whole displacement.
    Gross,
    /// By Coulomb's law at each place: a part may stick. The surfaces wear in place, so that the amplitude must be small against the contact.
    Partial,
}

/// A point contact in reciprocating sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointScene {
    /// Both bodies; the receptacle is at rest.
    pub bodies: Sides<PointBody>,
    /// Normal force F, N.
    pub force_n: f64,
    /// Stiffness of the spring that applies it, which relaxes as the slider sinks, N/mm; 0 for a dead load.
    pub spring_n_per_mm: f64,
    /// Coefficient of friction mu, -; the largest of a run in which it changes.
    pub friction: f64,
    /// How it slips.
    pub slip: SlipRegime,
    /// Amplitude A of the slider, mm: a cycle goes from -A to A and back; one below 0 begins on the other side.
    pub amplitude_mm: f64,
    /// Path of the slider in a cycle.
    pub(crate) path: CyclePath,
    /// Cycles to simulate.
    pub cycles: u64,
    /// Grid and integration.
    pub accuracy: PointAccuracy,
}

/// Path of the slider in a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CyclePath {
    /// From one side of the amplitude to the other, and back.
    ToAndFro,
    /// Between turning points, from the one at -A on.
    Turning(TurningPoints),
    /// Through a contact that stays at its place of the receptacle, mm.
    Continuous {
        /// Length, mm.
        mm: f64,
    },
}

impl CyclePath {
    /// Path of a motion.
    fn of(motion: Motion) -> Self {
        match motion {
            Motion::Reciprocating { .. } => Self::ToAndFro,
            Motion::Periodic { turns, .. } if turns.is_reciprocating() => Self::ToAndFro,
            Motion::Periodic { turns, .. } => Self::Turning(turns),
            Motion::Continuous { step_mm } => Self::Continuous { mm: step_mm },
        }
    }
}

/// Line load of the middle section of the unworn point contact of a scene, N/mm: pi/2 p0 a = 3 F/(4 b), 0 for another scene.
pub fn middle_line_load_n_per_mm(scene: &Scene) -> f64 {
    PointScene::of(scene, SlipRegime::Gross).map_or(0.0, |contact| {
        let (_, across) = contact.half_lengths_mm();
        0.75 * contact.force_n / across
    })
}

/// Half-lengths along and across the sliding direction of the unworn point contact of a scene, mm; `None` for another scene.
pub fn half_lengths_mm(scene: &Scene) -> Option<(f64, f64)> {
    PointScene::of(scene, SlipRegime::Gross).map(|contact| contact.half_lengths_mm())
}

/// Length of a cell of the unworn point contact of a scene, mm; 0 for another scene.
pub fn cell_mm(scene: &Scene) -> f64 {
    PointScene::of(scene, SlipRegime::Gross).map_or(0.0, |contact| {
        contact.half_lengths_mm().0 / contact.accuracy.cells_per_half_length
    })
}

impl PointBody {
    /// Curvatures along and across the sliding direction, 1/mm.
    pub(crate) fn curvature(&self) -> (f64, f64) {
        let curvature = |radius: Option<f64>| radius.map_or(0.0, |radius| 1.0 / radius);
        (
            curvature(self.radius_along_mm),
            curvature(self.radius_across_mm),
        )
    }
}

impl PointScene {
    /// The point contact of a scene with the wear of its surfaces, if it is one: the slider first goes to +x.
    pub fn of(scene: &Scene, slip: SlipRegime) -> Option<Self> {
        let point = scene.dimension.point()?;
        let wear = scene.surface_wear();
        let across = point.radius_across_mm;
        let (slider, block) = (&scene.slider, &scene.receptacle);
        let mut contact = Self {
            bodies: Sides {
                slider: PointBody {
                    radius_along_mm: Some(slider.shape.radius_mm),
                    radius_across_mm: across.slider,
                    elastic: slider.elastic,
                    wear: wear.slider,
                },
                receptacle: PointBody {
                    radius_along_mm: block.shape.crown_radius_mm,
                    radius_across_mm: across.receptacle,
                    elastic: block.elastic,
                    wear: wear.receptacle,
                },
            },
            force_n: point.force_n,
            // A spring per mm of depth acts on the load per mm of depth.
            spring_n_per_mm: scene.spring_n_per_mm2 * point.force_n / scene.load_n_per_mm,
            friction: scene.largest_friction(),
            slip,
            // Passes begin at the turning point on the side of -A.
            amplitude_mm: -scene.motion.amplitude_mm(),
            path: CyclePath::of(scene.motion),
            cycles: scene.cycles,
            accuracy: PointAccuracy::from_tolerance(scene.accuracy.tolerance),
        };
        contact.accuracy = PointAccuracy::of(scene, contact.half_lengths_mm().0);
        Some(contact)
    }

    /// The contact in a block of a mission, or in the whole run, if it may stick as given.
    pub(crate) fn in_block(self, block: &Scene, slip: SlipRegime) -> Self {
        let of_mission = block.cycles_at_a_time.is_some();
        let moving = if of_mission {
            self.in_motion(block.motion, slip)
        } else {
            Self {
                slip,
                ..self.moving(block.motion)
            }
        };
        Self {
            cycles: block.cycles,
            accuracy: PointAccuracy::of(block, self.half_lengths_mm().0),
            ..moving
        }
    }

    /// The contact in the motion of a block of a mission: it slips as a whole where the amplitude is not small against it.
    pub(crate) fn in_motion(self, motion: Motion, slip: SlipRegime) -> Self {
        let moving = self.moving(motion);
        let slip = if moving.may_stick() {
            slip
        } else {
            SlipRegime::Gross
        };
        Self { slip, ..moving }
    }

    /// Passes begin at the turning point on the side of -A.
    fn moving(self, motion: Motion) -> Self {
        Self {
            amplitude_mm: -motion.amplitude_mm(),
            path: CyclePath::of(motion),
            ..self
        }
    }

    /// Contact modulus E*, MPa.
    pub fn modulus(&self) -> f64 {
        contact_modulus(self.bodies.slider.elastic, self.bodies.receptacle.elastic)
    }

    /// Sum of the curvatures of both bodies along and across the sliding direction, 1/mm.
    pub(crate) fn curvature(&self) -> (f64, f64) {
        let (slider, receptacle) = (
            self.bodies.slider.curvature(),
            self.bodies.receptacle.curvature(),
        );
        (slider.0 + receptacle.0, slider.1 + receptacle.1)
    }

    /// Radii of the relative curvature along and across the sliding direction, mm.
    pub(crate) fn radii_mm(&self) -> (f64, f64) {
        let (along, across) = self.curvature();
        (along.recip(), across.recip())
    }

    /// Hertz' half-lengths of the unworn contact along and across the sliding direction, mm.
    pub fn half_lengths_mm(&self) -> (f64, f64) {
        hertz::half_lengths(self.radii_mm(), self.modulus(), self.force_n)
    }

    /// Displacement at which the unworn contact begins to slip as a whole, mm: 3 mu F/(16 a) times the sum of (2 - nu)/G over both bodies
    /// for a circle of the half-length a (Johnson 1985, eq. 7.42), here the mean sqrt(ab) of an ellipse. Amplitudes that are not well
    /// beyond it are in partial slip.
    pub(crate) fn onset_of_gross_slip_mm(&self) -> f64 {
        let (along, across) = self.half_lengths_mm();
        let compliances = self.bodies.as_ref().map(|body| {
            let elastic = body.elastic;
            (2.0 - elastic.poisson_ratio) / Lame::from(elastic).mu
        });
        let compliance = compliances.slider + compliances.receptacle;
        3.0 * self.friction * self.force_n * compliance / (16.0 * (along * across).sqrt())
    }

    /// Width over the half-length of the annulus that slips at the turning points of the unworn contact: 1 - c/a with the stick zone c of
    /// Mindlin's sphere, A/A_c = 1 - (c/a)^2 (Johnson 1985, eq. 7.41); `None` where all of it slips.
    pub fn slip_annulus_over_half_length(&self) -> Option<f64> {
        let sticking = 1.0 - self.amplitude_mm.abs() / self.onset_of_gross_slip_mm();
        (sticking > 0.0).then(|| 1.0 - sticking.sqrt())
    }

    /// Leading-edge step over the indentation that a cycle leaves by specific wear rates in 1/MPa, under a contact of a half-length in mm.
    pub(crate) fn step_over_indentation(&self, rates: Sides<f64>, half_length: f64) -> f64 {
        let stroke = 2.0 * self.amplitude_mm.abs();
        let travel = self.travel_over_receptacle();
        let step = |rate: f64, part: f64| rate * (part * stroke).min(2.0 * half_length);
        let steps = step(rates.slider, 1.0 - travel) + step(rates.receptacle, travel);
        let steps = steps * self.modulus() / half_length;
        match self.path {
            CyclePath::ToAndFro => steps,
            // Half of the path is passed to either side.
            CyclePath::Turning(turns) => steps * turns.path_mm() / (2.0 * stroke),
            CyclePath::Continuous { .. } => 0.0,
        }
    }

    /// Part of the slider's displacement by which the contact travels over the receptacle.
    pub(crate) fn travel_over_receptacle(&self) -> f64 {
        self.bodies.slider.curvature().0 / self.curvature().0
    }

    /// Lengths of the parts of a stroke that have one pressure in an implicit jump, of a contact of a half-length, in the unit of the half-length. On
    /// a crown the contact moves over both bodies, and is not alike along the stroke.
    pub(crate) fn parts(&self, half_length: f64) -> StrokeParts {
        let is_alike = self.travel_over_receptacle() >= 1.0;
        StrokeParts {
            length: self.accuracy.step_over_half_length * half_length,
            half_length,
            part_over_distance: if is_alike {
                self.accuracy.part_over_distance
            } else {
                0.0
            },
        }
    }

    /// Path of a cycle, mm.
    pub(crate) fn path_mm(&self) -> f64 {
        match self.path {
            CyclePath::ToAndFro => 4.0 * self.amplitude_mm.abs(),
            CyclePath::Turning(turns) => turns.path_mm(),
            CyclePath::Continuous { mm } => mm,
        }
    }

    /// Mean displacement of a stroke to either side, mm; the whole distance of a continuous motion, which reverses nowhere.
    pub(crate) fn mean_amplitude_mm(&self) -> f64 {
        match self.path {
            CyclePath::ToAndFro => self.amplitude_mm.abs(),
            CyclePath::Turning(turns) => turns.path_mm() / (2.0 * real(turns.as_slice().len())),
            CyclePath::Continuous { mm } => mm * real_cycles(self.cycles),
        }
    }

    /// Returns `true` if a part of the contact may stick: the slider reverses, and the amplitude is small against the contact.
    pub fn may_stick(&self) -> bool {
        let is_continuous = matches!(self.path, CyclePath::Continuous { .. });
        !is_continuous && self.amplitude_mm.abs() <= LARGEST_PARTIAL * self.half_lengths_mm().0
    }

    /// Largest amplitude in mm for which surfaces wear in place, if a part of the contact may stick.
    pub(crate) fn largest_amplitude_mm(&self) -> f64 {
        match self.slip {
            SlipRegime::Gross => f64::INFINITY,
            SlipRegime::Partial => LARGEST_PARTIAL * self.half_lengths_mm().0,
        }
    }
}
