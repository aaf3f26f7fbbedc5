//! Consequences of the wear of a station: its end, the next jump, other operators.

use std::sync::Arc;

use super::Station;
use crate::ale;
use crate::along_line::{self, SectionsError};
use crate::change::Change;
use crate::law::surface::{self, SurfaceWear};
use crate::law::wear::LocalState;
use crate::model::ZONE_WIDENING;
use crate::scene::Accuracy;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::sides::{Side, Sides};
use crate::station::meshed::Section;

impl Station {
    /// Integrals of the worn depths, mm^2.
    pub(in crate::station) fn worn_section(&self) -> Sides<f64> {
        Sides::from_fn(|side| {
            let widths = &self.section.condensed.operators.of(side).widths;
            let nodes = self.state.depth.of(side).iter().zip(widths);
            nodes.map(|(depth, width)| depth * width).sum()
        })
    }

    /// |worn area of the profile - integral of the wear rate| over the latter, of the worse side.
    pub(in crate::station) fn worn_area_residual(&self) -> f64 {
        along_line::worn_area_residual(self.worn_section(), self.state.worn_area)
    }

    /// Depth of the receptacle's groove below the higher one of its ends, mm.
    pub(in crate::station) fn groove_mm(&self) -> f64 {
        along_line::groove_mm(&self.state.depth.receptacle)
    }

    /// Returns `true` if a body is nearly consumed.
    pub(in crate::station) fn is_worn_through(&self) -> bool {
        self.spines.are_worn_through(&self.state.depth)
    }

    /// Cycles until a body is nearly consumed or the groove is as deep as a radius in mm, at the present rate.
    pub(in crate::station) fn cycles_left(&self, radius_mm: f64) -> f64 {
        let (wear, equivalent) = (&self.interface.wear, self.state.jump.rates());
        let rates = Sides::from_fn(|side| {
            let depth = self.state.depth.of(side);
            surface::at_relative_rates(*wear.of(side), equivalent.of(side), depth)
        });
        let fastest = rates
            .receptacle
            .iter()
            .fold(f64::MIN_POSITIVE, |most, rate| rate.max(most));
        let groove = (radius_mm - self.groove_mm()) / fastest;
        let rates = rates.as_ref().map(|rates| &rates[..]);
        self.spines
            .cycles_left(&self.state.depth, rates)
            .min(groove.max(0.0))
    }

    /// Largest wear rates from the surfaces down to the worn depths, 1/MPa.
    pub(in crate::station) fn rates(&self) -> Sides<f64> {
        let wear = self.interface.wear.zip(self.state.depth.largest_of_each());
        wear.map(|(wear, depth)| {
            wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
        })
    }

    /// Returns `true` if a rate depends on the worn depth.
    pub(in crate::station) fn wears_by_depth(&self) -> bool {
        let wear = self.interface.wear;
        let by_depth = |side| wear.of(side).is_some_and(SurfaceWear::depends_on_depth);
        Side::BOTH.into_iter().any(by_depth)
    }

    /// Measures what the next jump depends on, after one from these depths that all stations share.
    pub(in crate::station) fn measure_jump(&mut self, before: &Sides<Vec<f64>>, jump: u64) {
        let operators = &self.section.condensed.operators;
        let widths = operators.as_ref().map(|body| &body.widths[..]);
        let depth = Change {
            before,
            after: &self.state.depth,
        };
        let worn = EquivalentWear::new(&self.interface.wear, widths, depth);
        let control = &mut self.state.jump;
        control.share(jump);
        control.update(worn.weights(), 0.0, worn.depths(), jump);
    }

    /// Returns `true` if the section has drifted from the geometry of its operators; these are then those of the present depths.
    pub(in crate::station) fn drifts(&mut self, accuracy: &Accuracy) -> bool {
        let model = &self.section.model;
        let drifted = model.relocates && ale::has_drifted(model, &self.state.depth, accuracy);
        if drifted {
            self.state.built = Some(self.state.depth.clone());
        }
        drifted
    }

    /// Records that the zones of fine elements must be wider.
    pub(in crate::station) fn widen(&mut self) {
        self.state.widened *= ZONE_WIDENING;
    }

    /// Meshes and condenses the section where it is not at the geometry of the state.
    ///
    /// # Errors
    /// [`SectionsError`] if it cannot be meshed or condensed.
    pub(in crate::station) fn follow_state(
        &mut self,
        unworn: &Arc<Section>,
    ) -> Result<(), SectionsError> {
        if unworn.is_of(&self.state) {
            self.section = Arc::clone(unworn);
        } else if !self.section.is_of(&self.state) {
            self.section = Arc::new(Section::of(&unworn.model, &self.state)?);
        }
        Ok(())
    }
}
