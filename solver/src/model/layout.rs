//! Positions of mesh lines, before any element exists: what a solve is sized by.
//!
//! A body is cut by vertical spines at `x` and by layers at fixed fractions of a spine's length, so node counts and
//! surface positions follow from one dimension.

use super::profile::Profile;
use super::zones::{self, Zone, ZoneSizes};
use crate::mesh::columns::is_tip;
use crate::mesh::{MeshError, grading};
use crate::number::count_at_least;
use crate::resolution::{self, Sizes};
use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// The contact surface ends where its arc is steeper than this; beyond it the surface is no graph.
const STEEPEST_ANGLE_DEG: f64 = 80.0;
/// More surface nodes than this in one zone are refused: its dense compliance takes (2 n)^2 x 8 bytes, 288 MB, and
/// condensation holds four such matrices for a moment.
pub(super) const MOST_ZONE_NODES: usize = 3_000;
/// More surface nodes than this on one body are refused: each increment passes over all of them.
pub(super) const MOST_SURFACE_NODES: usize = 50_000;

/// Mesh lines of both bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Mesh lines of each body, in its own frame.
    pub bodies: Sides<BodyLayout>,
    /// The lengths that the spacing was chosen from.
    pub sizes: Sizes,
}

/// Mesh lines of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyLayout {
    /// Positions of the spines, mm, ascending.
    pub x: Vec<f64>,
    /// Unworn surface.
    pub profile: Profile,
    /// Height of the far face, mm.
    pub far_y: f64,
    /// Layers as fractions of a spine, 0 on the surface to 1 on the far face.
    pub fractions: Vec<f64>,
    /// Spines whose surface nodes may touch the other body: first and one past the last.
    pub contact: (usize, usize),
    /// Meshes of the body: one, or one for each part of a long travel.
    pub zones: Vec<Zone>,
    /// Sizing parameters of the zones.
    pub zone_sizes: ZoneSizes,
}

impl Layout {
    /// Places the mesh lines of a scene.
    ///
    /// # Errors
    /// [`MeshError::TooLarge`] beyond the limit of surface nodes, [`MeshError::Inverted`] if a surface crosses the far
    /// face.
    pub fn of(scene: &Scene) -> Result<Self, MeshError> {
        let sizes = resolution::choose(scene);
        for spacing in [&sizes.spacing.receptacle, &sizes.spacing.slider] {
            let nodes = count_at_least(2.0 * spacing.core_half / spacing.core);
            within_limit(nodes, MOST_SURFACE_NODES)?;
        }
        let receptacle = receptacle(scene, &sizes)?;
        let slider = slider(scene, &sizes)?;
        Ok(Self {
            bodies: Sides { slider, receptacle },
            sizes,
        })
    }
}

impl BodyLayout {
    fn new(
        x: Vec<f64>,
        profile: Profile,
        far_y: f64,
        fractions: Vec<f64>,
        zone_sizes: ZoneSizes,
    ) -> Result<Self, MeshError> {
        within_limit(x.len(), MOST_SURFACE_NODES)?;
        let half = match profile {
            Profile::Flat => f64::INFINITY,
            Profile::Arc { radius } | Profile::Crown { radius } => {
                radius * STEEPEST_ANGLE_DEG.to_radians().sin()
            }
        };
        let contact = (
            x.partition_point(|&x| x < -half),
            x.partition_point(|&x| x <= half),
        );
        let layout = Self {
            x,
            profile,
            far_y,
            fractions,
            contact,
            zones: Vec::new(),
            zone_sizes,
        };
        layout.check_elements()?;
        layout.with_zones_widened(1.0)
    }

    /// The layout with zones whose width is so many times that of its sizes.
    pub(super) fn with_zones_widened(&self, factor: f64) -> Result<Self, MeshError> {
        let width = factor * self.zone_sizes.width;
        let sizes = ZoneSizes {
            width,
            ..self.zone_sizes
        };
        let zones = zones::divide(&self.x, self.contact, sizes);
        for zone in &zones {
            within_limit(zone.nodes(), MOST_ZONE_NODES)?;
        }
        Ok(Self {
            zones,
            ..self.clone()
        })
    }

    /// Checks that no element of the unworn mesh is inverted: spines lie beside each other, and the whole surface on one side of the far
    /// face.
    fn check_elements(&self) -> Result<(), MeshError> {
        let longest = self.longest();
        let crosses = |y: f64| {
            let length = self.far_y.signum() * (self.far_y - y);
            length < 0.0 && !is_tip(length, longest)
        };
        let heights = self.heights();
        let is_beside = |spine: usize| spine == 0 || self.x[spine - 1] < self.x[spine];
        let inverted = |&spine: &usize| crosses(heights[spine]) || !is_beside(spine);
        match (0..self.x.len()).find(inverted) {
            None => Ok(()),
            Some(spine) => Err(MeshError::Inverted {
                element: spine.saturating_sub(1) * (self.fractions.len() - 1),
                x_mm: self.x[spine],
            }),
        }
    }

    /// Heights of the surface nodes, mm.
    pub(crate) fn heights(&self) -> Vec<f64> {
        self.x.iter().map(|&x| self.profile.height(x)).collect()
    }

    fn longest(&self) -> f64 {
        let lengths = self.heights().into_iter().map(|y| (self.far_y - y).abs());
        lengths.fold(0.0, f64::max)
    }

    /// Positions of the contact nodes, mm, ascending.
    pub fn contact_x(&self) -> &[f64] {
        &self.x[self.contact.0..self.contact.1]
    }

    /// Number of nodes of the mesh of each zone: a spine without length is one node.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        let longest = self.longest();
        let heights = self.heights();
        self.zones.iter().map(move |zone| {
            let is_tip = |&&spine: &&usize| is_tip(self.far_y - heights[spine], longest);
            let tips = zone.spines.iter().filter(is_tip).count();
            (zone.spines.len() - tips) * self.fractions.len() + tips
        })
    }

    /// Number of contact nodes of the largest zone.
    pub fn largest_zone(&self) -> usize {
        self.zones.iter().map(Zone::nodes).max().unwrap_or(0)
    }

    /// Pairs of contact nodes within each zone but one, whose compliance is stored besides that of the one.
    pub fn further_pairs(&self) -> usize {
        let pairs = |zone: &Zone| zone.nodes() * zone.nodes();
        self.zones.iter().skip(1).map(pairs).sum()
    }

    /// Displacement unknowns of the largest mesh of the body before condensation.
    pub fn dofs(&self) -> usize {
        2 * self.nodes().max().unwrap_or(0)
    }
}

fn within_limit(nodes: usize, limit: usize) -> Result<(), MeshError> {
    if nodes > limit {
        return Err(MeshError::TooLarge { nodes, limit });
    }
    Ok(())
}

fn receptacle(scene: &Scene, sizes: &Sizes) -> Result<BodyLayout, MeshError> {
    let shape = scene.receptacle.shape;
    let half = 0.5 * shape.length_mm;
    let (profile, x) = match shape.crown_radius_mm {
        None => (
            Profile::Flat,
            grading::symmetric(half, &sizes.spacing.receptacle),
        ),
        Some(radius) => (
            Profile::Crown { radius },
            on_arc(radius, half, &sizes.spacing.receptacle),
        ),
    };
    let fractions = grading::layers(sizes.contact_element / shape.height_mm, sizes.layer_growth);
    let far_y = -shape.height_mm;
    BodyLayout::new(
        x,
        profile,
        far_y,
        fractions,
        zone_sizes(scene, sizes, Side::Receptacle),
    )
}

fn slider(scene: &Scene, sizes: &Sizes) -> Result<BodyLayout, MeshError> {
    let shape = scene.slider.shape;
    let profile = Profile::Arc {
        radius: shape.radius_mm,
    };
    let x = on_arc(shape.radius_mm, shape.half_width_mm, &sizes.spacing.slider);
    let fractions = grading::layers(sizes.contact_element / shape.height_mm, sizes.layer_growth);
    let far_y = shape.height_mm;
    BodyLayout::new(
        x,
        profile,
        far_y,
        fractions,
        zone_sizes(scene, sizes, Side::Slider),
    )
}

fn zone_sizes(scene: &Scene, sizes: &Sizes, side: Side) -> ZoneSizes {
    ZoneSizes {
        half_width: sizes.final_half_width,
        width: scene.accuracy.tuning.zone_width,
        fewest: scene.accuracy.tuning.fewest_zone_nodes,
        largest: sizes.spacing.of(side).largest,
    }
}

/// Positions on an arc, spaced along its length, on [-half, half] or to its rim.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::build;
    use crate::model::tests::fuzz_button;

    #[test]
    fn a_layout_counts_the_nodes_of_the_mesh_that_is_built_from_it() {
        let mut scene = fuzz_button();
        for crown in [None, Some(0.06)] {
            scene.receptacle.shape.crown_radius_mm = crown;
            let layout = Layout::of(&scene).expect("within the limit");
            let model =
                build(&scene, &crate::effects::plan(&scene)).expect("the preset can be meshed");
            for (layout, model) in [
                (&layout.bodies.slider, &model.bodies.slider),
                (&layout.bodies.receptacle, &model.bodies.receptacle),
            ] {
                let nodes = model.zones.iter().map(|zone| zone.mesh.nodes());
                assert!(layout.nodes().eq(nodes));
                assert_eq!(layout.contact_x(), model.contact_x());
            }
        }
    }

    /// A quarter of a circle to either side: places lie ever closer by their projection.
    #[test]
    fn places_up_to_the_rim_of_an_arc_are_apart_wherever_the_core_ends() {
        for before_the_rim in (1..=16).map(|i| 10.0_f64.powi(-i)) {
            for radius in [1.0, 0.1, 0.3, 1e-6, 1e4] {
                let half_arc = radius * std::f64::consts::FRAC_PI_2;
                let spacing = grading::Spacing {
                    core: 0.03 * half_arc,
                    core_half: half_arc * (1.0 - before_the_rim),
                    zone_growth: 0.1,
                    zone_half: half_arc,
                    outer_growth: 0.3,
                    largest: half_arc,
                };
                let x = on_arc(radius, radius, &spacing);
                assert!(
                    x.windows(2).all(|pair| pair[0] < pair[1]),
                    "{before_the_rim}"
                );
            }
        }
    }

    #[test]
    fn a_surface_beyond_the_far_face_is_refused() {
        let mut scene = fuzz_button();
        scene.slider.shape.height_mm = 0.01;
        let error = Layout::of(&scene).expect_err("the arc crosses the top face");
        assert!(matches!(error, MeshError::Inverted { .. }), "{error}");
        assert!(build(&scene, &crate::effects::plan(&scene)).is_err());
    }
}
