//! Both extruded bodies: a model of the section in each node plane, and the operators that all of them have together.

use super::error::ExtrudedError;
use super::scene::ExtrudedScene;
use crate::ale;
use crate::condensation::{ExtrudedOperators, condense_extruded};
use crate::mesh::{NodePlanes, PrismMesh};
use crate::model::{Ends, Model};
use crate::scene::Accuracy;
use crate::sides::{Side, Sides};

/// More contact nodes than this in a zone of a body are refused: its dense compliance takes (2 n)^2 x 8 bytes, 288 MB, and condensation
/// holds three such matrices for a moment.
const MOST_NODES: usize = 3_000;

/// Factor by which zones become wider where a contact has outgrown them.
const WIDER: f64 = 2.0;

/// Meshed and condensed bodies.
pub(super) struct Bodies {
    pub(super) planes: NodePlanes,
    ends: Ends,
    /// The section in each plane, worn as when the operators were built.
    models: Vec<Model>,
    pub(super) operators: ExtrudedOperators,
    pub(super) shares: Vec<f64>,
    /// Width of the zones over that of the layout.
    widened: f64,
}

impl Bodies {
    /// Draws a section out.
    ///
    /// # Errors
    /// [`ExtrudedError`] if it cannot be meshed or condensed.
    pub(super) fn new(scene: &ExtrudedScene, section: Model) -> Result<Self, ExtrudedError> {
        let planes = scene.planes();
        let models = vec![section; planes.count()];
        check(&models, &planes)?;
        Ok(Self {
            operators: condense_extruded(&models, (&planes, scene.ends), None)?,
            shares: planes.shares(),
            ends: scene.ends,
            widened: 1.0,
            models,
            planes,
        })
    }

    /// The section as it was last meshed in the first plane.
    pub(super) fn model(&self) -> &Model {
        &self.models[0]
    }

    /// Condenses again what has drifted from the geometry of the operators, for worn depths of each plane in mm; returns whether something
    /// has.
    ///
    /// # Errors
    /// [`ExtrudedError`] if it cannot be meshed or condensed.
    pub(super) fn follow_wear(
        &mut self,
        depths: &[&Sides<Vec<f64>>],
        accuracy: &Accuracy,
    ) -> Result<bool, ExtrudedError> {
        let planes = || self.models.iter().zip(depths);
        let has_drifted = planes().any(|(model, depth)| ale::has_drifted(model, depth, accuracy));
        if !self.model().relocates || !has_drifted {
            return Ok(false);
        }
        let moved = planes().map(|(model, depth)| ale::relocate(model, depth));
        self.rebuild(moved.collect::<Result<_, _>>()?)?;
        Ok(true)
    }

    /// Gives the bodies wider zones of fine elements.
    ///
    /// # Errors
    /// [`ExtrudedError`] if they cannot be meshed or condensed.
    pub(super) fn widen(&mut self) -> Result<(), ExtrudedError> {
        self.widened *= WIDER;
        let models = self.models.iter().cloned();
        let models = models.map(|model| model.with_zones_widened(self.widened));
        self.rebuild(models.collect::<Result<_, _>>()?)
    }

    fn rebuild(&mut self, models: Vec<Model>) -> Result<(), ExtrudedError> {
        check(&models, &self.planes)?;
        let earlier = (&self.models[..], std::mem::take(&mut self.operators.zones));
        self.operators = condense_extruded(&models, (&self.planes, self.ends), Some(earlier))?;
        self.models = models;
        Ok(())
    }
}

/// Checks sizes and elements.
fn check(models: &[Model], planes: &NodePlanes) -> Result<(), ExtrudedError> {
    for side in Side::BOTH {
        for (number, zone) in models[0].bodies.of(side).zones.iter().enumerate() {
            let nodes = zone.zone.nodes() * planes.count();
            if nodes > MOST_NODES {
                return Err(ExtrudedError::TooLarge {
                    nodes,
                    side: side.name(),
                    limit: MOST_NODES,
                });
            }
            let sections = models
                .iter()
                .map(|model| &model.bodies.of(side).zones[number].mesh);
            PrismMesh::new(sections.collect(), planes).check()?;
        }
    }
    Ok(())
}
