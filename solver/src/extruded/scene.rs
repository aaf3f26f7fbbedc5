//! Input of a run of extruded bodies.

use super::error::ExtrudedError;
use crate::along_line::{SectionsError, check_section, check_slip};
use crate::mesh::NodePlanes;
use crate::number::{positive, real};
use crate::scene::Effect;
use crate::scene::{Dimension, Ends, Motion, Scene};
use crate::sides::{Side, Sides};

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
    /// Boundary condition on the ends.
    pub ends: Ends,
}

/// More contact nodes than this in a zone of a body are refused: its dense compliance takes (2 n)^2 x 8 bytes, 288 MB, and condensation
/// holds three such matrices for a moment.
const MOST_NODES: usize = 3_000;

/// Most layers: node planes multiply the nodes of a section.
pub const MOST_LAYERS: u32 = 200;

/// Length of the longest layer over that of the shortest up to which the stiffness keeps enough digits of both. Measured: with 6e11 the
/// bodies of a fuzz button have a solution, with 6e16 none.
const MOST_UNLIKE: f64 = 1e9;

impl ExtrudedScene {
    /// The extruded bodies of a scene; `None` for another one.
    pub fn of(scene: &Scene) -> Option<Self> {
        let extruded = scene.dimension.extruded()?;
        Some(Self {
            section: Scene {
                dimension: Dimension::PlaneStrain,
                ..scene.clone()
            },
            width_mm: extruded.width_mm,
            layers: extruded.layers,
            growth: extruded.layer_growth,
            ends: extruded.ends,
        })
    }

    /// Node planes over half of the width.
    pub fn node_planes(&self) -> usize {
        self.layers / 2 + 1
    }

    /// Normal force on the whole width, N.
    pub fn force_n(&self) -> f64 {
        self.section.load_n_per_mm * self.width_mm
    }

    /// The node planes of the half width.
    pub fn planes(&self) -> NodePlanes {
        NodePlanes::new(self.width_mm, self.layers, self.growth)
    }

    /// The plane scene without sticking, in which the first stroke goes to the right.
    pub(crate) fn plane(&self) -> Scene {
        let section = self.section.clone();
        Scene {
            motion: to_the_right(section.motion),
            effects: section.effects.clone().with(Effect::StickMemory, false),
            ..section
        }
    }

    /// Checks the scene, and that all of its contact slips in each stroke.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that extruded bodies do not have, a contact that may stick.
    pub fn check_all(&self) -> Result<(), ExtrudedError> {
        self.check()?;
        Ok(self.check_slip()?)
    }

    /// Checks that the operators are not larger than the engine takes, for nodes of the largest zone of each body.
    ///
    /// # Errors
    /// [`ExtrudedError::TooLarge`].
    pub fn check_size(&self, zones: Sides<usize>) -> Result<(), ExtrudedError> {
        for side in Side::BOTH {
            let nodes = zones.of(side) * self.node_planes();
            if nodes > MOST_NODES {
                return Err(ExtrudedError::TooLarge {
                    nodes,
                    side: side.name(),
                    limit: MOST_NODES,
                });
            }
        }
        Ok(())
    }

    /// Checks that all of the contact slips in each stroke.
    pub(super) fn check_slip(&self) -> Result<(), SectionsError> {
        check_slip(&Scene {
            effects: self.section.effects.clone(),
            ..self.plane()
        })
    }

    /// Checks the scene.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that extruded bodies do not have.
    pub(super) fn check(&self) -> Result<(), ExtrudedError> {
        check_section(&self.section)?;
        positive(self.width_mm, ExtrudedError::WidthRange)?;
        positive(self.growth, ExtrudedError::GrowthRange)?;
        positive(self.section.load_n_per_mm, ExtrudedError::LoadRange)?;
        let is_counted =
            u32::try_from(self.layers).is_ok_and(|layers| (2..=MOST_LAYERS).contains(&layers));
        if !is_counted || !self.layers.is_multiple_of(2) {
            return Err(ExtrudedError::Layers {
                limit: MOST_LAYERS,
                layers: self.layers,
            });
        }
        let ratio = self.growth.max(self.growth.recip());
        let ratio = ratio.powf(real(self.layers / 2 - 1));
        if ratio > MOST_UNLIKE {
            return Err(ExtrudedError::UnlikeLayers {
                layers: self.layers,
                growth: self.growth,
                ratio,
                limit: MOST_UNLIKE,
            });
        }
        Ok(())
    }
}

/// A motion whose first stroke goes to the right.
pub(super) fn to_the_right(motion: Motion) -> Motion {
    match motion {
        Motion::Reciprocating {
            amplitude_mm,
            period_s,
        } => Motion::Reciprocating {
            amplitude_mm: amplitude_mm.abs(),
            period_s,
        },
        other => other,
    }
}
