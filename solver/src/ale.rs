//! Mesh relocation (ALE): the contact solve is the Lagrangian step, this is the Eulerian one.
//!
//! A worn surface is a graph over vertical spines; its nodes recede along them and the nodes below keep their
//! share of the spine's length, the closed form of smoothing along a spine. Topology never changes, and the only
//! fields with history, the worn depths and tractions, live on the surface nodes themselves.

mod spines;

use crate::mesh::MeshError;
use crate::model::{BodyModel, Model};
use crate::scene::Accuracy;
use crate::sides::{Side, Sides};

pub(crate) use spines::Spines;
pub(crate) use spines::WORN_THROUGH_SHARE;

/// Returns `true` if the geometry has changed enough since the operators were built to rebuild them; worn depths in mm.
pub(crate) fn has_drifted(model: &Model, depth: &Sides<Vec<f64>>, accuracy: &Accuracy) -> bool {
    let share = accuracy.drift_share();
    let drifted = |side: &Side| drift(model.bodies.of(*side), depth.of(*side), *side) > share;
    Side::BOTH.iter().any(drifted)
}

/// The model with its meshes moved to surfaces worn by these depths at the contact nodes, mm.
///
/// # Errors
/// [`MeshError::Inverted`] if an element would be inverted.
pub fn relocate(model: &Model, depth: &Sides<Vec<f64>>) -> Result<Model, MeshError> {
    let mut moved = model.clone();
    for (side, body) in [
        (Side::Receptacle, &mut moved.bodies.receptacle),
        (Side::Slider, &mut moved.bodies.slider),
    ] {
        let surface = worn(body, depth.of(side), side);
        *body = body.with_surface(surface)?;
    }
    Ok(moved)
}

/// Heights of all surface nodes when the contact nodes have receded by `depth`.
pub(crate) fn worn(body: &BodyModel, depth: &[f64], side: Side) -> Vec<f64> {
    let mut surface: Vec<f64> = body
        .layout
        .x
        .iter()
        .map(|&x| body.layout.profile.height(x))
        .collect();
    for (y, depth) in surface[body.layout.contact.0..body.layout.contact.1]
        .iter_mut()
        .zip(depth)
    {
        *y += side.recession() * depth;
    }
    surface
}

/// Largest change of a contact spine since the mesh was built, over its length then.
fn drift(body: &BodyModel, depth: &[f64], side: Side) -> f64 {
    let worn = worn(body, depth, side);
    let built = body.surface_y();
    (body.layout.contact.0..body.layout.contact.1)
        .map(|i| (worn[i] - built[i]).abs() / (body.layout.far_y - built[i]).abs())
        .fold(0.0, f64::max)
}
