//! Consequences of the wear of a station: its end, the next jump, other operators.

use std::sync::Arc;

use super::Station;
use crate::ale;
use crate::along_line::{SectionsError, WornSection};
use crate::change::Change;
use crate::law::friction::contact::ContactFriction;
use crate::model::ZONE_WIDENING;
use crate::scene::Accuracy;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::sides::Sides;
use crate::station::meshed::Section;

impl Station {
    /// The section as worn now, for the places of the nodes of each body, mm.
    pub(in crate::station) fn worn<'a>(&'a self, x_mm: Sides<&'a [f64]>) -> WornSection<'a> {
        let state = &self.state;
        let operators = self.section.condensed.operators.as_ref();
        WornSection {
            at: self.place.at,
            weight_mm: self.place.weight_mm,
            x_mm,
            widths_mm: operators.map(|body| &body.widths[..]),
            depth: &state.depth,
            rates: state.jump.rates(),
            worn_area: state.worn_area,
            path: state.path,
            energy: state.energy,
            neutral: state.neutral,
            spines: &self.spines,
        }
    }

    /// Measures what the next jump depends on, after one from these depths that all stations share.
    pub(in crate::station) fn measure_jump(
        &mut self,
        friction: &ContactFriction,
        before: &Sides<Vec<f64>>,
        jump: u64,
    ) {
        let operators = &self.section.condensed.operators;
        let widths = operators.as_ref().map(|body| &body.widths[..]);
        let depth = Change {
            before,
            after: &self.state.depth,
        };
        let wear = &self.interface.wear;
        let worn = EquivalentWear::new(wear, widths, depth);
        let friction = friction.change_at_nodes(wear, widths, depth, worn.depths());
        let control = &mut self.state.jump;
        control.share(jump);
        control.update(worn.weights(), friction, worn.depths(), jump);
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
