//! Fields inside the bodies of a contact along a line: those of its sections, on mesh lines that all of them share.
//!
//! A section deforms in plane strain by the forces on it, and by its friction along the line in antiplane shear: the two are apart where the bodies
//! are alike along the line. The friction along the line is what the limit leaves beside that across it, sqrt((mu p)^2 - q^2), as the whole
//! contact slips. Stresses that follow from the curvature of a ring, or from what changes from a section to the next, are no part of it.
//!
//! The mesh of a section is fine where its contact is. A file of swept elements needs the same elements in all sections: these have the spines
//! that any of them has (`common_mesh`), and the nodes of each section lie at its own worn surfaces.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use rayon::iter::{
    IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator,
};

use super::FieldsError;
use super::common_mesh::CommonMesh;
use super::tractions::{FrictionAlong, SurfaceFields, SurfaceNodes, slip_sign, surface_fields};
use super::{BodyFields, Stress, antiplane, recover};
use crate::ale;
use crate::along_line::{Along, SectionContact};
use crate::condensation::{Antiplane, Condensed, OperatorError};
use crate::contact::{self, ContactState};
use crate::mesh::columns::Cell;
use crate::model::{BodyModel, Model, Tangential, ZoneModel};
use crate::scene::LineShape;
use crate::schedule::increments::Position;
use crate::sides::{Side, Sides};

/// Fields of both bodies along a line at one position of the slider.
#[derive(Debug, Clone, PartialEq)]
pub struct LineFields {
    /// Position in the cycle.
    pub position: Position,
    /// The line.
    pub shape: LineShape,
    /// Where the sections lie on it.
    pub at: Vec<Along>,
    /// The fields of each body.
    pub bodies: Sides<SweptFields>,
}

/// Fields of one body in all sections.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptFields {
    /// Elements of each section by their nodes.
    pub cells: Vec<Cell>,
    /// Numbers of the nodes on the contact surface.
    pub surface: Vec<usize>,
    /// The sections in their order.
    pub sections: Vec<SectionFields>,
}

/// Fields of a section of a body. Vectors and stresses are those of the section: x across the line, y up, z along the line, to larger angles of a
/// ring or distances from the middle.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionFields {
    /// Places of the nodes, undeformed, the slider at its place at that moment, mm: across the line and up.
    pub nodes: Vec<[f64; 2]>,
    /// Displacements, mm.
    pub displacement_mm: Vec<[f64; 3]>,
    /// Stress at the nodes.
    pub stress: Vec<Stress>,
    /// Smallest determinant of the Jacobian over its mean, for every element.
    pub quality: Vec<f64>,
    /// Fields of the nodes on the contact surface, in the order of `surface`.
    pub surface_fields: Vec<SurfaceFields>,
}

/// A section in its state.
pub(crate) struct SectionState<'a> {
    pub(crate) at: Along,
    pub(crate) model: &'a Model,
    pub(crate) condensed: &'a Condensed,
    pub(crate) depth: &'a Sides<Vec<f64>>,
    /// Contacts at the named positions, the same ones in all sections.
    pub(crate) contacts: Vec<SectionContact<'a>>,
}

/// Factored meshes of a section for friction along the line, by the number of their zone.
type Factored = Sides<BTreeMap<usize, Antiplane>>;

/// Fields along a line at the named positions, sections in the threads that the caller is one of. `slides` where the contact has slid already.
///
/// # Errors
/// [`FieldsError`] if a present surface would invert an element, or a mesh cannot be factored.
pub(crate) fn along_line(
    shape: LineShape,
    sections: &[SectionState<'_>],
    slides: bool,
) -> Result<Vec<LineFields>, FieldsError> {
    let Some(first) = sections.first() else {
        return Ok(Vec::new());
    };
    let mut factored: Vec<Factored> = sections.iter().map(|_| Factored::default()).collect();
    let mut fields = Vec::with_capacity(first.contacts.len());
    for (number, at) in first.contacts.iter().enumerate() {
        let placed: Vec<SectionAtPosition<'_>> = sections
            .iter()
            .map(|section| SectionAtPosition::of(section, number, slides.then_some(shape)))
            .collect();
        let bodies = Sides::from_fn(|side| swept(side, &placed, &mut factored)).transpose()?;
        fields.push(LineFields {
            position: at.position,
            shape,
            at: sections.iter().map(|section| section.at).collect(),
            bodies,
        });
    }
    Ok(fields)
}

/// A section with its contact at a position.
struct SectionAtPosition<'a> {
    section: &'a SectionState<'a>,
    contact: &'a ContactState,
    /// Number of the zone of each body that holds the contact.
    zone: Sides<usize>,
    surface_fields: Sides<Vec<SurfaceFields>>,
}

impl<'a> SectionAtPosition<'a> {
    fn of(section: &'a SectionState<'a>, number: usize, slides: Option<LineShape>) -> Self {
        let SectionContact {
            position,
            contact,
            friction,
            ..
        } = section.contacts[number];
        let zone = Sides::from_fn(|side| {
            let operators = section.condensed.operators.of(side);
            operators
                .zone_number(&contact.loaded(side))
                .unwrap_or_default()
        });
        let along = slides.map(|shape| FrictionAlong {
            direction: slip_sign(shape, section.at, position),
            coefficients: friction,
        });
        Self {
            section,
            contact,
            zone,
            surface_fields: surface_fields(
                &section.condensed.operators,
                &section.model.interface,
                section.depth,
                contact,
                along,
            ),
        }
    }

    fn body(&self, side: Side) -> &'a BodyModel {
        self.section.model.bodies.of(side)
    }

    fn zone(&self, side: Side) -> &'a ZoneModel {
        &self.body(side).zones[*self.zone.of(side)]
    }

    /// Displacements and stresses of a body at the nodes of its mesh.
    fn deformed(
        &self,
        side: Side,
        factored: &mut Factored,
    ) -> Result<(Vec<[f64; 3]>, Vec<Stress>), FieldsError> {
        let SectionState {
            model, condensed, ..
        } = *self.section;
        let number = *self.zone.of(side);
        let (sign, load) = match side {
            Side::Slider => (1.0, self.contact.load(&model.interface)),
            Side::Receptacle => (-1.0, 0.0),
        };
        let force = self.contact.force.of(side).iter();
        let force: Vec<f64> = force.map(|f| sign * f).collect();
        let BodyFields {
            displacement_mm,
            mut stress,
            ..
        } = recover(model, condensed, side, number, &force, load)?;
        let along = self.along(side, factored)?;
        for (stress, [xz, yz]) in stress
            .iter_mut()
            .zip(antiplane::stress(self.zone(side), &along))
        {
            (stress.xz, stress.yz) = (xz, yz);
        }
        let displacement = displacement_mm.iter().zip(&along);
        Ok((
            displacement
                .map(|(u, along)| [u[0], u[1], *along])
                .collect(),
            stress,
        ))
    }

    /// Displacements of a body along the line at the nodes of its mesh, mm, by the friction along the line.
    fn along(&self, side: Side, factored: &mut Factored) -> Result<Vec<f64>, OperatorError> {
        let zone = self.zone(side);
        let first = self.body(side).first_node(zone);
        let nodes = first..first + zone.zone.nodes();
        let operators = self.section.condensed.operators.of(side);
        let slopes = contact::slopes(operators, self.section.depth.of(side), side);
        let lengths = nodes
            .clone()
            .map(|i| operators.widths[i] * slopes[i].hypot(1.0));
        let surface_fields = self.surface_fields.of(side)[nodes].iter().zip(lengths);
        let force: Vec<f64> = surface_fields
            .map(|(surface_fields, length)| length * surface_fields.shear_mpa[2])
            .collect();
        // Without a part of the friction in the contact nothing deforms by it.
        let deforms = self.section.model.interface.tangential != Tangential::Omitted;
        if !deforms || force.iter().all(|f| *f == 0.0) {
            return Ok(vec![0.0; zone.mesh.nodes()]);
        }
        let antiplane = match factored.of_mut(side).entry(*self.zone.of(side)) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(Antiplane::of(zone, side)?),
        };
        Ok(antiplane.displacements(&force))
    }
}

/// The fields of a body in all sections.
fn swept(
    side: Side,
    placed: &[SectionAtPosition<'_>],
    factored: &mut [Factored],
) -> Result<SweptFields, FieldsError> {
    let body = placed[0].body(side);
    let common = CommonMesh::of(body, placed.iter().map(|placed| placed.zone(side)));
    let on_surface = SurfaceNodes::of(&common.mesh, common.spines(), body.layout.contact);
    let section = |(placed, factored): (&SectionAtPosition<'_>, &mut Factored)| {
        let surface_y = ale::worn(body, placed.section.depth.of(side), side);
        let mesh = common.with_surface(&surface_y);
        let by = match side {
            Side::Slider => [placed.contact.slider_x, placed.contact.height],
            Side::Receptacle => [0.0; 2],
        };
        let (displacement, stress) = placed.deformed(side, factored)?;
        let zone = placed.zone(side);
        let between = |from: &[f64; 3], to: &[f64; 3], share: f64| {
            std::array::from_fn(|i| (1.0 - share) * from[i] + share * to[i])
        };
        let nodes = mesh.coordinates();
        Ok(SectionFields {
            nodes: nodes.iter().map(|n| [n[0] + by[0], n[1] + by[1]]).collect(),
            displacement_mm: common.values(zone, &displacement, between),
            stress: common.values(zone, &stress, Stress::towards),
            quality: mesh.scaled_jacobians()?,
            surface_fields: on_surface
                .contact
                .iter()
                .map(|&i| placed.surface_fields.of(side)[i])
                .collect(),
        })
    };
    let sections: Vec<Result<_, FieldsError>> = if rayon::current_thread_index().is_none() {
        // One after the other, without a pool.
        placed.iter().zip(factored).map(section).collect()
    } else {
        let sections = placed.par_iter().zip(factored.par_iter_mut());
        sections.with_max_len(1).map(section).collect()
    };
    Ok(SweptFields {
        cells: common.mesh.cells(),
        surface: on_surface.nodes,
        sections: sections.into_iter().collect::<Result<_, _>>()?,
    })
}
