//! A mission of a point contact: its motions one after the other, and what each of them has worn.
//!
//! Totals are of the middle section, at the places of the unworn grids: grids widen and coarsen, and the deepest place of a scar that is
//! symmetric lies in its middle section.

use super::error::PointError;
use super::integrator::PointIntegrator;
use super::point_state::PointState;
use super::section::section;
use super::state::start;
use crate::closed_form::SlipRegime;
use crate::interpolation;
use crate::scene::{Motion, Scene};
use crate::schedule::mission_state::BlockWear;
use crate::schedule::plan::Cycles;
use crate::sides::Sides;

impl PointIntegrator {
    /// Takes the motion of a block of a mission, or of the whole run.
    pub(crate) fn take_motion(&mut self, block: &Scene) {
        self.scene = self.scene.in_block(block, self.slip);
        self.sliding.take_motion(&self.scene);
    }

    /// Moves the slider from the turning point of another motion of the mission to that of the present one, without wear.
    ///
    /// Computed cycles begin and end at a turning point, but the blocks of a mission at the neutral position on the way there: the slider first
    /// returns by the other turning point, so that tractions are those of the last passage. Where all of the contact slips nothing remains
    /// of the motion before but the place of the slider.
    ///
    /// # Errors
    /// A contact without a solution.
    pub(crate) fn change_motion(
        &mut self,
        state: &mut PointState,
        from: Motion,
    ) -> Result<(), PointError> {
        let from = self.scene.in_motion(from, self.slip);
        let (scene, sliding) = (&self.scene, &mut self.sliding);
        let (moved, done) = (&mut state.sliding, state.done);
        moved.passing.clear();
        sliding.begin(moved, Cycles { done, jump: 0 });
        let start_mm = -scene.amplitude_mm;
        let changed = match (from.slip, scene.slip) {
            (_, SlipRegime::Gross) => {
                state.increments.clear();
                moved.forget_shear();
                moved.position = start(scene, &moved.lattice);
                Ok(())
            }
            (SlipRegime::Gross, SlipRegime::Partial) => sliding
                .slip_to_neutral(moved, start_mm.signum())
                .and_then(|()| sliding.slip_partly(moved, start_mm, 0.0)),
            (SlipRegime::Partial, SlipRegime::Partial) => {
                let back_mm = 2.0 * from.amplitude_mm;
                sliding
                    .slip_partly(moved, back_mm, 0.0)
                    .and_then(|()| sliding.slip_partly(moved, start_mm - from.amplitude_mm, 0.0))
            }
        };
        changed.map_err(|error| error.at(done))
    }

    /// Totals of the wear so far at the places of the unworn grids along the middle section.
    pub(crate) fn totals(&self, state: &PointState) -> BlockWear {
        let (surfaces, lattice) = (&state.sliding.surfaces, &state.sliding.lattice);
        let doses = self.doses(state);
        BlockWear::whole(
            state.done,
            state.sliding_distance_mm,
            state.sliding.energy.section.sum(),
            Sides::from_fn(|side| {
                let depths = surfaces.of(side).section_depths_mm();
                lattice.size_mm.0 * depths.sum::<f64>()
            }),
        )
        .with_equivalents(Sides::from_fn(|side| {
            let rate = surfaces.of(side).dose_rate();
            let doses = doses.of(side).iter();
            doses.map(|dose| rate * dose).collect()
        }))
    }

    /// Doses at these places, MPa mm, which depths grow with.
    pub(crate) fn doses(&self, state: &PointState) -> Sides<Vec<f64>> {
        let (surfaces, lattice) = (&state.sliding.surfaces, &state.sliding.lattice);
        Sides::from_fn(|side| {
            let dose = &surfaces.of(side).dose;
            let x: Vec<f64> = lattice.x_mm(side).collect();
            let values: Vec<f64> = section(dose.width(), &dose.values).collect();
            let places = self.unworn.x_mm(side);
            places
                .map(|place| interpolation::linear(&x, &values, place))
                .collect()
        })
    }
}
