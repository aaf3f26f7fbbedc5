//! The model: two meshed bodies with their surfaces, materials and supports. Knows both meshes and laws.

pub mod layout;
pub mod profile;
pub mod resolution;

use crate::material::Lame;
use crate::mesh::{ColumnMesh, MeshError};
use crate::number::real;
use crate::scene::{Drive, Elastic, Scene};
use crate::{element, friction, wear};

pub use layout::{BodyLayout, Layout};
pub use profile::Profile;
pub use resolution::Sizes;

/// Two bodies ready to be condensed.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The slider, its frame moving with it.
    pub slider: BodyModel,
    /// The receptacle.
    pub receptacle: BodyModel,
    /// Laws and load of the interface.
    pub interface: Interface,
    /// The lengths that the mesh was chosen from.
    pub sizes: Sizes,
}

/// One meshed body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyModel {
    /// Its mesh, at the geometry that the operators are to be built for.
    pub mesh: ColumnMesh,
    /// Its unworn surface.
    pub profile: Profile,
    /// Its elasticity.
    pub lame: Lame,
    /// Whether its elements take the volumetric part at its mean.
    pub b_bar: bool,
    /// How it is held.
    pub support: Support,
    /// Spines whose surface nodes may touch the other body: first and one past the last.
    pub contact: (usize, usize),
}

/// How a body is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    /// The far face does not deform: a clamped bottom, or a rigid handle whose motion is added as a rigid body.
    FarFaceHeld,
    /// `u_x` of every node is zero; one far node is grounded in y, which carries nothing at equilibrium; the load
    /// is an even pressure on the far face.
    GuidedUnderPressure,
}

/// Laws and load between the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interface {
    /// Coefficient of friction, -.
    pub friction: f64,
    /// Recession of the receptacle per pressure and slip, 1/MPa.
    pub receptacle_wear: f64,
    /// Recession of the slider per pressure and slip, 1/MPa.
    pub slider_wear: f64,
    /// Normal load on the unworn contact, N/mm.
    pub load: f64,
    /// What it loses as the slider sinks, N/mm per mm.
    pub spring: f64,
}

/// Meshes both bodies of a scene.
///
/// # Errors
/// [`MeshError`] if the mesh would be too large or inverted.
pub fn build(scene: &Scene) -> Result<Model, MeshError> {
    let layout = Layout::of(scene)?;
    let slider_support = match scene.drive {
        Drive::Handle => Support::FarFaceHeld,
        Drive::WholeBody => Support::GuidedUnderPressure,
    };
    let interface = Interface {
        friction: friction::coefficient(scene.friction),
        receptacle_wear: wear::coefficient(scene.receptacle.wear),
        slider_wear: wear::coefficient(scene.slider.wear),
        load: scene.load_n_per_mm,
        spring: scene.spring_n_per_mm2,
    };
    Ok(Model {
        slider: body(layout.slider, scene.slider.elastic, slider_support)?,
        receptacle: body(
            layout.receptacle,
            scene.receptacle.elastic,
            Support::FarFaceHeld,
        )?,
        interface,
        sizes: layout.sizes,
    })
}

fn body(layout: BodyLayout, elastic: Elastic, support: Support) -> Result<BodyModel, MeshError> {
    let surface = layout.heights();
    let BodyLayout {
        x,
        profile,
        far_y,
        fractions,
        contact,
    } = layout;
    let mesh = ColumnMesh::new(x, surface, far_y, fractions);
    mesh.quality()?;
    Ok(BodyModel {
        mesh,
        profile,
        lame: elastic.into(),
        b_bar: elastic.poisson_ratio > element::B_BAR_FROM_POISSON_RATIO,
        support,
        contact,
    })
}

impl BodyModel {
    /// Places of the contact nodes in the body's frame, mm, ascending.
    pub fn contact_x(&self) -> &[f64] {
        &self.mesh.x()[self.contact.0..self.contact.1]
    }

    /// Displacement unknowns of the whole body before condensation.
    pub fn dofs(&self) -> usize {
        2 * self.mesh.nodes()
    }

    /// Length of surface that belongs to each contact node, projected on x, mm.
    pub fn contact_widths(&self) -> Vec<f64> {
        let x = self.contact_x();
        (0..x.len())
            .map(|i| 0.5 * (x[(i + 1).min(x.len() - 1)] - x[i.saturating_sub(1)]))
            .collect()
    }

    /// Mean spacing of the surface nodes, mm.
    pub fn mean_spacing(&self) -> f64 {
        let x = self.mesh.x();
        (x[x.len() - 1] - x[0]) / real(x.len() - 1)
    }
}

#[cfg(test)]
pub(crate) mod tests;
