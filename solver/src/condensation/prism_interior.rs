//! The factored stiffness of the prisms of a zone: condenses onto the contact nodes, and returns the displacements of all nodes.
//!
//! The factor takes several times the memory of the condensed response, and is computed again, with the analysed pattern, for fields.

use std::sync::Arc;

use super::OperatorError;
use super::prism_assembly::{PrismNumbering, assemble};
use crate::linear::{CholeskyFactor, CholeskyPattern};
use crate::mesh::{NodePlanes, PrismMesh};
use crate::model::{BodyModel, Support};
use crate::scene::Ends;
use crate::sides::Side;

/// A factored mesh of prisms.
#[derive(Debug)]
pub(crate) struct PrismInterior {
    pub(super) numbering: PrismNumbering,
    pub(super) factor: CholeskyFactor,
    /// Nodal forces of a unit of load on the far face, N per N/mm; zero where that is held.
    pub(super) far_load: Vec<f64>,
    /// Lengths that the sections stand for, mm.
    pub(super) lengths: Vec<f64>,
}

/// Factors the prisms between the sections of a zone.
pub(super) fn factor(
    bodies: &[&BodyModel],
    zone: usize,
    side: Side,
    planes: &NodePlanes,
    ends: Ends,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<PrismInterior, OperatorError> {
    let body = side.name();
    let first_section = &bodies[0].zones[zone];
    let sections = bodies.iter().map(|body| &body.zones[zone].mesh).collect();
    let mesh = PrismMesh::new(sections, planes);
    let support = first_section.support;
    let numbering = PrismNumbering::new(&mesh, first_section.zone.contact, support, ends);
    let (lame, b_bar) = (first_section.lame, first_section.b_bar);
    let matrix = assemble(&mesh, &numbering, lame, b_bar)
        .map_err(|element| OperatorError::Inverted { body, element })?;
    let factor_error = |source| OperatorError::Factor { body, source };
    let pattern = match pattern {
        Some(pattern) => pattern,
        None => Arc::new(
            CholeskyPattern::new(matrix.starts, matrix.rows, numbering.retained)
                .map_err(factor_error)?,
        ),
    };
    let factor = pattern.factor(&matrix.values).map_err(factor_error)?;
    let lengths = planes.lengths();
    let far_load = match support {
        Support::FarFaceHeld => vec![0.0; numbering.order],
        Support::GuidedUnderPressure => numbering.far_face_load(&mesh, &lengths),
    };
    Ok(PrismInterior {
        numbering,
        factor,
        far_load,
        lengths,
    })
}

impl PrismInterior {
    /// Displacements of all nodes, section by section, mm, under line forces on the contact nodes of the zone in each section (x, y for each,
    /// N/mm) and a normal load on the far face where that carries one, N/mm.
    pub(crate) fn displacements(&self, line_forces: &[&[f64]], load: f64) -> Vec<[f64; 3]> {
        let mut u: Vec<f64> = self.far_load.iter().map(|f| load * f).collect();
        let sections = line_forces.iter().zip(&self.lengths);
        let nodal = sections.flat_map(|(forces, length)| forces.iter().map(move |f| length * f));
        self.numbering.add_contact_forces(nodal, &mut u);
        self.factor.solve(&mut u);
        self.numbering.nodal(&u)
    }
}
