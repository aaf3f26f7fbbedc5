//! A meshed section with its operators, which stations share until they are worn unlike.

use super::state::StationState;
use crate::ale;
use crate::along_line::SectionsError;
use crate::condensation::{self, Condensed};
use crate::model::Model;
use crate::sides::Sides;

/// A meshed section with its operators.
pub(super) struct Section {
    pub(super) model: Model,
    pub(super) condensed: Condensed,
    /// Worn depths that it was meshed at, mm, and the width of its zones over that of the layout.
    built: Option<Sides<Vec<f64>>>,
    widened: f64,
}

impl Section {
    /// The unworn section.
    ///
    /// # Errors
    /// [`SectionsError`] if it cannot be condensed.
    pub(super) fn unworn(model: Model) -> Result<Self, SectionsError> {
        Ok(Self {
            condensed: condensation::condense(&model, 1)?,
            model,
            built: None,
            widened: 1.0,
        })
    }

    /// The section at the geometry that a state was computed with, from the unworn one.
    pub(super) fn of(unworn: &Model, state: &StationState) -> Result<Self, SectionsError> {
        let model = match &state.built {
            None => unworn.clone(),
            Some(depth) => ale::relocate(unworn, depth)?,
        };
        let model = model.with_zones_widened(state.widened)?;
        Ok(Self {
            condensed: condensation::condense(&model, 1)?,
            model,
            built: state.built.clone(),
            widened: state.widened,
        })
    }

    /// Returns `true` if it is at the geometry that a state was computed with.
    pub(super) fn is_of(&self, state: &StationState) -> bool {
        self.built == state.built && self.widened.to_bits() == state.widened.to_bits()
    }
}
