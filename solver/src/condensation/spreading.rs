//! Spreading of the current in a body: Laplace's equation on the mesh of the elastic body,
//!   div grad V = 0,
//! V potential over rho I/w, rho resistivity, I current, w depth of the section; V = 0 on the far face, no current through the rest of the
//! surface but the contact. The conductance is assembled with the contact nodes last and factored once, as the stiffness is; the inverse of
//! its trailing block G gives the potentials of the contact nodes under unit currents.
//!
//! The resistance of a contact from x1 to x2 is rho/w q G q, q the share of the current of each node: that of a strip of one potential on a
//! half-plane, 1/(pi sqrt(b^2 - x^2)), over which the shape functions are integrated. A distribution that is off changes the resistance by
//! the square of that (Thomson's principle); elements change it by an order of their length, as the flux is singular at both edges.
//! Limiting cases: H/(2 B) of a bar of height H and length 2 B with a contact as long as the bar; a contact of 2 c in its middle adds
//! (1/pi) ln(1/sin(pi c/2B)).
//! Range: a current that enters evenly along the depth of the section; layers of a plating are no part of it.

use std::f64::consts::PI;
use std::sync::Arc;

use super::assembly::{LowerTriangle, compress};
use super::body_operators::BodyOperators;
use super::operator_error::OperatorError;
use crate::element::{Element, Quad4, Tri3, physical_gradient};
use crate::linear::{CholeskyPattern, SquareMatrix};
use crate::mesh::columns::Cell;
use crate::model::{BodyModel, ZoneModel};
use crate::sides::Side;

/// Marks a node of the far face, whose potential is zero.
pub(super) const HELD: usize = usize::MAX;

/// The body as a conductor, seen from its contact nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Spreading {
    /// Inverse conductance of the contact nodes of each zone, and the first of these nodes.
    zones: Vec<(usize, SquareMatrix)>,
}

impl Spreading {
    /// Condenses the conductance of a body.
    ///
    /// # Errors
    /// [`OperatorError`] if an element is inverted or nothing connects the contact with the far face.
    pub(super) fn of(body: &BodyModel, side: Side) -> Result<Self, OperatorError> {
        let zones = body.zones.iter().map(|zone| {
            let inverse = condensed(zone, side)?;
            Ok((body.first_node(zone), inverse))
        });
        Ok(Self {
            zones: zones.collect::<Result<_, _>>()?,
        })
    }

    /// Resistance times w/rho of a contact between two places, mm, -; `None` outside of the contact nodes.
    pub fn ratio(&self, body: &BodyOperators, span: (f64, f64)) -> Option<f64> {
        let (first, shares) = shares(&body.x, span)?;
        let zone = body.zone_number(&(first..first + shares.len()))?;
        let (zone_first, inverse) = &self.zones[zone];
        let first = first - zone_first;
        let mut ratio = 0.0;
        for (column, right) in shares.iter().enumerate() {
            for (row, left) in shares.iter().enumerate() {
                ratio += left * right * inverse.get(first + row, first + column);
            }
        }
        Some(ratio)
    }
}

/// The first node of a contact, and the share of the current of each of its nodes.
fn shares(x: &[f64], (from, to): (f64, f64)) -> Option<(usize, Vec<f64>)> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    if half <= 0.0 {
        let nearest = x.iter().position(|place| *place >= middle)?;
        return Some((nearest, vec![1.0]));
    }
    // Integrals of the distribution and of its first moment from the left edge on, over the half-length.
    let at = |place: f64| ((place - middle) / half).clamp(-1.0, 1.0);
    let sum = |t: f64| t.asin() / PI;
    let moment = |t: f64| -(1.0 - t * t).max(0.0).sqrt() / PI;
    let last = x.len().checked_sub(1)?;
    let first = x.iter().rposition(|place| *place <= from).unwrap_or(0);
    let end = x.iter().position(|place| *place >= to).unwrap_or(last);
    let mut shares = vec![0.0; end + 1 - first];
    for (i, ends) in x[first..=end].windows(2).enumerate() {
        let (left, right) = (at(ends[0]), at(ends[1]));
        let (whole, moment) = (sum(right) - sum(left), moment(right) - moment(left));
        // Linear shape functions along the whole element, in half-lengths from the middle.
        let [begin, length] = [(ends[0] - middle) / half, (ends[1] - ends[0]) / half];
        let of_right = (moment - begin * whole) / length;
        shares[i] += whole - of_right;
        shares[i + 1] += of_right;
    }
    Some((first, shares))
}

fn condensed(zone: &ZoneModel, side: Side) -> Result<SquareMatrix, OperatorError> {
    let body = side.name();
    let (unknown, order, retained) = numbering(zone);
    let matrix = assemble(zone, &unknown, order)
        .map_err(|element| OperatorError::Inverted { body, element })?;
    let factor_error = |source| OperatorError::Factor { body, source };
    let pattern =
        CholeskyPattern::new(matrix.starts, matrix.rows, retained).map_err(factor_error)?;
    let factor = Arc::new(pattern)
        .factor(&matrix.values)
        .map_err(factor_error)?;
    Ok(factor.retained_inverse())
}

/// Unknown of each node, those of the contact last; their number, and that of the contact.
pub(super) fn numbering(zone: &ZoneModel) -> (Vec<usize>, usize, usize) {
    let mesh = &zone.mesh;
    let mut unknown = vec![0; mesh.nodes()];
    for i in 0..mesh.spines() {
        unknown[mesh.far_node(i)] = HELD;
    }
    let (first, end) = zone.zone.contact;
    let contact: Vec<usize> = (first..end).map(|i| mesh.surface_node(i)).collect();
    let mut is_contact = vec![false; mesh.nodes()];
    for &node in &contact {
        is_contact[node] = true;
    }
    let interior = (0..mesh.nodes()).filter(|node| !is_contact[*node]);
    let mut order = 0;
    for node in interior.chain(contact.iter().copied()) {
        if unknown[node] != HELD {
            unknown[node] = order;
            order += 1;
        }
    }
    (unknown, order, contact.len())
}

/// Assembles the conductance; the error is the number of an inverted element.
pub(super) fn assemble(
    zone: &ZoneModel,
    unknown: &[usize],
    order: usize,
) -> Result<LowerTriangle, usize> {
    let nodes = zone.mesh.coordinates();
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for (element, cell) in zone.mesh.cells().iter().enumerate() {
        let inverted = || element;
        match cell {
            Cell::Quad(n) => {
                let k = conductance::<Quad4, 4>(&n.map(|n| nodes[n])).ok_or_else(inverted)?;
                scatter(&mut entries, &n.map(|n| unknown[n]), &k);
            }
            Cell::Tri(n) => {
                let k = conductance::<Tri3, 3>(&n.map(|n| nodes[n])).ok_or_else(inverted)?;
                scatter(&mut entries, &n.map(|n| unknown[n]), &k);
            }
        }
    }
    Ok(compress(entries, order))
}

/// Conductance of an element of unit conductivity and depth: integral of grad `N_a` . grad `N_b`.
fn conductance<E: Element<N, 2>, const N: usize>(nodes: &[[f64; 2]; N]) -> Option<[[f64; N]; N]> {
    let mut k = [[0.0; N]; N];
    for &(xi, weight) in E::QUADRATURE {
        let (g, det) = physical_gradient(nodes, &E::gradient(xi))?;
        for (row, a) in k.iter_mut().zip(&g) {
            for (entry, b) in row.iter_mut().zip(&g) {
                *entry += det * weight * (a[0] * b[0] + a[1] * b[1]);
            }
        }
    }
    Some(k)
}

fn scatter<const N: usize>(
    entries: &mut Vec<(usize, usize, f64)>,
    unknown: &[usize; N],
    k: &[[f64; N]; N],
) {
    for (row, values) in unknown.iter().zip(k) {
        for (column, value) in unknown.iter().zip(values) {
            if *row != HELD && *column != HELD && row >= column {
                entries.push((*column, *row, *value));
            }
        }
    }
}
