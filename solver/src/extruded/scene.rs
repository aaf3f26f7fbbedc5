//! What a run of extruded bodies is computed from.

use super::error::ExtrudedError;
use crate::effects::Effect;
use crate::mesh::NodePlanes;
use crate::model::Ends;
use crate::scene::{Friction, Motion, Scene};
use crate::sides::Side;

/// A plane section drawn out over a width.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtrudedScene {
    /// The section, with its motion along x; its line load is the mean over the width. Without cycles only the load is applied.
    pub section: Scene,
    /// Width of both bodies, mm.
    pub width_mm: f64,
    /// Layers of elements over the width; even, because the middle is a node plane.
    pub layers: usize,
    /// Length of a layer over that of its neighbour toward the free end; 1 for even layers.
    pub growth: f64,
    /// What holds the ends.
    pub ends: Ends,
    /// Worn depth of either body that ends the run, mm.
    pub stop_depth_mm: Option<f64>,
}

impl ExtrudedScene {
    /// Normal force on the whole width, N.
    pub fn force_n(&self) -> f64 {
        self.section.load_n_per_mm * self.width_mm
    }

    /// The node planes of the half width.
    pub(super) fn planes(&self) -> NodePlanes {
        NodePlanes::new(self.width_mm, self.layers, self.growth)
    }

    /// The plane scene without sticking, in which the first stroke goes to the right.
    pub(super) fn plane(&self) -> Scene {
        let section = self.section.clone();
        let motion = match section.motion {
            Motion::Reciprocating {
                amplitude_mm,
                period_s,
            } => Motion::Reciprocating {
                amplitude_mm: amplitude_mm.abs(),
                period_s,
            },
            other => other,
        };
        Scene {
            motion,
            effects: section.effects.clone().with(Effect::StickMemory, false),
            ..section
        }
    }

    /// Amplitude of the motion, mm; none of one that turns inside or is continuous.
    pub(super) fn amplitude_mm(&self) -> Option<f64> {
        match self.section.motion {
            Motion::Reciprocating { amplitude_mm, .. } => Some(amplitude_mm),
            Motion::Periodic { .. } | Motion::Continuous { .. } => None,
        }
    }

    /// Checks the scene.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that extruded bodies do not have.
    pub(super) fn check(&self) -> Result<(), ExtrudedError> {
        let amplitude = self.amplitude_mm().ok_or(ExtrudedError::Motion)?;
        if !matches!(
            self.section.friction,
            Friction::Coulomb { .. } | Friction::Frictionless
        ) {
            return Err(ExtrudedError::FrictionLaw);
        }
        for (name, value) in [
            ("width in mm", self.width_mm),
            ("growth of layers", self.growth),
            ("line load in N/mm", self.section.load_n_per_mm),
            ("magnitude of the amplitude in mm", amplitude.abs()),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ExtrudedError::Value { name, value });
            }
        }
        if self.layers < 2 || !self.layers.is_multiple_of(2) {
            return Err(ExtrudedError::Layers {
                layers: self.layers,
            });
        }
        if self.section.spring_n_per_mm2 != 0.0 {
            return Err(ExtrudedError::Spring);
        }
        let wear = self.section.surface_wear();
        for side in Side::BOTH {
            if wear.of(side).is_some_and(|wear| wear.uniform().is_none()) {
                return Err(ExtrudedError::Law { side: side.name() });
            }
        }
        Ok(())
    }
}
