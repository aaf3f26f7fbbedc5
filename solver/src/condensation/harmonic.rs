//! Compliance of a body under a line load that varies along the line as a wave, P cos(k s): its displacement into the contact, weighted with
//! Hertz' pressure of unit resultant, on the same mesh as that of a section (`element::harmonic`).
//!
//! Against the same number of an even load with the far face held, it is what sections in plane strain do not know of each other.
//! Limiting cases: waves that are long against the body change nothing where its far face is held; those that are short against it and
//! long against the contact leave (2 (1 - nu^2)/(pi E)) ln(1/k) + constant, the half-space's.

use std::sync::Arc;

use super::assembly::{HELD, LowerTriangle, compress, scatter};
use super::operator_error::OperatorError;
use crate::element::harmonic::{Waves, harmonic_stiffness};
use crate::element::{Quad4, Tri3};
use crate::linear::CholeskyPattern;
use crate::mesh::columns::Cell;
use crate::model::{BodyModel, ZoneModel};
use crate::sides::Side;

/// Boundary condition on the far face of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FarFace {
    /// All displacements are zero.
    Held,
    /// Those in its plane are zero; an even pressure acts on it.
    HeldInPlane,
}

/// Displacements of a body into its contact under line loads of amplitude 1 that vary as these waves, mm per N/mm, in the contact of a
/// half-width in mm at the section's x = 0.
///
/// Range: no waves, and one around a ring, need a far face that is held: else they move the body without strain.
///
/// # Errors
/// [`OperatorError`] if an element is inverted or reaches over the axis of a ring.
pub(crate) fn harmonic_compliances(
    body: &BodyModel,
    side: Side,
    half_width: f64,
    waves: &[(Waves, FarFace)],
) -> Result<Vec<f64>, OperatorError> {
    let zone = &body.zones[body.zone_at(0.0)];
    let body = side.name();
    let mut compliances = Vec::with_capacity(waves.len());
    // Waves under the same far face share the numbering, the load and the pattern.
    for same in waves.chunk_by(|one, next| one.1 == next.1) {
        let unknown = numbered(zone, same[0].1);
        let load = load(zone, &unknown, side, half_width);
        let mut known: Option<Arc<CholeskyPattern>> = None;
        for (waves, _) in same {
            let matrix = assemble(zone, &unknown, load.len(), *waves)
                .map_err(|element| OperatorError::Inverted { body, element })?;
            let failed = |source| OperatorError::Factor { body, source };
            let pattern = if let Some(pattern) = known.take() {
                pattern
            } else {
                let pattern = CholeskyPattern::new(matrix.starts, matrix.rows, 0);
                Arc::new(pattern.map_err(failed)?)
            };
            let mut displacement = load.clone();
            let factor = pattern.factor(&matrix.values).map_err(failed)?;
            factor.solve(&mut displacement);
            compliances.push(load.iter().zip(&displacement).map(|(f, u)| f * u).sum());
            known = Some(pattern);
        }
    }
    Ok(compliances)
}

/// Unknown of (node, direction).
fn numbered(zone: &ZoneModel, far: FarFace) -> Vec<[usize; 3]> {
    let mesh = &zone.mesh;
    let mut unknown = vec![[0; 3]; mesh.nodes()];
    for i in 0..mesh.spines() {
        let slots = &mut unknown[mesh.far_node(i)];
        (slots[0], slots[2]) = (HELD, HELD);
        if far == FarFace::Held {
            slots[1] = HELD;
        }
    }
    let free = unknown.iter_mut().flatten().filter(|slot| **slot != HELD);
    for (number, slot) in free.enumerate() {
        *slot = number;
    }
    unknown
}

/// Assembles the stiffness of so many unknowns; the error is the number of an inverted element.
fn assemble(
    zone: &ZoneModel,
    unknown: &[[usize; 3]],
    order: usize,
    waves: Waves,
) -> Result<LowerTriangle, usize> {
    let nodes = zone.mesh.coordinates();
    let (lame, b_bar) = (zone.lame, zone.b_bar);
    let mut entries = Vec::new();
    for (element, cell) in zone.mesh.cells().iter().enumerate() {
        match cell {
            Cell::Quad(n) => {
                let k = harmonic_stiffness::<Quad4, 4>(&n.map(|n| nodes[n]), lame, b_bar, waves);
                scatter(&mut entries, unknown, n, &k.ok_or(element)?);
            }
            Cell::Tri(n) => {
                let k = harmonic_stiffness::<Tri3, 3>(&n.map(|n| nodes[n]), lame, b_bar, waves);
                scatter(&mut entries, unknown, n, &k.ok_or(element)?);
            }
        }
    }
    Ok(compress(entries, order))
}

/// Nodal forces into the body of Hertz' pressure on its surface, whose resultant is 1; that of one node where none other is in the contact.
fn load(zone: &ZoneModel, unknown: &[[usize; 3]], side: Side, half_width: f64) -> Vec<f64> {
    let mesh = &zone.mesh;
    let x = mesh.x();
    let pressure = |x: f64| (1.0 - (x / half_width).powi(2)).max(0.0).sqrt();
    let width = |i: usize| x[(i + 1).min(x.len() - 1)] - x[i.saturating_sub(1)];
    let mut shares: Vec<f64> = (0..x.len()).map(|i| pressure(x[i]) * width(i)).collect();
    let sum: f64 = shares.iter().sum();
    if sum > 0.0 {
        for share in &mut shares {
            *share /= sum;
        }
    } else {
        let middle = x.partition_point(|x| *x < 0.0).min(x.len() - 1);
        shares[middle] = 1.0;
    }
    let order = unknown.iter().flatten().filter(|slot| **slot != HELD);
    let mut force = vec![0.0; order.count()];
    let into_body = match side {
        Side::Slider => 1.0,
        Side::Receptacle => -1.0,
    };
    for (i, share) in shares.iter().enumerate() {
        let slot = unknown[mesh.surface_node(i)][1];
        if slot != HELD {
            force[slot] = into_body * share;
        }
    }
    force
}

#[cfg(test)]
mod full_ring;
#[cfg(test)]
mod tests;
