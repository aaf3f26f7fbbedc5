//! Checkpoints: all that the rest of a run depends on, besides its scene.
//!
//! Meshes and operators are not part of it. The mesh of a run is the unworn one with its surfaces moved to the depths
//! at which the operators were last built, and the operators follow from the mesh; building both again from these
//! depths gives the same bits, so a resumed run cannot be told from one that was never disturbed.

use serde::{Deserialize, Serialize};

use crate::ale;
use crate::cycle::CycleState;
use crate::mesh::MeshError;
use crate::model::Model;

/// A run between two computed cycles. It keeps its bits when it is written and read, as long as the format keeps those
/// of its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    pub(crate) state: CycleState,
    pub(crate) initial: Initial,
    pub(crate) built: Option<BuiltAt>,
    pub(crate) relocations: u64,
}

/// The unworn, loaded state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Initial {
    /// Highest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the width of the contact, mm.
    pub contact_half_width_mm: f64,
}

/// Worn depths at which the operators were last built, mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct BuiltAt {
    receptacle_depth: Vec<f64>,
    slider_depth: Vec<f64>,
}

/// Why a checkpoint does not belong to a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Misfit {
    /// The scene has another mesh.
    #[error("it has {found} values for the {nodes} contact nodes of the {body}")]
    Nodes {
        /// Which body.
        body: &'static str,
        /// Values in the checkpoint.
        found: usize,
        /// Nodes of the scene.
        nodes: usize,
    },
    /// The scene ends before it.
    #[error("it is at cycle {cycle} of {cycles}")]
    Beyond {
        /// Cycle of the checkpoint.
        cycle: u64,
        /// Cycles of the scene.
        cycles: u64,
    },
}

impl Checkpoint {
    /// Physical cycles done.
    pub fn cycle(&self) -> u64 {
        self.state.cycle
    }

    /// The model that the run had here, from the unworn one.
    pub(crate) fn model(&self, unworn: Model) -> Result<Model, MeshError> {
        match &self.built {
            None => Ok(unworn),
            Some(built) => ale::worn_model(&unworn, &built.receptacle_depth, &built.slider_depth),
        }
    }

    /// Notes that the operators are now built at the present depths.
    pub(crate) fn relocated(&mut self) {
        self.built = Some(BuiltAt {
            receptacle_depth: self.state.receptacle_depth.clone(),
            slider_depth: self.state.slider_depth.clone(),
        });
        self.relocations += 1;
    }

    /// Whether it can be one of a run of this many cycles on this unworn model.
    pub(crate) fn check(&self, unworn: &Model, cycles: u64) -> Result<(), Misfit> {
        if self.state.cycle > cycles {
            return Err(Misfit::Beyond {
                cycle: self.state.cycle,
                cycles,
            });
        }
        let contact = &self.state.contact;
        let n = unworn.receptacle.contact_x().len();
        let m = unworn.slider.contact_x().len();
        let at_receptacle = [
            contact.status.len(),
            contact.pressure.len(),
            contact.shear.len(),
            contact.receptacle_force.len() / 2,
            self.state.receptacle_depth.len(),
            self.built.as_ref().map_or(n, |b| b.receptacle_depth.len()),
        ];
        let at_slider = [
            contact.slider_force.len() / 2,
            self.state.slider_depth.len(),
            self.built.as_ref().map_or(m, |b| b.slider_depth.len()),
        ];
        all_are("receptacle", &at_receptacle, n)?;
        all_are("slider", &at_slider, m)
    }
}

fn all_are(body: &'static str, lengths: &[usize], nodes: usize) -> Result<(), Misfit> {
    match lengths.iter().find(|length| **length != nodes) {
        None => Ok(()),
        Some(&found) => Err(Misfit::Nodes { body, found, nodes }),
    }
}
