//! The model: two meshed bodies with their surfaces, materials and supports. Knows both meshes and laws.

mod interface;
pub mod layout;
pub mod profile;
mod zones;

use crate::closed_form::unworn_contact;
use crate::effects::EffectsPlan;
use crate::element;
use crate::law::elastic::Lame;
use crate::mesh::{ColumnMesh, MeshError, grading};
use crate::resolution::Sizes;
use crate::scene::Effect;
use crate::scene::{Drive, Elastic, Scene, SurfaceEffects};
use crate::sides::Sides;

use interface::slope_weights;
pub use interface::{HeatSources, Interface, Tangential};
pub use layout::{BodyLayout, Layout};
pub use profile::Profile;
pub(crate) use zones::ZONE_WIDENING;
pub use zones::{Zone, ZoneSizes};

/// Two bodies ready to be condensed.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The meshed bodies; the slider's frame moves with it.
    pub bodies: Sides<BodyModel>,
    /// Laws and load of the interface.
    pub interface: Interface,
    /// True if the meshes follow the worn surfaces.
    pub relocates: bool,
    /// True if the current in the bodies is part of it.
    pub conducts: bool,
    /// Effects on the wear of the surfaces that are part of it.
    pub surface: SurfaceEffects,
    /// The lengths that the mesh was chosen from.
    pub sizes: Sizes,
}

/// One body: its contact surface, and the meshes that respond to forces on it.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyModel {
    /// Mesh lines.
    pub layout: BodyLayout,
    /// Heights of the surface nodes of all spines at the geometry of the operators, mm.
    surface_y: Vec<f64>,
    elastic: Elastic,
    support: Support,
    /// Meshes, one for each zone of the surface; never empty.
    pub zones: Vec<ZoneModel>,
}

/// A body meshed finely along a zone of its contact surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ZoneModel {
    /// Spines among those of the body.
    pub zone: Zone,
    /// Mesh at the geometry of the operators.
    pub mesh: ColumnMesh,
    /// Elastic constants.
    pub lame: Lame,
    /// True if the elements use the mean volumetric strain (B-bar).
    pub b_bar: bool,
    /// Support.
    pub support: Support,
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
    let interface = Interface::of(scene, plan, &layout.sizes);
    let Sides { slider, receptacle } = layout.bodies;
    Ok(Model {
        bodies: Sides {
            slider: BodyModel::new(slider, scene.slider.elastic, slider_support)?,
            receptacle: BodyModel::new(receptacle, scene.receptacle.elastic, Support::FarFaceHeld)?,
        },
        interface,
        relocates: plan.simulates(Effect::Relocation),
        conducts: scene.conduction.known().is_some() && plan.simulates(Effect::Resistance),
        surface: plan.surface_effects(),
        sizes: layout.sizes,
    })
}

impl BodyModel {
    /// Meshes a body on its mesh lines.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] if an element is inverted.
    pub fn new(layout: BodyLayout, elastic: Elastic, support: Support) -> Result<Self, MeshError> {
        let body = Self {
            surface_y: layout.heights(),
            layout,
            elastic,
            support,
            zones: Vec::new(),
        };
        body.meshed()
    }

    /// The body with a mesh for each zone of its layout.
    fn meshed(self) -> Result<Self, MeshError> {
        let BodyLayout {
            x,
            far_y,
            fractions,
            zones,
            ..
        } = &self.layout;
        let meshed = |zone: &Zone| {
            let at = |values: &[f64]| zone.spines.iter().map(|&i| values[i]).collect();
            let mesh = ColumnMesh::new(at(x), at(&self.surface_y), *far_y, fractions.clone());
            mesh.quality()?;
            Ok(ZoneModel {
                zone: zone.clone(),
                mesh,
                lame: self.elastic.into(),
                b_bar: self.elastic.poisson_ratio > element::B_BAR_FROM_POISSON_RATIO,
                support: self.support,
            })
        };
        let zones = zones.iter().map(meshed).collect::<Result<_, _>>()?;
        Ok(Self { zones, ..self })
    }

    /// The body with zones of another width, over the layout's.
    fn with_zones_widened(self, factor: f64) -> Result<Self, MeshError> {
        let layout = self.layout.with_zones_widened(factor)?;
        if layout == self.layout {
            return Ok(self);
        }
        Self { layout, ..self }.meshed()
    }

    /// The body with its surface nodes at other heights, mm.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] if an element would be inverted.
    pub(crate) fn with_surface(&self, surface_y: Vec<f64>) -> Result<Self, MeshError> {
        let moved = |zone: &ZoneModel| {
            let at = zone.zone.spines.iter().map(|&i| surface_y[i]).collect();
            let mesh = zone.mesh.with_surface(at);
            mesh.quality()?;
            Ok(ZoneModel {
                mesh,
                ..zone.clone()
            })
        };
        Ok(Self {
            zones: self.zones.iter().map(moved).collect::<Result<_, _>>()?,
            surface_y,
            ..self.clone()
        })
    }

    /// Places of the contact nodes in the body's frame, mm, ascending.
    pub fn contact_x(&self) -> &[f64] {
        self.layout.contact_x()
    }

    /// Heights of the surface nodes of all spines at the geometry of the operators, mm.
    pub fn surface_y(&self) -> &[f64] {
        &self.surface_y
    }

    /// Displacement unknowns of its largest mesh before condensation.
    pub fn dofs(&self) -> usize {
        let nodes = self.zones.iter().map(|zone| zone.mesh.nodes());
        2 * nodes.max().unwrap_or(0)
    }

    /// Number of the zone in whose middle a place lies, mm, as nearly as possible.
    pub fn zone_at(&self, place: f64) -> usize {
        let x = &self.layout.x;
        let distance = |zone: &ZoneModel| {
            let (first, nodes) = (zone.zone.first(), zone.zone.nodes());
            (0.5 * (x[first] + x[first + nodes - 1]) - place).abs()
        };
        let distances = self.zones.iter().map(distance).enumerate();
        let nearest = distances.fold((0, f64::INFINITY), |best, next| {
            if next.1 < best.1 { next } else { best }
        });
        nearest.0
    }

    /// Number of the first retained node of a zone among the contact nodes.
    pub fn first_node(&self, zone: &ZoneModel) -> usize {
        zone.zone.first() - self.layout.contact.0
    }

    /// Length of surface that belongs to each contact node, projected on x, mm.
    pub fn contact_widths(&self) -> Vec<f64> {
        grading::tributary(self.contact_x())
    }
}

impl Model {
    /// Switches the effects of the interface on or off as a plan has decided.
    pub(crate) fn follow(&mut self, scene: &Scene, plan: &EffectsPlan) {
        self.interface = Interface::of(scene, plan, &self.sizes);
        self.relocates = plan.simulates(Effect::Relocation);
        self.surface = plan.surface_effects();
    }

    /// The interface in a block of a mission, in which nothing may stick although it may in others.
    pub(crate) fn interface_of(&self, block: &Scene) -> Interface {
        let hertz = self.sizes.hertz_half_width;
        let sticks = self.interface.sticks && unworn_contact::sticks(block, hertz);
        Interface {
            sticks,
            slope_weights: slope_weights(block, sticks),
            ..self.interface
        }
    }

    /// The model with zones of another width, over that of the layout.
    ///
    /// # Errors
    /// [`MeshError`] if a zone would be too large.
    pub(crate) fn with_zones_widened(self, factor: f64) -> Result<Self, MeshError> {
        let bodies = self.bodies.map(|body| body.with_zones_widened(factor));
        Ok(Self {
            bodies: bodies.transpose()?,
            ..self
        })
    }
}

#[cfg(test)]
pub(crate) mod tests;
