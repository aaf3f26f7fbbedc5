//! Inputs of the schedule of a run: one jump and one series of increments for all planes.

use crate::change::Change;
use crate::extruded::cycle::ExtrudedContact;
use crate::extruded::state::Planes;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stroke::{Movement, Stroke};
use crate::sides::{Side, Sides};

impl ExtrudedContact {
    /// Largest wear rates from the surfaces down to the worn depths, 1/MPa.
    fn rates(&self) -> Sides<f64> {
        let states = self.planes.states.iter();
        let depths = states.map(|state| state.depth.largest_of_each());
        let depth = depths.fold(Sides::default(), |most: Sides<f64>, depth| {
            most.zip(depth).map(|(most, depth)| most.max(depth))
        });
        let wear = self.interface.wear.zip(depth);
        wear.map(|(wear, depth)| {
            wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
        })
    }

    /// A shorter jump where a rate depends on the depth and the estimated error far exceeds what it may be.
    pub(super) fn shorter_jump(&self, jump: u64) -> Option<u64> {
        let wear = self.interface.wear;
        let by_depth = |side| wear.of(side).is_some_and(SurfaceWear::depends_on_depth);
        if !Side::BOTH.into_iter().any(by_depth) {
            return None;
        }
        let control = &self.common.jump;
        control.rejected(&self.plane.accuracy, self.stroke(), jump)
    }

    /// Measures what the next jump depends on. Its error is that of the volume: nodes weigh by their width and by the length of their plane.
    pub(super) fn measure_jump(&mut self, before: &Planes, jump: u64) {
        let shares = &self.bodies.shares;
        let widths = self.bodies.operators.sections.as_ref().map(|section| {
            let planes = shares.iter();
            let planes =
                planes.flat_map(|share| section.widths.iter().map(move |width| share * width));
            planes.collect::<Vec<f64>>()
        });
        let depths = |planes: &Planes| {
            Sides::from_fn(|side| {
                let depths = planes.states.iter().flat_map(|state| state.depth.of(side));
                depths.copied().collect::<Vec<f64>>()
            })
        };
        let (before, after) = (depths(before), depths(&self.planes));
        let depth = Change {
            before: &before,
            after: &after,
        };
        let wear = &self.interface.wear;
        let worn = EquivalentWear::new(wear, widths.as_slices(), depth);
        let control = &mut self.common.jump;
        control.update(worn.weights(), 0.0, worn.depths(), jump);
    }

    /// Limits of the jump besides its error. Every jump wears in the increments of one cycle: nothing is extrapolated in a groove.
    pub(super) fn stroke(&self) -> Stroke {
        let amplitude = self.plane.motion.amplitude_mm().abs();
        let half_width = self.planes.mean_half_width;
        let mut stroke = Stroke::new(
            &self.plane.accuracy.tuning,
            self.rates(),
            self.interface.modulus,
            Movement {
                amplitude,
                half_width: half_width.max(self.common.unworn_half_width),
                travel: 1.0,
                sticks: false,
            },
            self.plane.cycles,
        );
        stroke.is_groove = false;
        stroke
    }

    /// Mean half-width of the contact of a single cycle, mm: planes take the load from each other.
    fn single_cycle_half_width(&self) -> f64 {
        let states = self.planes.states.iter();
        let planes = states.zip(&self.bodies.shares);
        let mean: f64 = planes
            .map(|(state, share)| share * state.neutral.half_width)
            .sum();
        mean.max(self.common.unworn_half_width)
    }

    /// Increments and replays of a cycle.
    pub(super) fn plan(&self, cycles: Cycles) -> CyclePlan {
        let followed = Followed {
            half_width: self.planes.mean_half_width,
            single: self.single_cycle_half_width(),
            sticks: false,
        };
        let (motion, accuracy) = (self.plane.motion, &self.plane.accuracy);
        CyclePlan::new(motion, accuracy, followed, self.stroke(), cycles, false)
    }
}
