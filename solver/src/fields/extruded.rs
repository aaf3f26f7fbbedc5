//! Fields inside extruded bodies: displacements of all nodes of their prisms under the forces of the contact, and the stresses of these.
//!
//! The interior is factored again, zone by zone: a run keeps the response of the contact surfaces alone. Bodies are meshed as when their
//! operators were built, and lie at their present worn surfaces.
//!
//! Sections are the node planes from the middle of the width to one end, and z points that way. The other half is the mirror image: of the nodes
//! in the middle its elements have the opposite shears along z, so that their mean is zero.

use std::ops::Range;

use super::FieldsError;
use super::along_line::{LineFields, SectionFields, SweptFields};
use super::tractions::{SurfaceFields, SurfaceNodes, surface_fields};
use super::{Stress, prisms};
use crate::ale;
use crate::along_line::Along;
use crate::condensation::{ExtrudedOperators, OperatorError, PrismInterior};
use crate::contact::ContactState;
use crate::mesh::{NodePlanes, PrismMesh};
use crate::model::{BodyModel, Model, ZoneModel};
use crate::scene::{Extruded, LineShape};
use crate::schedule::increments::Position;
use crate::sides::{Side, Sides};

/// Extruded bodies in their state: sections from the free end to the middle of the width.
pub(crate) struct ExtrudedSections<'a> {
    pub(crate) shape: Extruded,
    pub(crate) planes: &'a NodePlanes,
    /// The section in each plane, worn as when the operators were built.
    pub(crate) models: &'a [Model],
    pub(crate) operators: &'a ExtrudedOperators,
    /// Where the planes lie.
    pub(crate) at: Vec<Along>,
    /// Present worn depths of each plane, mm.
    pub(crate) depths: Vec<&'a Sides<Vec<f64>>>,
    /// Contacts of all planes at the named positions.
    pub(crate) contacts: Vec<(Position, &'a [ContactState])>,
}

/// Fields of extruded bodies at the named positions.
///
/// # Errors
/// [`FieldsError`] if a present surface would invert an element, or a mesh cannot be factored.
pub(crate) fn extruded(bodies: &ExtrudedSections<'_>) -> Result<Vec<LineFields>, FieldsError> {
    let surface_fields: Vec<Vec<Sides<Vec<SurfaceFields>>>> = bodies
        .contacts
        .iter()
        .map(|(_, contacts)| bodies.surface_fields(contacts))
        .collect();
    let slider = bodies.of_side(Side::Slider, &surface_fields)?;
    let receptacle = bodies.of_side(Side::Receptacle, &surface_fields)?;
    let both = bodies
        .contacts
        .iter()
        .zip(slider.into_iter().zip(receptacle));
    let fields = both.map(|((position, _), (slider, receptacle))| LineFields {
        position: *position,
        shape: LineShape::Straight {
            width_mm: bodies.shape.width_mm,
            crown_radius_mm: None,
            tilt_mrad: 0.0,
        },
        at: bodies.at.iter().rev().copied().collect(),
        bodies: Sides { slider, receptacle },
    });
    Ok(fields.collect())
}

impl ExtrudedSections<'_> {
    /// Surface fields of the contact nodes of both bodies in each plane; nothing slips along the width.
    fn surface_fields(&self, contacts: &[ContactState]) -> Vec<Sides<Vec<SurfaceFields>>> {
        let (operators, interface) = (&self.operators.sections, &self.models[0].interface);
        let planes = contacts.iter().zip(&self.depths);
        planes
            .map(|(contact, depth)| surface_fields(operators, interface, depth, contact, None))
            .collect()
    }

    /// The zone of a body that holds the contact of all planes.
    fn zone(&self, side: Side, contacts: &[ContactState]) -> usize {
        let loaded = contacts.iter().map(|contact| contact.loaded(side));
        let of_all = loaded.filter(|range| !range.is_empty()).reduce(joined);
        let number = of_all.and_then(|range| self.operators.zone_number(side, &range));
        number.unwrap_or_default()
    }

    /// Fields of a body at all positions, each zone that holds one of them factored once.
    fn of_side(
        &self,
        side: Side,
        surface_fields: &[Vec<Sides<Vec<SurfaceFields>>>],
    ) -> Result<Vec<SweptFields>, FieldsError> {
        let contacts = self.contacts.iter().map(|(_, contacts)| contacts);
        let zones: Vec<usize> = contacts.map(|contacts| self.zone(side, contacts)).collect();
        let mut fields: Vec<(usize, SweptFields)> = Vec::new();
        for zone in 0..self.models[0].bodies.of(side).zones.len() {
            let placed = zones.iter().enumerate().filter(|(_, own)| **own == zone);
            let placed: Vec<usize> = placed.map(|(number, _)| number).collect();
            if placed.is_empty() {
                continue;
            }
            let body = InteriorOfZone::of(self, side, zone)?;
            for number in placed {
                let contacts = self.contacts[number].1;
                fields.push((number, body.swept(contacts, &surface_fields[number])?));
            }
        }
        fields.sort_by_key(|(number, _)| *number);
        Ok(fields.into_iter().map(|(_, fields)| fields).collect())
    }
}

fn joined(one: Range<usize>, other: Range<usize>) -> Range<usize> {
    one.start.min(other.start)..one.end.max(other.end)
}

/// A body meshed and factored for a zone.
struct InteriorOfZone<'a> {
    bodies: &'a ExtrudedSections<'a>,
    side: Side,
    zone: usize,
    interior: PrismInterior,
}

impl<'a> InteriorOfZone<'a> {
    fn of(
        bodies: &'a ExtrudedSections<'a>,
        side: Side,
        zone: usize,
    ) -> Result<Self, OperatorError> {
        let (planes, ends) = (bodies.planes, bodies.shape.ends);
        let interior = (bodies.operators).interior(bodies.models, planes, ends, side, zone)?;
        Ok(Self {
            bodies,
            side,
            zone,
            interior,
        })
    }

    fn body(&self, plane: usize) -> &'a BodyModel {
        self.bodies.models[plane].bodies.of(self.side)
    }

    fn zone(&self, plane: usize) -> &'a ZoneModel {
        &self.body(plane).zones[self.zone]
    }

    /// Fields of all planes from the middle on, of contacts and what their surfaces carry from the end on.
    fn swept(
        &self,
        contacts: &[ContactState],
        surface_fields: &[Sides<Vec<SurfaceFields>>],
    ) -> Result<SweptFields, FieldsError> {
        let (displacement, stress) = self.deformed(contacts);
        let zone = self.zone(0);
        let on_surface =
            SurfaceNodes::of(&zone.mesh, &zone.zone.spines, self.body(0).layout.contact);
        let nodes = zone.mesh.nodes();
        let section = |plane: usize| {
            let range = plane * nodes..(plane + 1) * nodes;
            let surface_y = ale::worn(
                self.body(plane),
                self.bodies.depths[plane].of(self.side),
                self.side,
            );
            let heights = zone.zone.spines.iter().map(|&spine| surface_y[spine]);
            let mesh = zone.mesh.with_surface(heights.collect());
            let by = match self.side {
                Side::Slider => [contacts[plane].slider_x, contacts[plane].height],
                Side::Receptacle => [0.0; 2],
            };
            let places = mesh.coordinates().into_iter();
            let moved = displacement[range.clone()].iter();
            let surface_fields = surface_fields[plane].of(self.side);
            let is_middle = plane + 1 == contacts.len();
            let stress = stress[range].iter().map(|stress| {
                if is_middle {
                    stress.without_shear_along_z()
                } else {
                    stress.mirrored_along_z()
                }
            });
            Ok(SectionFields {
                nodes: places.map(|[x, y]| [x + by[0], y + by[1]]).collect(),
                displacement_mm: moved.map(|[x, y, z]| [*x, *y, -z]).collect(),
                stress: stress.collect(),
                quality: mesh.scaled_jacobians()?,
                surface_fields: on_surface
                    .contact
                    .iter()
                    .map(|&i| surface_fields[i])
                    .collect(),
            })
        };
        let sections: Result<_, FieldsError> = (0..contacts.len()).rev().map(section).collect();
        Ok(SweptFields {
            cells: zone.mesh.cells(),
            sections: sections?,
            surface: on_surface.nodes,
        })
    }

    /// Displacements and stresses at all nodes of the prisms, section by section from the end on.
    fn deformed(&self, contacts: &[ContactState]) -> (Vec<[f64; 3]>, Vec<Stress>) {
        let (body, zone) = (self.body(0), self.zone(0));
        let (sign, load) = match self.side {
            Side::Slider => (1.0, contacts[0].load(&self.bodies.models[0].interface)),
            Side::Receptacle => (-1.0, 0.0),
        };
        let first = body.first_node(zone);
        let nodes = 2 * first..2 * (first + zone.zone.nodes());
        let forces = contacts.iter().map(|contact| {
            let own = &contact.force.of(self.side)[nodes.clone()];
            own.iter().map(|f| sign * f).collect()
        });
        let forces: Vec<Vec<f64>> = forces.collect();
        let forces: Vec<&[f64]> = forces.iter().map(Vec::as_slice).collect();
        let displacement = self.interior.displacements(&forces, load);
        let sections = 0..contacts.len();
        let meshes = sections.map(|plane| &self.zone(plane).mesh);
        let mesh = PrismMesh::new(meshes.collect(), self.bodies.planes);
        let stress = prisms::stress(&mesh, zone.lame, zone.b_bar, &displacement);
        (displacement, stress)
    }
}
