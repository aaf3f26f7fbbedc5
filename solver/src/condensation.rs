//! Condensation: each body is linear elastic, so during a cycle only its contact surface matters.
//!
//! The stiffness is assembled with the contact unknowns last and factored once; the trailing block of the factor
//! gives the compliance of the contact surface, C = S^-1 with S = K_cc - K_ci K_ii^-1 K_ic.
//! A body keeps its operator in its own frame, so large sliding changes only the coupling of both surfaces. A surface
//! of several zones has an operator for each.

mod antiplane;
mod assembly;
mod body_operators;
mod compliance;
mod extruded;
pub(crate) mod harmonic;
mod near_field;
mod operator_error;
mod prism_assembly;
mod prism_interior;
mod spreading;
mod zone_operators;

use crate::linear::{CholeskyFactor, CholeskyPattern};
use crate::model::{BodyModel, Model, Support, ZoneModel};
use crate::sides::{Side, Sides};
use crate::threads::for_both;
use assembly::Numbering;
use std::sync::Arc;

pub(crate) use antiplane::Antiplane;
pub use body_operators::{BodyOperators, Operators};
pub(crate) use compliance::Compliance;
pub use compliance::Response;
pub(crate) use extruded::condense_extruded;
pub use extruded::{ExtrudedOperators, PrismZone};
pub use operator_error::OperatorError;
pub(crate) use prism_interior::PrismInterior;
pub use spreading::Spreading;
pub use zone_operators::ZoneOperators;

/// Condensed operators, and the factors behind them.
#[derive(Debug)]
pub struct Condensed {
    /// Operators of the contact surfaces.
    pub operators: Operators,
    /// Factored interior of a body that is one mesh; those of several zones are not stored.
    interior: Sides<Option<Interior>>,
    /// Bodies as conductors; `None` where the model does not conduct.
    pub spreading: Sides<Option<Spreading>>,
}

/// Operators of a body, the factor of its one mesh, and the body as a conductor.
type CondensedBody = ((BodyOperators, Option<Interior>), Option<Spreading>);

/// The factored stiffness of a mesh: gives interior displacements back.
#[derive(Debug)]
pub(crate) struct Interior {
    numbering: Numbering,
    factor: CholeskyFactor,
    far_load: Vec<f64>,
}

/// Condenses both bodies, one beside the other in more than one thread.
///
/// # Errors
/// [`OperatorError`] if an element is inverted or a body is not held.
pub fn condense(model: &Model, threads: usize) -> Result<Condensed, OperatorError> {
    let condensed = for_both(threads, model.bodies.as_ref(), |side, body| {
        let operators = condense_body(body, side, None)?;
        Ok((operators, spreading_of(model, side)?))
    });
    condensed.transpose().map(Condensed::of)
}

/// A body as a conductor, if the model conducts.
fn spreading_of(model: &Model, side: Side) -> Result<Option<Spreading>, OperatorError> {
    let body = model.bodies.of(side);
    let spreading = model.conducts.then(|| Spreading::of(body, side));
    spreading.transpose()
}

/// Condenses again what has changed from a model to the next: a body whose meshes are the same keeps its operators, one of
/// the same mesh lines its pattern. Both bodies are condensed as by [`condense`].
///
/// # Errors
/// [`OperatorError`] if an element is inverted or a body is not held.
pub fn renew(
    model: &Model,
    before: &Model,
    earlier: Condensed,
    threads: usize,
) -> Result<Condensed, OperatorError> {
    let known = earlier.operators.zip(earlier.interior);
    let known = known.zip(earlier.spreading).map(Some);
    let condensed = for_both(threads, known, |side, known: &mut Option<CondensedBody>| {
        let (body, earlier) = (model.bodies.of(side), before.bodies.of(side));
        // The old operators and factor are freed before the new ones are computed.
        let pattern = match known.take() {
            Some(same) if body.zones == earlier.zones => return Ok(same),
            Some(((_, Some(interior)), _)) if body.layout == earlier.layout => {
                Some(Arc::clone(interior.factor.pattern()))
            }
            _ => None,
        };
        let operators = condense_body(body, side, pattern)?;
        Ok((operators, spreading_of(model, side)?))
    });
    condensed.transpose().map(Condensed::of)
}

impl Condensed {
    fn of(Sides { slider, receptacle }: Sides<CondensedBody>) -> Self {
        let ((slider, slider_interior), slider_spreading) = slider;
        let ((receptacle, receptacle_interior), receptacle_spreading) = receptacle;
        Self {
            operators: Sides { slider, receptacle },
            interior: Sides {
                slider: slider_interior,
                receptacle: receptacle_interior,
            },
            spreading: Sides {
                slider: slider_spreading,
                receptacle: receptacle_spreading,
            },
        }
    }

    /// Resistance of both bodies around a contact between two places, mm, times the depth of the section over their resistivities, -;
    /// 0 where it is not part of the model.
    pub(crate) fn spreading_ratios(&self, span: (f64, f64)) -> Sides<f64> {
        Sides::from_fn(|side| {
            let spreading = self.spreading.of(side).as_ref();
            let ratio = spreading.and_then(|known| known.ratio(self.operators.of(side), span));
            ratio.unwrap_or_default()
        })
    }

    /// Displacements of all nodes of the mesh of one zone, mm, under nodal forces on the contact surface (x, y for each
    /// contact node, N/mm), which must lie in the zone, and a normal load on the far face where that carries one (N/mm).
    ///
    /// # Errors
    /// [`OperatorError`] if the mesh must be factored again and cannot be.
    pub fn displacements(
        &self,
        model: &Model,
        side: Side,
        zone: usize,
        contact_force: &[f64],
        load: f64,
    ) -> Result<Vec<[f64; 2]>, OperatorError> {
        let body = model.bodies.of(side);
        let first = body.first_node(&body.zones[zone]);
        let force = &contact_force[2 * first..2 * (first + body.zones[zone].zone.nodes())];
        if let Some(interior) = self.interior.of(side) {
            return Ok(interior.displacements(force, load));
        }
        let interior = factor(&body.zones[zone], side, None)?;
        Ok(interior.displacements(force, load))
    }
}

fn condense_body(
    body: &BodyModel,
    side: Side,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<(BodyOperators, Option<Interior>), OperatorError> {
    let widths = body.contact_widths();
    let condense_zone = |zone: &ZoneModel, pattern: Option<Arc<CholeskyPattern>>| {
        let interior = factor(zone, side, pattern)?;
        let first = body.first_node(zone);
        let widths = &widths[first..first + zone.zone.nodes()];
        let operators = interior.condensed(zone.support, first, widths);
        Ok((operators, interior))
    };
    let (zones, interior) = match &body.zones[..] {
        [whole] => {
            let (operators, interior) = condense_zone(whole, pattern)?;
            (vec![operators], Some(interior))
        }
        several => {
            let condensed = several.iter().map(|zone| Ok(condense_zone(zone, None)?.0));
            (condensed.collect::<Result<_, _>>()?, None)
        }
    };
    let operators = BodyOperators {
        x: body.contact_x().to_vec(),
        widths,
        profile: body.layout.profile,
        zones,
    };
    Ok((operators, interior))
}

/// Factors the stiffness of a mesh.
fn factor(
    zone: &ZoneModel,
    side: Side,
    pattern: Option<Arc<CholeskyPattern>>,
) -> Result<Interior, OperatorError> {
    let body = side.name();
    let numbering = Numbering::new(zone);
    let matrix = assembly::assemble(zone, &numbering)
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
    let far_load = match zone.support {
        Support::FarFaceHeld => vec![0.0; numbering.order()],
        Support::GuidedUnderPressure => assembly::far_face_load(zone, &numbering),
    };
    Ok(Interior {
        numbering,
        factor,
        far_load,
    })
}

impl Interior {
    /// Condenses onto the retained nodes, of which `first` is the first among the contact nodes and which have these
    /// widths.
    fn condensed(&self, support: Support, first: usize, widths: &[f64]) -> ZoneOperators {
        let mut compliance = self.numbering.expand(&self.factor.retained_inverse());
        if support == Support::FarFaceHeld {
            near_field::equalise(&mut compliance, widths);
        }
        let mut response = self.far_load.clone();
        self.factor.solve(&mut response);
        ZoneOperators::new(first, compliance, self.numbering.expand_vector(&response))
    }

    /// Displacements of all nodes, mm, under nodal forces on the retained nodes (x, y for each, N/mm) and a normal load
    /// on the far face where that carries one (N/mm).
    fn displacements(&self, contact_force: &[f64], load: f64) -> Vec<[f64; 2]> {
        let mut u: Vec<f64> = self.far_load.iter().map(|f| load * f).collect();
        self.numbering.add_contact_force(contact_force, &mut u);
        self.factor.solve(&mut u);
        self.numbering.nodal(&u)
    }
}

#[cfg(test)]
mod tests;
