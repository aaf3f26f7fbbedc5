//! Fields inside a body at one position: displacement and stress at the nodes, by back-substitution.
//!
//! Stress is evaluated at the corners of every element and averaged over the elements of a node, by area. In plane
//! strain sigma_zz = lambda (eps_xx + eps_yy).

mod along_line;
mod antiplane;
mod common_mesh;
mod error;
mod extruded;
mod prisms;
mod tractions;

use nalgebra::Matrix3;

use crate::ale;
use crate::condensation::{Condensed, OperatorError};
use crate::contact::ContactState;
use crate::element::{Element, Quad4, Tri3, incompatible, physical_gradient};
use crate::law::elastic::Lame;
use crate::mesh::MeshError;
use crate::mesh::columns::Cell;
use crate::model::{Model, ZoneModel};
use crate::schedule::increments::Position;
use crate::sides::{Side, Sides};

pub use along_line::{LineFields, SectionFields, SweptFields};
pub(crate) use along_line::{SectionState, along_line};
pub use error::FieldsError;
pub(crate) use extruded::{ExtrudedSections, extruded};
pub use tractions::SurfaceFields;

/// Fields of both bodies at one position of the slider.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedFields {
    /// Position in the cycle.
    pub position: Position,
    /// The slider's fields, its nodes at its place at that moment.
    pub slider: BodyFields,
    /// The receptacle's fields.
    pub receptacle: BodyFields,
}

/// Fields of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFields {
    /// Places of the nodes in the body's frame, undeformed, mm.
    pub nodes: Vec<[f64; 2]>,
    /// Elements by their nodes.
    pub cells: Vec<Cell>,
    /// Displacements, mm.
    pub displacement_mm: Vec<[f64; 2]>,
    /// Stress at the nodes.
    pub stress: Vec<Stress>,
    /// Smallest determinant of the Jacobian over its mean, for every element; empty until the body is placed.
    pub quality: Vec<f64>,
}

/// A stress, MPa; in plane strain without the shears of z.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stress {
    /// sigma_xx.
    pub xx: f64,
    /// sigma_yy.
    pub yy: f64,
    /// sigma_zz.
    pub zz: f64,
    /// sigma_xy.
    pub xy: f64,
    /// sigma_xz.
    pub xz: f64,
    /// sigma_yz.
    pub yz: f64,
}

impl Stress {
    /// Von Mises' equivalent stress, MPa.
    pub fn von_mises(&self) -> f64 {
        let differences =
            (self.xx - self.yy).powi(2) + (self.yy - self.zz).powi(2) + (self.zz - self.xx).powi(2);
        let along = self.xz * self.xz + self.yz * self.yz;
        (0.5 * differences + 3.0 * self.xy * self.xy + 3.0 * along).sqrt()
    }

    /// Largest shear stress, half the difference of the extreme principal stresses, MPa.
    pub fn largest_shear(&self) -> f64 {
        if self.xz != 0.0 || self.yz != 0.0 {
            let principal = self.tensor().symmetric_eigenvalues();
            return 0.5 * (principal.max() - principal.min());
        }
        let centre = 0.5 * (self.xx + self.yy);
        let radius = (0.5 * (self.xx - self.yy)).hypot(self.xy);
        let highest = (centre + radius).max(self.zz);
        let lowest = (centre - radius).min(self.zz);
        0.5 * (highest - lowest)
    }

    fn tensor(&self) -> Matrix3<f64> {
        Matrix3::new(
            self.xx, self.xy, self.xz, self.xy, self.yy, self.yz, self.xz, self.yz, self.zz,
        )
    }

    /// The same with z pointing the other way.
    fn mirrored_along_z(&self) -> Self {
        Self {
            xz: -self.xz,
            yz: -self.yz,
            ..*self
        }
    }

    /// The mean of it and of its mirror image.
    fn without_shear_along_z(&self) -> Self {
        Self {
            xz: 0.0,
            yz: 0.0,
            ..*self
        }
    }

    /// A part of the way to another one.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |of: fn(&Self) -> f64| (1.0 - share) * of(self) + share * of(other);
        Self {
            xx: between(|s| s.xx),
            yy: between(|s| s.yy),
            zz: between(|s| s.zz),
            xy: between(|s| s.xy),
            xz: between(|s| s.xz),
            yz: between(|s| s.yz),
        }
    }
}

/// Fields of both bodies in the states of contact that a cycle recorded, the meshes at the present worn surfaces.
///
/// # Errors
/// [`FieldsError`] if the present surfaces would invert an element, or a mesh cannot be factored again.
pub fn placed(
    model: &Model,
    condensed: &Condensed,
    depth: &Sides<Vec<f64>>,
    contacts: &[(Position, ContactState)],
) -> Result<Vec<PlacedFields>, FieldsError> {
    let worn = ale::relocate(model, depth)?;
    let at = |(position, contact): &(Position, ContactState)| {
        let body = |side: Side| -> Result<BodyFields, FieldsError> {
            let operators = condensed.operators.of(side);
            let zone = operators.zone_number(&contact.loaded(side)).unwrap_or(0);
            let (sign, load, place) = match side {
                Side::Slider => {
                    let load = contact.load(&model.interface);
                    (1.0, load, [contact.slider_x, contact.height])
                }
                Side::Receptacle => (-1.0, 0.0, [0.0; 2]),
            };
            let force: Vec<f64> = contact.force.of(side).iter().map(|f| sign * f).collect();
            let fields = recover(model, condensed, side, zone, &force, load)?;
            Ok(fields.placed(&worn.bodies.of(side).zones[zone], place)?)
        };
        Ok(PlacedFields {
            position: *position,
            slider: body(Side::Slider)?,
            receptacle: body(Side::Receptacle)?,
        })
    };
    contacts.iter().map(at).collect()
}

impl BodyFields {
    /// The same with its nodes on a worn mesh that is displaced, mm.
    fn placed(self, worn: &ZoneModel, by: [f64; 2]) -> Result<Self, MeshError> {
        let nodes = worn.mesh.coordinates();
        Ok(Self {
            nodes: nodes.iter().map(|n| [n[0] + by[0], n[1] + by[1]]).collect(),
            quality: worn.mesh.scaled_jacobians()?,
            ..self
        })
    }
}

/// Recovers the fields in the mesh of one zone of a body under forces on its contact nodes (x, y for each, N/mm) and its
/// far-face load (N/mm). They are those of the elements, without the near field that the contact is given.
///
/// # Errors
/// [`OperatorError`] if the mesh must be factored again and cannot be.
pub(crate) fn recover(
    model: &Model,
    condensed: &Condensed,
    side: Side,
    zone: usize,
    contact_force: &[f64],
    load: f64,
) -> Result<BodyFields, OperatorError> {
    let displacement_mm = condensed.displacements(model, side, zone, contact_force, load)?;
    let model = &model.bodies.of(side).zones[zone];
    let nodes = model.mesh.coordinates();
    let cells = model.mesh.cells();
    let mut sums = vec![(Stress::default(), 0.0); nodes.len()];
    for cell in &cells {
        match cell {
            Cell::Quad(n) => {
                let places = n.map(|n| nodes[n]);
                let u = n.map(|n| displacement_mm[n]);
                let modes = incompatible::amplitudes(&places, model.lame, model.b_bar, &u);
                let modes = modes.unwrap_or_default();
                add::<Quad4, 4>(&mut sums, n, &places, &u, model.lame, |corner, det| {
                    Some((
                        modes,
                        incompatible::mode_gradients::<Quad4, 4, 2>(&places, corner, det)?,
                    ))
                });
            }
            Cell::Tri(n) => {
                let (places, u) = (n.map(|n| nodes[n]), n.map(|n| displacement_mm[n]));
                add::<Tri3, 3>(&mut sums, n, &places, &u, model.lame, |_, _| None);
            }
        }
    }
    let stress = sums
        .iter()
        .map(|(s, w)| Stress {
            xx: s.xx / w,
            yy: s.yy / w,
            zz: s.zz / w,
            xy: s.xy / w,
            ..Stress::default()
        })
        .collect();
    Ok(BodyFields {
        nodes,
        cells,
        displacement_mm,
        stress,
        quality: Vec::new(),
    })
}

/// Amplitudes of incompatible modes and their gradients at a corner.
type Modes = ([[f64; 2]; 2], [[f64; 2]; 2]);

/// Adds an element's corner stresses to the sums of its nodes, weighted by the Jacobian there.
fn add<E: Element<N, 2>, const N: usize>(
    sums: &mut [(Stress, f64)],
    cell: &[usize; N],
    places: &[[f64; 2]; N],
    u: &[[f64; 2]; N],
    lame: Lame,
    modes: impl Fn([f64; 2], f64) -> Option<Modes>,
) {
    for (corner, node) in E::CORNERS.iter().zip(cell) {
        // A corner of a quadrilateral that has become a triangle has no gradient; its neighbours speak for it.
        let Some((g, det)) = physical_gradient(places, &E::gradient(*corner)) else {
            continue;
        };
        let mut strain = [[0.0; 2]; 2];
        let (amplitudes, gradients) = modes(*corner, det).unwrap_or_default();
        let terms = u.iter().zip(&g).chain(amplitudes.iter().zip(&gradients));
        for (u, g) in terms {
            for i in 0..2 {
                for j in 0..2 {
                    strain[i][j] += 0.5 * (u[i] * g[j] + u[j] * g[i]);
                }
            }
        }
        let volumetric = lame.lambda * (strain[0][0] + strain[1][1]);
        let (sum, weight) = &mut sums[*node];
        sum.xx += det * (volumetric + 2.0 * lame.mu * strain[0][0]);
        sum.yy += det * (volumetric + 2.0 * lame.mu * strain[1][1]);
        sum.zz += det * volumetric;
        sum.xy += det * 2.0 * lame.mu * strain[0][1];
        *weight += det;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::condensation::condense;
    use crate::model;
    use crate::model::tests::fuzz_button;

    #[test]
    fn equivalent_stresses_of_pure_shear_and_of_pressure() {
        let shear = Stress {
            xy: 2.0,
            ..Stress::default()
        };
        assert!((shear.von_mises() - 12.0_f64.sqrt()).abs() < 1e-14);
        assert!((shear.largest_shear() - 2.0).abs() < 1e-14);
        let pressure = Stress {
            xx: -3.0,
            yy: -3.0,
            zz: -3.0,
            ..Stress::default()
        };
        assert!(pressure.von_mises() < 1e-14 && pressure.largest_shear() < 1e-14);
        // The same shear in another plane.
        let along = Stress {
            yz: 2.0,
            ..pressure
        };
        assert!((along.von_mises() - 12.0_f64.sqrt()).abs() < 1e-14);
        assert!((along.largest_shear() - 2.0).abs() < 1e-14);
    }

    /// A wide block under an even pressure: sigma_yy = -p, sigma_xx = sigma_zz = -p nu/(1 - nu), no shear.
    #[test]
    fn stress_under_an_even_pressure_is_uniaxial_strain() {
        let mut scene = fuzz_button();
        scene.receptacle.shape.length_mm = 2.0;
        scene.receptacle.shape.height_mm = 0.05;
        scene.accuracy.contact_element_mm = Some(0.002);
        let model =
            model::build(&scene, &crate::effects::plan(&scene)).expect("the block can be meshed");
        let condensed = condense(&model, 1).expect("the block can be condensed");
        let force: Vec<f64> = model
            .bodies
            .receptacle
            .contact_widths()
            .iter()
            .flat_map(|w| [0.0, -7.0 * w])
            .collect();
        let fields = recover(&model, &condensed, Side::Receptacle, 0, &force, 0.0)
            .expect("the block is factored");
        let mesh = &model.bodies.receptacle.zones[0].mesh;
        let middle = mesh.surface_node(mesh.spines() / 2);
        let s = fields.stress[middle + 2];
        assert!((s.yy + 7.0).abs() < 1e-5 && s.xy.abs() < 1e-5, "{s:?}");
        assert!(
            (s.xx + 7.0 * 0.34 / 0.66).abs() < 1e-5 && (s.zz - s.xx).abs() < 1e-5,
            "{s:?}"
        );
    }
}
