//! Condensation: each body is linear elastic, so during a cycle only its contact surface matters.
//!
//! The stiffness is assembled with the contact unknowns last and factored once; the trailing block of the factor
//! gives the compliance of the contact surface, C = S^-1 with S = K_cc - K_ci K_ii^-1 K_ic.
//! A body keeps its operator in its own frame, so large sliding changes only the coupling of both surfaces.

mod assembly;
mod compliance;

use crate::linear::{CholeskyFactor, CholeskyPattern, FactorError};
use crate::model::{BodyModel, Model, Profile, Support};
use assembly::Numbering;
use std::sync::Arc;

pub use compliance::{Block, Compliance};

const SLIDER: &str = "slider";
const RECEPTACLE: &str = "receptacle";

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
#[derive(Debug, Clone, PartialEq)]
pub struct Operators {
    /// The slider's.
    pub slider: BodyOperators,
    /// The receptacle's.
    pub receptacle: BodyOperators,
}

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
    /// What the contact needs.
    pub operators: Operators,
    /// The slider's interior.
    pub slider: Interior,
    /// The receptacle's interior.
    pub receptacle: Interior,
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
    let slider = condense_body(&model.slider, SLIDER, None)?;
    let receptacle = condense_body(&model.receptacle, RECEPTACLE, None)?;
    Ok(Condensed::of(slider, receptacle))
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
    let again = |now: &BodyModel, then: &BodyModel, name, operators, inside: Interior| {
        if now.mesh == then.mesh {
            return Ok((operators, inside));
        }
        let pattern = Some(inside.factor.pattern().clone());
        drop(inside);
        condense_body(now, name, pattern)
    };
    let Operators { slider, receptacle } = earlier.operators;
    let slider = again(
        &model.slider,
        &before.slider,
        SLIDER,
        slider,
        earlier.slider,
    )?;
    let below = earlier.receptacle;
    let receptacle = again(
        &model.receptacle,
        &before.receptacle,
        RECEPTACLE,
        receptacle,
        below,
    )?;
    Ok(Condensed::of(slider, receptacle))
}

impl Condensed {
    fn of(slider: (BodyOperators, Interior), receptacle: (BodyOperators, Interior)) -> Self {
        Self {
            operators: Operators {
                slider: slider.0,
                receptacle: receptacle.0,
            },
            slider: slider.1,
            receptacle: receptacle.1,
        }
    }
}

fn condense_body(
    model: &BodyModel,
    body: &'static str,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<(BodyOperators, Interior), OperatorError> {
    let numbering = Numbering::new(model);
    let matrix = assembly::assemble(model, &numbering)
        .map_err(|element| OperatorError::Inverted { body, element })?;
    let factor_error = |source| OperatorError::Factor { body, source };
    let pattern = match pattern {
        Some(pattern) => pattern,
        None => Arc::new(
            CholeskyPattern::new(matrix.starts, matrix.rows, numbering.kept)
                .map_err(factor_error)?,
        ),
    };
    let factor = pattern.factor(&matrix.values).map_err(factor_error)?;
    let compliance = numbering.spread(&factor.kept_inverse());
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
        load_response: numbering.spread_vector(&response),
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
