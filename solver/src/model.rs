//! The model: two meshed bodies with their surfaces, materials and supports. Knows both meshes and laws.

pub mod profile;
pub mod resolution;

use crate::material::Lame;
use crate::mesh::{ColumnMesh, MeshError, grading};
use crate::number::{count_at_least, real};
use crate::scene::{Drive, Elastic, Scene};
use crate::{element, friction, wear};

pub use profile::Profile;
pub use resolution::Sizes;

/// A contact surface ends where its arc is steeper than this; beyond it the surface is no graph.
const STEEPEST_ANGLE_DEG: f64 = 80.0;
/// More surface nodes than this on one body are refused: its dense compliance takes (2 n)^2 x 8 bytes, 288 MB, and
/// condensation holds four such matrices for a moment.
const MOST_SURFACE_NODES: usize = 3_000;

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
    let sizes = resolution::choose(scene);
    for spacing in [&sizes.receptacle, &sizes.slider] {
        let nodes = count_at_least(2.0 * spacing.core_half / spacing.core);
        if nodes > MOST_SURFACE_NODES {
            return Err(MeshError::TooLarge {
                nodes,
                limit: MOST_SURFACE_NODES,
            });
        }
    }
    let receptacle = receptacle(scene, &sizes)?;
    let slider = slider(scene, &sizes)?;
    let interface = Interface {
        friction: friction::coefficient(scene.friction),
        receptacle_wear: wear::coefficient(scene.receptacle.wear),
        slider_wear: wear::coefficient(scene.slider.wear),
        load: scene.load_n_per_mm,
        spring: scene.spring_n_per_mm2,
    };
    Ok(Model {
        slider,
        receptacle,
        interface,
        sizes,
    })
}

fn receptacle(scene: &Scene, sizes: &Sizes) -> Result<BodyModel, MeshError> {
    let shape = scene.receptacle.shape;
    let half = 0.5 * shape.length_mm;
    let (profile, x) = match shape.crown_radius_mm {
        None => (Profile::Flat, grading::symmetric(half, &sizes.receptacle)),
        Some(radius) => (
            Profile::Crown { radius },
            on_arc(radius, half, &sizes.receptacle),
        ),
    };
    let fractions = grading::layers(sizes.contact_element / shape.height_mm, sizes.layer_growth);
    let support = Support::FarFaceHeld;
    body(
        x,
        profile,
        -shape.height_mm,
        fractions,
        scene.receptacle.elastic,
        support,
    )
}

fn slider(scene: &Scene, sizes: &Sizes) -> Result<BodyModel, MeshError> {
    let shape = scene.slider.shape;
    let profile = Profile::Arc {
        radius: shape.radius_mm,
    };
    let x = on_arc(shape.radius_mm, shape.half_width_mm, &sizes.slider);
    let fractions = grading::layers(sizes.contact_element / shape.height_mm, sizes.layer_growth);
    let support = match scene.drive {
        Drive::Handle => Support::FarFaceHeld,
        Drive::WholeBody => Support::GuidedUnderPressure,
    };
    body(
        x,
        profile,
        shape.height_mm,
        fractions,
        scene.slider.elastic,
        support,
    )
}

fn body(
    x: Vec<f64>,
    profile: Profile,
    far_y: f64,
    fractions: Vec<f64>,
    elastic: Elastic,
    support: Support,
) -> Result<BodyModel, MeshError> {
    let reach = match profile {
        Profile::Flat => f64::INFINITY,
        Profile::Arc { radius } | Profile::Crown { radius } => {
            radius * STEEPEST_ANGLE_DEG.to_radians().sin()
        }
    };
    let contact = (
        x.partition_point(|&x| x < -reach),
        x.partition_point(|&x| x <= reach),
    );
    let surface = x.iter().map(|&x| profile.height(x)).collect();
    let mesh = checked(ColumnMesh::new(x, surface, far_y, fractions))?;
    let lame = elastic.into();
    Ok(BodyModel {
        mesh,
        profile,
        lame,
        b_bar: b_bar(elastic),
        support,
        contact,
    })
}

/// Node places over an arc, spaced along its length, on [-half, half] or to its rim.
fn on_arc(radius: f64, half: f64, spacing: &grading::Spacing) -> Vec<f64> {
    let half = half.min(radius);
    let mut x = grading::symmetric(radius * (half / radius).asin(), spacing);
    for place in &mut x {
        *place = radius * (*place / radius).sin();
    }
    let last = x.len() - 1;
    (x[0], x[last]) = (-half, half);
    x
}

fn checked(mesh: ColumnMesh) -> Result<ColumnMesh, MeshError> {
    if mesh.spines() > MOST_SURFACE_NODES {
        return Err(MeshError::TooLarge {
            nodes: mesh.spines(),
            limit: MOST_SURFACE_NODES,
        });
    }
    mesh.quality()?;
    Ok(mesh)
}

fn b_bar(elastic: Elastic) -> bool {
    elastic.poisson_ratio > element::B_BAR_FROM_POISSON_RATIO
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
