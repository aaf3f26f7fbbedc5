//! Antiplane shear of a body: displacements w along the line of a contact under forces along it,
//!   mu div grad w = 0, mu dw/dn = tau on the contact surface,
//! mu shear modulus, tau traction along the line; w = 0 on the far face. In a section that is alike along the line this is apart from plane
//! strain. Its matrix is that of Laplace's equation (`spreading`) times mu.
//!
//! Limiting case: a bar of the height H under an even traction is sheared by tau H/mu.

use std::sync::Arc;

use super::operator_error::OperatorError;
use super::spreading::{HELD, assemble, numbering};
use crate::linear::{CholeskyFactor, CholeskyPattern};
use crate::model::{Support, ZoneModel};
use crate::sides::Side;

/// The factored mesh of a zone.
#[derive(Debug)]
pub(crate) struct Antiplane {
    unknown: Vec<usize>,
    first_contact: usize,
    /// `None` of a body whose nodes are all guided: nothing moves along the line.
    factor: Option<CholeskyFactor>,
    shear_modulus: f64,
}

impl Antiplane {
    /// Factors the mesh of a zone.
    ///
    /// # Errors
    /// [`OperatorError`] if an element is inverted or the body is not held.
    pub(crate) fn of(zone: &ZoneModel, side: Side) -> Result<Self, OperatorError> {
        let body = side.name();
        let (unknown, order, retained) = numbering(zone);
        let factor = match zone.support {
            Support::GuidedUnderPressure => None,
            Support::FarFaceHeld => {
                let matrix = assemble(zone, &unknown, order)
                    .map_err(|element| OperatorError::Inverted { body, element })?;
                let error = |source| OperatorError::Factor { body, source };
                let pattern = CholeskyPattern::new(matrix.starts, matrix.rows, retained);
                let pattern = Arc::new(pattern.map_err(error)?);
                Some(pattern.factor(&matrix.values).map_err(error)?)
            }
        };
        Ok(Self {
            unknown,
            first_contact: order - retained,
            factor,
            shear_modulus: zone.lame.mu,
        })
    }

    /// Displacements of all nodes along the line, mm, under forces along it on the contact nodes of the zone, N/mm.
    pub(crate) fn displacements(&self, contact_force: &[f64]) -> Vec<f64> {
        let Some(factor) = &self.factor else {
            return vec![0.0; self.unknown.len()];
        };
        let mut w = vec![0.0; self.first_contact];
        w.extend(contact_force.iter().map(|f| f / self.shear_modulus));
        factor.solve(&mut w);
        let nodal = self.unknown.iter();
        nodal
            .map(|slot| if *slot == HELD { 0.0 } else { w[*slot] })
            .collect()
    }
}
