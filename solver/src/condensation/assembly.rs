//! Numbering of unknowns and assembly of a body's stiffness, lower triangle by columns.

use super::Compliance;
use crate::element::{Stiffness, Tri3, quad_stiffness, stiffness};
use crate::linear::SquareMatrix;
use crate::mesh::columns::Cell;
use crate::model::{Support, ZoneModel};

/// Marks a constrained displacement, which is zero.
pub(super) const HELD: usize = usize::MAX;

/// Numbering of the unknowns; those of the contact surface are last.
#[derive(Debug)]
pub(super) struct Numbering {
    /// Unknown of (node, direction).
    unknown: Vec<[usize; 2]>,
    /// Number of unknowns.
    order: usize,
    /// Unknowns of the contact surface.
    pub(super) retained: usize,
    /// For each contact unknown (2 i + d), its place among the retained ones.
    place: Vec<usize>,
}

impl Numbering {
    pub(super) fn new(zone: &ZoneModel) -> Self {
        let mesh = &zone.mesh;
        let mut unknown = vec![[0; 2]; mesh.nodes()];
        match zone.support {
            Support::FarFaceHeld => {
                for i in 0..mesh.spines() {
                    unknown[mesh.far_node(i)] = [HELD; 2];
                }
            }
            Support::GuidedUnderPressure => {
                for directions in &mut unknown {
                    directions[0] = HELD;
                }
                unknown[mesh.far_node(mesh.spines() / 2)][1] = HELD;
            }
        }
        let (first, end) = zone.zone.contact;
        let contact: Vec<usize> = (first..end).map(|i| mesh.surface_node(i)).collect();
        let mut is_contact = vec![false; mesh.nodes()];
        for &node in &contact {
            is_contact[node] = true;
        }
        let mut order = 0;
        let interior = (0..mesh.nodes()).filter(|&node| !is_contact[node]);
        for node in interior.chain(contact.iter().copied()) {
            for slot in unknown[node].iter_mut().filter(|slot| **slot != HELD) {
                *slot = order;
                order += 1;
            }
        }
        let retained: usize = contact
            .iter()
            .map(|&node| unknown[node].iter().filter(|&&slot| slot != HELD).count())
            .sum();
        let first = order - retained;
        let place = contact
            .iter()
            .flat_map(|&node| unknown[node])
            .map(|slot| if slot == HELD { HELD } else { slot - first })
            .collect();
        Self {
            unknown,
            order,
            retained,
            place,
        }
    }

    /// The inverse over the retained unknowns as a compliance of all contact displacements, zero where they are held.
    pub(super) fn expand(&self, retained: &SquareMatrix) -> Compliance {
        let mut all = Compliance::zeros(self.place.len() / 2);
        for (column, &c) in self.place.iter().enumerate().filter(|(_, c)| **c != HELD) {
            for (row, &r) in self.place.iter().enumerate().filter(|(_, r)| **r != HELD) {
                *all.at(row, column) = retained.get(r, c);
            }
        }
        all
    }

    /// Number of unknowns.
    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Adds forces on the contact surface to a vector over all unknowns.
    pub(super) fn add_contact_force(&self, force: &[f64], target: &mut [f64]) {
        let first = self.order - self.retained;
        for (&place, f) in self
            .place
            .iter()
            .zip(force)
            .filter(|(place, _)| **place != HELD)
        {
            target[first + place] += f;
        }
    }

    /// Displacements of all nodes of a vector over all unknowns, zero where they are held.
    pub(super) fn nodal(&self, u: &[f64]) -> Vec<[f64; 2]> {
        let value = |slot: usize| if slot == HELD { 0.0 } else { u[slot] };
        self.unknown.iter().map(|slots| slots.map(value)).collect()
    }

    /// The contact displacements of a vector over all unknowns.
    pub(super) fn expand_vector(&self, u: &[f64]) -> Vec<f64> {
        let first = self.order - self.retained;
        self.place
            .iter()
            .map(|&p| if p == HELD { 0.0 } else { u[first + p] })
            .collect()
    }
}

/// Lower triangle of a symmetric matrix by columns.
pub(super) struct LowerTriangle {
    pub(super) starts: Vec<usize>,
    pub(super) rows: Vec<usize>,
    pub(super) values: Vec<f64>,
}

/// Assembles the stiffness; the error is the number of an inverted element.
pub(super) fn assemble(zone: &ZoneModel, numbering: &Numbering) -> Result<LowerTriangle, usize> {
    let nodes = zone.mesh.coordinates();
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for (element, cell) in zone.mesh.cells().iter().enumerate() {
        let inverted = || element;
        match cell {
            Cell::Quad(n) => {
                let k = quad_stiffness(&n.map(|n| nodes[n]), zone.lame, zone.b_bar);
                scatter(
                    &mut entries,
                    &numbering.unknown,
                    n,
                    &k.ok_or_else(inverted)?,
                );
            }
            Cell::Tri(n) => {
                let k = stiffness::<Tri3, 3, 2>(&n.map(|n| nodes[n]), zone.lame, false);
                scatter(
                    &mut entries,
                    &numbering.unknown,
                    n,
                    &k.ok_or_else(inverted)?,
                );
            }
        }
    }
    Ok(compress(entries, numbering.order))
}

/// Adds the stiffness of an element to the entries (column, row, value) of the lower triangle.
pub(super) fn scatter<const N: usize, const D: usize>(
    entries: &mut Vec<(usize, usize, f64)>,
    unknown: &[[usize; D]],
    nodes: &[usize; N],
    k: &Stiffness<N, D>,
) {
    for (a, block_row) in nodes.iter().zip(k) {
        for (b, block) in nodes.iter().zip(block_row) {
            for (i, &row) in unknown[*a].iter().enumerate() {
                for (j, &column) in unknown[*b].iter().enumerate() {
                    if row != HELD && column != HELD && row >= column {
                        entries.push((column, row, block[(i, j)]));
                    }
                }
            }
        }
    }
}

/// Sorts by column and row and adds up equal places; stable, so that sums are taken in the order of elements.
pub(super) fn compress(entries: Vec<(usize, usize, f64)>, order: usize) -> LowerTriangle {
    let mut count = vec![0_usize; order + 1];
    for (column, ..) in &entries {
        count[column + 1] += 1;
    }
    for column in 0..order {
        count[column + 1] += count[column];
    }
    let mut next = count.clone();
    let mut sorted = vec![(0_usize, 0.0); entries.len()];
    for (column, row, value) in entries {
        sorted[next[column]] = (row, value);
        next[column] += 1;
    }
    let mut lower = LowerTriangle {
        starts: vec![0],
        rows: Vec::new(),
        values: Vec::new(),
    };
    for column in 0..order {
        let slice = &mut sorted[count[column]..count[column + 1]];
        slice.sort_by_key(|entry| entry.0);
        let begin = lower.rows.len();
        for &(row, value) in slice.iter() {
            match lower.values.last_mut() {
                Some(sum) if lower.rows.len() > begin && lower.rows.last() == Some(&row) => {
                    *sum += value;
                }
                _ => {
                    lower.rows.push(row);
                    lower.values.push(value);
                }
            }
        }
        lower.starts.push(lower.rows.len());
    }
    lower
}

/// Nodal forces of an even pressure on the far face whose resultant is one downward unit of force.
pub(super) fn far_face_load(zone: &ZoneModel, numbering: &Numbering) -> Vec<f64> {
    let x = zone.mesh.x();
    let length = x[x.len() - 1] - x[0];
    let mut force = vec![0.0; numbering.order];
    for i in 0..x.len() {
        let width = 0.5 * (x[(i + 1).min(x.len() - 1)] - x[i.saturating_sub(1)]);
        let slot = numbering.unknown[zone.mesh.far_node(i)][1];
        if slot != HELD {
            force[slot] -= width / length;
        }
    }
    force
}
