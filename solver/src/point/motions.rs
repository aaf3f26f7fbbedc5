//! Motions of a point contact: one, or those of the blocks of a mission, which have one grid.

use super::check;
use super::error::PointError;
use super::lattice::Lattice;
use crate::closed_form::{PointScene, SlipRegime};
use crate::law::friction::contact::ContactFriction;
use crate::scene::Scene;

/// A point contact in each of its motions.
pub(crate) struct PointMotions {
    /// At least one.
    blocks: Vec<PointScene>,
    /// Slip where the amplitude is small against the contact.
    pub(super) slip: SlipRegime,
    /// Friction, as worn by all of them.
    pub(super) friction: ContactFriction,
    /// True for a mission, also of one block.
    pub(super) is_mission: bool,
}

impl PointMotions {
    /// A single motion under a constant coefficient of friction.
    pub(crate) fn single(scene: &PointScene) -> Self {
        Self {
            slip: scene.slip,
            friction: ContactFriction::constant(scene.friction),
            blocks: vec![*scene],
            is_mission: false,
        }
    }

    /// The motions of a contact in a scene, whose surfaces wear through the layers of their platings or by the outermost one alone.
    pub(crate) fn of(contact: &PointScene, scene: &Scene, layered: bool) -> Self {
        let slip = contact.slip;
        let blocks = scene.blocks().into_iter();
        let wear = contact.bodies.as_ref().map(|body| body.wear);
        Self {
            blocks: blocks.map(|block| contact.in_block(&block, slip)).collect(),
            slip,
            friction: scene.contact_friction(&wear, layered),
            is_mission: scene.mission.is_some(),
        }
    }

    /// The contact in its first motion.
    pub(super) fn first(&self) -> &PointScene {
        &self.blocks[0]
    }

    /// Checks the contact in all of its motions.
    ///
    /// # Errors
    /// A value outside of its range, a contact that is no point, a law that is none by dose.
    pub(super) fn check(&self) -> Result<(), PointError> {
        self.blocks.iter().try_for_each(check::check)
    }

    /// Grids of the unworn contact.
    pub(super) fn lattice(&self) -> Lattice {
        let blocks = self.blocks.iter();
        let slipping = blocks.filter(|block| block.slip == SlipRegime::Gross);
        let amplitudes: Vec<f64> = slipping.map(|block| block.amplitude_mm).collect();
        Lattice::of(self.first(), &amplitudes)
    }
}
