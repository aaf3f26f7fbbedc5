//! Condensation: each body is linear elastic, so during a cycle only its contact surface matters.
//!
//! The stiffness is assembled with the contact unknowns last and factored once; the trailing block of the factor
//! gives the compliance of the contact surface, C = S^-1 with S = K_cc - K_ci K_ii^-1 K_ic.
//! A body keeps its operator in its own frame, so large sliding changes only the coupling of both surfaces.

mod assembly;
mod compliance;
mod near_field;

use crate::linear::{CholeskyFactor, CholeskyPattern, FactorError};
use crate::model::{BodyModel, Model, Profile, Support};
use crate::sides::{Side, Sides};
use assembly::Numbering;
use std::sync::Arc;

pub use compliance::{Block, Compliance};

/// Why operators cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OperatorError {
    /// An element is inverted.
    #[error("element {element} of the {body} is inverted")]
    Inverted {
        /// Which body.
        body: &'static str,
        /// Its number, columns first.
        element: usize,
    },
    /// The stiffness matrix cannot be factored.
    #[error("{body}: {source}")]
    Factor {
        /// Which body.
        body: &'static str,
        /// Why.
        source: FactorError,
    },
}

/// Condensed operators of both bodies.
pub type Operators = Sides<BodyOperators>;

/// One body seen from its contact surface.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyOperators {
    /// Places of the contact nodes in the body's frame, mm, ascending.
    pub x: Vec<f64>,
    /// Length of surface that belongs to each node, projected on x, mm.
    pub widths: Vec<f64>,
    /// The unworn surface.
    pub profile: Profile,
    /// Displacements of the contact nodes per force at them.
    pub compliance: Compliance,
    /// Displacement of the surface unknowns per unit of normal load on the far face, mm per N/mm; zero where the
    /// far face is held.
    pub load_response: Vec<f64>,
}

/// Condensed operators, and the factors behind them.
#[derive(Debug)]
pub struct Condensed {
    /// Operators of the contact surfaces.
    pub operators: Operators,
    /// Factored interiors.
    pub interior: Sides<Interior>,
}

/// The factored stiffness of a body: gives interior displacements back.
#[derive(Debug)]
pub struct Interior {
    numbering: Numbering,
    factor: CholeskyFactor,
    far_load: Vec<f64>,
}

/// Condenses both bodies.
///
/// # Errors
/// [`OperatorError`] if an element is inverted or a body is not held.
pub fn condense(model: &Model) -> Result<Condensed, OperatorError> {
    let bodies = Sides::from_fn(|side| condense_body(model.bodies.of(side), side, None));
    Ok(Condensed::of(bodies.transpose()?))
}

/// Condenses again what has changed from a model of the same topology to the next: a body whose mesh is the same
/// keeps its operators, the other one its pattern.
///
/// # Errors
/// [`OperatorError`] if an element is inverted or a body is not held.
pub fn renew(
    model: &Model,
    before: &Model,
    earlier: Condensed,
) -> Result<Condensed, OperatorError> {
    let renew_body = |side: Side, (operators, interior): (BodyOperators, Interior)| {
        let body = model.bodies.of(side);
        if body.mesh == before.bodies.of(side).mesh {
            return Ok((operators, interior));
        }
        let pattern = Some(interior.factor.pattern().clone());
        // The old factor is freed before the new one is computed.
        drop(interior);
        condense_body(body, side, pattern)
    };
    let Sides { slider, receptacle } = earlier.operators.zip(earlier.interior);
    Ok(Condensed::of(Sides {
        slider: renew_body(Side::Slider, slider)?,
        receptacle: renew_body(Side::Receptacle, receptacle)?,
    }))
}

impl Condensed {
    fn of(bodies: Sides<(BodyOperators, Interior)>) -> Self {
        let Sides { slider, receptacle } = bodies;
        Self {
            operators: Sides {
                slider: slider.0,
                receptacle: receptacle.0,
            },
            interior: Sides {
                slider: slider.1,
                receptacle: receptacle.1,
            },
        }
    }
}

fn condense_body(
    model: &BodyModel,
    side: Side,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<(BodyOperators, Interior), OperatorError> {
    let body = side.name();
    let numbering = Numbering::new(model);
    let matrix = assembly::assemble(model, &numbering)
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
    let mut compliance = numbering.expand(&factor.retained_inverse());
    if model.support == Support::FarFaceHeld {
        near_field::equalise(&mut compliance, &model.contact_widths());
    }
    let far_load = match model.support {
        Support::FarFaceHeld => vec![0.0; numbering.order()],
        Support::GuidedUnderPressure => assembly::far_face_load(model, &numbering),
    };
    let mut response = far_load.clone();
    factor.solve(&mut response);
    let operators = BodyOperators {
        x: model.contact_x().to_vec(),
        widths: model.contact_widths(),
        profile: model.profile,
        compliance,
        load_response: numbering.expand_vector(&response),
    };
    Ok((
        operators,
        Interior {
            numbering,
            factor,
            far_load,
        },
    ))
}

impl Interior {
    /// Displacements of all nodes, mm, under nodal forces on the contact surface (x, y for each contact node, N/mm)
    /// and a normal load on the far face where that carries one (N/mm).
    pub fn displacements(&self, contact_force: &[f64], load: f64) -> Vec<[f64; 2]> {
        let mut u: Vec<f64> = self.far_load.iter().map(|f| load * f).collect();
        self.numbering.add_contact_force(contact_force, &mut u);
        self.factor.solve(&mut u);
        self.numbering.nodal(&u)
    }
}

#[cfg(test)]
mod tests;
