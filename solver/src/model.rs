//! The model: two meshed bodies with their surfaces, materials and supports. Knows both meshes and laws.

pub mod layout;
pub mod profile;
pub mod resolution;

use crate::effects::{Effect, EffectsPlan};
use crate::element;
use crate::law::elastic::Lame;
use crate::law::friction;
use crate::law::wear::WearLaw;
use crate::mesh::{ColumnMesh, MeshError};
use crate::number::real;
use crate::scene::{Drive, Elastic, Scene};
use crate::sides::{Side, Sides};

pub use layout::{BodyLayout, Layout};
pub use profile::Profile;
pub use resolution::Sizes;

/// Two bodies ready to be condensed.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The meshed bodies; the slider's frame moves with it.
    pub bodies: Sides<BodyModel>,
    /// Laws and load of the interface.
    pub interface: Interface,
    /// Whether the meshes follow the worn surfaces.
    pub relocates: bool,
    /// The lengths that the mesh was chosen from.
    pub sizes: Sizes,
}

/// One meshed body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyModel {
    /// Mesh at the geometry of the operators.
    pub mesh: ColumnMesh,
    /// Unworn surface.
    pub profile: Profile,
    /// Elastic constants.
    pub lame: Lame,
    /// Whether the elements use the mean volumetric strain (B-bar).
    pub b_bar: bool,
    /// Support.
    pub support: Support,
    /// Spines whose surface nodes may touch the other body: first and one past the last.
    pub contact: (usize, usize),
}

/// Support of a body.
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
    /// The body whose nodes carry the contact constraints, pressure and shear.
    pub slave: Side,
    /// Whether part of the contact may stick through the whole stroke.
    pub sticks: bool,
    /// Wear laws; none where nothing wears.
    pub wear: Sides<Option<WearLaw>>,
    /// Normal load on the unworn contact, N/mm.
    pub load: f64,
    /// Stiffness of the spring that applies the load: the load decreases by this as the slider sinks, N/mm per mm.
    pub spring: f64,
}

/// Builds the model of a scene from its plan: meshes both bodies, and gives the interface the laws of simulated effects
/// only.
///
/// # Errors
/// [`MeshError`] if the mesh would be too large or inverted.
pub fn build(scene: &Scene, plan: &EffectsPlan) -> Result<Model, MeshError> {
    let layout = Layout::of(scene)?;
    let slider_support = match scene.drive {
        Drive::Handle => Support::FarFaceHeld,
        Drive::WholeBody => Support::GuidedUnderPressure,
    };
    let wear = |effect, law: Option<WearLaw>| law.filter(|_| plan.simulates(effect));
    let interface = Interface {
        slave: layout.sizes.slave,
        sticks: layout.sizes.sticks,
        friction: if plan.simulates(Effect::Friction) {
            friction::coefficient(scene.friction)
        } else {
            0.0
        },
        wear: Sides {
            slider: wear(Effect::SliderWear, scene.slider.wear),
            receptacle: wear(Effect::ReceptacleWear, scene.receptacle.wear),
        },
        load: scene.load_n_per_mm,
        spring: scene.spring_n_per_mm2,
    };
    let Sides { slider, receptacle } = layout.bodies;
    Ok(Model {
        bodies: Sides {
            slider: body(slider, scene.slider.elastic, slider_support)?,
            receptacle: body(receptacle, scene.receptacle.elastic, Support::FarFaceHeld)?,
        },
        interface,
        relocates: plan.simulates(Effect::Relocation),
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
