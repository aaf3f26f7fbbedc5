//! Stick and slip of a point contact whose surfaces wear in place: the shear that an increment of displacement leaves, and the slip of
//! each cell, by the bounds mu p under the pressure before the increment.

use super::error::PointError;
use super::state::State;
use crate::closed_form::PointScene;
use crate::contact::area::{SHEAR_TOLERANCE, Shear, ShearCompliance, TangentialContact};

/// Shear below its bound, over the largest bound, from which on a place sticks: what the iteration leaves of its slip would wear it in the
/// many cycles of a jump. A few times the tolerance of the iteration.
const WITHIN: f64 = 10.0 * SHEAR_TOLERANCE;

/// The contact in shear; built for a lattice when it is first needed.
#[derive(Default)]
pub(super) struct StickSlip {
    contact: Option<TangentialContact>,
}

impl StickSlip {
    /// Advances shear and slip by a displacement of the slider in mm, under bounds of the shear at each cell in MPa.
    pub(super) fn advance(
        &mut self,
        scene: &PointScene,
        bounds: &[f64],
        state: &mut State,
        displacement_mm: f64,
    ) -> Result<(), PointError> {
        let elastic = scene.bodies.as_ref().map(|body| body.elastic);
        let cells = state.lattice.cells();
        let contact = self.contact.get_or_insert_with(|| {
            let compliance = ShearCompliance::new([elastic.slider, elastic.receptacle]);
            TangentialContact::new(cells, compliance)
        });
        let mut shear = Shear {
            along: std::mem::take(&mut state.shear.0.values),
            across: std::mem::take(&mut state.shear.1.values),
        };
        let found = contact.advance((displacement_mm, 0.0), bounds, &mut shear);
        (state.shear.0.values, state.shear.1.values) = (shear.along, shear.across);
        let slip = found
            .map_err(|error| PointError::Friction { cycle: 0, error })?
            .slip_mm;
        let within = WITHIN * bounds.iter().fold(0.0, |most: f64, bound| most.max(*bound));
        let shears = state.shear.0.values.iter().zip(&state.shear.1.values);
        let slips = slip.along.iter().zip(&slip.across);
        let places = slips.zip(shears).zip(bounds);
        for (path, (((along, across), (x, z)), bound)) in state.slip.values.iter_mut().zip(places) {
            let sticks = x.hypot(*z) < bound - within;
            *path = if sticks { 0.0 } else { along.hypot(*across) };
        }
        Ok(())
    }
}
