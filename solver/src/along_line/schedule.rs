//! Inputs of the schedule of sections along a line.

use crate::law::elastic::contact_modulus;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::scene::{Motion, Scene};
use crate::schedule::jump::JumpControl;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stroke::{Movement, Stroke};
use crate::sides::Sides;

/// A section whose jumps and increments are chosen.
pub(crate) struct FollowedSection<'a> {
    pub(crate) plane: &'a Scene,
    /// Motion of the slider across the line.
    pub(crate) motion: Motion,
    pub(crate) wear: Sides<Option<SurfaceWear>>,
    /// Deepest wear, mm.
    pub(crate) depth: Sides<f64>,
    /// Half-widths of the unworn contact, of that at the neutral position and the mean over the last computed cycle, mm.
    pub(crate) unworn_half_width: f64,
    pub(crate) neutral_half_width: f64,
    pub(crate) mean_half_width: f64,
}

impl FollowedSection<'_> {
    /// Limits of the jump besides its error and the change of the friction. Every jump wears in the increments of one cycle: nothing is extrapolated in a groove.
    fn stroke(&self) -> Stroke {
        let plane = self.plane;
        let half_width = self.mean_half_width.max(self.unworn_half_width);
        // Largest rates from the surfaces down to the worn depths.
        let rates = self.wear.zip(self.depth).map(|(wear, depth)| {
            wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
        });
        let mut stroke = Stroke::new(
            &plane.accuracy.tuning,
            rates,
            contact_modulus(plane.slider.elastic, plane.receptacle.elastic),
            Movement {
                amplitude: self.motion.amplitude_mm().abs(),
                half_width: half_width.max(f64::MIN_POSITIVE),
                travel: 1.0,
                sticks: false,
            },
            plane.cycles,
        );
        stroke.is_groove = false;
        stroke
    }

    /// The same after so many cycles, by the change of the friction as well.
    pub(crate) fn stroke_after(&self, done: u64) -> Stroke {
        let mut stroke = self.stroke();
        stroke.limit_change_of_friction(self.plane, done);
        stroke
    }

    /// Increments and replays of a cycle.
    pub(crate) fn plan(&self, cycles: Cycles) -> CyclePlan {
        let followed = Followed {
            half_width: self.mean_half_width,
            single: self.neutral_half_width.max(self.unworn_half_width),
            sticks: false,
        };
        let (accuracy, stroke) = (&self.plane.accuracy, self.stroke());
        CyclePlan::new(self.motion, accuracy, followed, stroke, cycles, false)
    }

    /// A shorter jump where the estimated error of one far exceeds what it may be.
    pub(crate) fn shorter_jump(&self, control: &JumpControl, jump: u64) -> Option<u64> {
        control.shorter(self.plane, &self.wear, self.stroke(), jump)
    }
}
