//! Both extruded bodies: a model of the section in each node plane, and the operators that all of them have together.

use super::error::ExtrudedError;
use super::scene::ExtrudedScene;
use super::state::CommonPlaneState;
use crate::ale;
use crate::along_line::SectionsError;
use crate::condensation::{ExtrudedOperators, condense_extruded};
use crate::mesh::{NodePlanes, PrismMesh};
use crate::model::{BodyModel, Model};
use crate::scene::Accuracy;
use crate::sides::{Side, Sides};

/// Meshed and condensed bodies.
pub(super) struct Bodies {
    pub(super) planes: NodePlanes,
    scene: ExtrudedScene,
    unworn: Model,
    /// The section in each plane, worn as when the operators were built.
    pub(super) models: Vec<Model>,
    pub(super) operators: ExtrudedOperators,
    pub(super) shares: Vec<f64>,
    /// Worn depths that the operators were built for, mm.
    built: Vec<Sides<Vec<f64>>>,
    widenings: u32,
}

impl Bodies {
    /// Draws a section out.
    ///
    /// # Errors
    /// [`ExtrudedError`] if it cannot be meshed or condensed.
    pub(super) fn new(scene: &ExtrudedScene, section: Model) -> Result<Self, ExtrudedError> {
        let planes = scene.planes();
        let models = vec![section.clone(); planes.count()];
        check(scene, &models, &planes)?;
        Ok(Self {
            operators: condense_extruded(&models, &planes, scene.ends, None, scene.section.threads)
                .map_err(SectionsError::from)?,
            shares: planes.shares(),
            scene: scene.clone(),
            unworn: section,
            built: Vec::new(),
            widenings: 0,
            models,
            planes,
        })
    }

    /// The unworn section.
    pub(super) fn unworn(&self) -> &Model {
        &self.unworn
    }

    /// Width of both bodies, mm.
    pub(super) fn width_mm(&self) -> f64 {
        self.scene.width_mm
    }

    /// Degrees of freedom of both meshes.
    pub(super) fn dofs(&self) -> usize {
        let bodies = &self.unworn.bodies;
        let section = bodies.slider.dofs() + bodies.receptacle.dofs();
        // Three displacements of a node instead of two.
        3 * (section / 2) * self.planes.count()
    }

    /// Returns `true` if a plane has drifted from the geometry of the operators, for worn depths of each plane in mm.
    pub(super) fn have_drifted<'a>(
        &self,
        depths: impl IntoIterator<Item = &'a Sides<Vec<f64>>>,
        accuracy: &Accuracy,
    ) -> bool {
        let mut planes = self.models.iter().zip(depths);
        self.unworn.relocates
            && planes.any(|(model, depth)| ale::has_drifted(model, depth, accuracy))
    }

    /// Meshes and condenses again what is not at the geometry of a state.
    ///
    /// # Errors
    /// [`ExtrudedError`] if it cannot be meshed or condensed.
    pub(super) fn follow(&mut self, common: &CommonPlaneState) -> Result<(), ExtrudedError> {
        if self.built == common.built && self.widenings == common.widenings {
            return Ok(());
        }
        let widened = f64::from(1_u32 << common.widenings.min(31));
        let model_of = |plane: usize| {
            let model = match common.built.get(plane) {
                None => self.unworn.clone(),
                Some(depth) => ale::relocate(&self.unworn, depth)?,
            };
            Ok(model.with_zones_widened(widened)?)
        };
        let models = (0..self.planes.count()).map(model_of);
        let models: Vec<Model> = models.collect::<Result<_, SectionsError>>()?;
        check(&self.scene, &models, &self.planes)?;
        let earlier = (&self.models[..], std::mem::take(&mut self.operators.zones));
        let (ends, threads) = (self.scene.ends, self.scene.section.threads);
        self.operators = condense_extruded(&models, &self.planes, ends, Some(earlier), threads)
            .map_err(SectionsError::from)?;
        self.models = models;
        self.built.clone_from(&common.built);
        self.widenings = common.widenings;
        Ok(())
    }
}

/// Checks sizes and elements.
fn check(
    scene: &ExtrudedScene,
    models: &[Model],
    planes: &NodePlanes,
) -> Result<(), ExtrudedError> {
    let bodies = &models[0].bodies;
    let largest = |body: &BodyModel| {
        let zones = body.zones.iter().map(|zone| zone.zone.nodes());
        zones.fold(0, usize::max)
    };
    scene.check_size(bodies.as_ref().map(largest))?;
    for side in Side::BOTH {
        for number in 0..bodies.of(side).zones.len() {
            let sections = models
                .iter()
                .map(|model| &model.bodies.of(side).zones[number].mesh);
            PrismMesh::new(sections.collect(), planes)
                .check()
                .map_err(SectionsError::from)?;
        }
    }
    Ok(())
}
