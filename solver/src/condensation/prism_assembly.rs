//! Numbering of unknowns and assembly of the stiffness of prisms, lower triangle by columns.

use nalgebra::SMatrix;

use super::assembly::{HELD, LowerTriangle};
use crate::element::{Wedge6, hex_stiffness, stiffness};
use crate::law::elastic::Lame;
use crate::mesh::{Prism, PrismMesh};
use crate::model::Support;
use crate::scene::Ends;

/// Numbering of the unknowns: those of the contact surface in its plane are last, section by section.
#[derive(Debug)]
pub(super) struct PrismNumbering {
    /// Unknown of (node, direction).
    unknown: Vec<[usize; 3]>,
    /// Number of unknowns.
    pub(super) order: usize,
    /// Retained unknowns.
    pub(super) retained: usize,
    /// For each contact unknown, 2 (k n + i) + d of section k, its place among the retained ones.
    pub(super) place: Vec<usize>,
}

impl PrismNumbering {
    /// Numbers the unknowns of a mesh whose retained spines are these.
    pub(super) fn new(
        mesh: &PrismMesh<'_>,
        (first, end): (usize, usize),
        support: Support,
        ends: Ends,
    ) -> Self {
        let mut unknown = held(mesh, support, ends);
        let nodes = mesh.nodes_of_section();
        let contact: Vec<usize> = (0..mesh.sections())
            .flat_map(|k| (first..end).map(move |i| (k, i)))
            .map(|(k, i)| k * nodes + mesh.section(k).surface_node(i))
            .collect();
        let mut is_contact = vec![false; unknown.len()];
        for &node in &contact {
            is_contact[node] = true;
        }
        let mut order = 0;
        let mut number = |slot: &mut usize| {
            if *slot != HELD {
                *slot = order;
                order += 1;
            }
        };
        for (slots, is_contact) in unknown.iter_mut().zip(&is_contact) {
            let inner = if *is_contact { 2 } else { 0 };
            slots[inner..].iter_mut().for_each(&mut number);
        }
        for &node in &contact {
            unknown[node][..2].iter_mut().for_each(&mut number);
        }
        let slots = contact
            .iter()
            .flat_map(|&node| [unknown[node][0], unknown[node][1]]);
        let retained = slots.clone().filter(|slot| *slot != HELD).count();
        let place = slots
            .map(|slot| {
                if slot == HELD {
                    HELD
                } else {
                    slot - (order - retained)
                }
            })
            .collect();
        Self {
            unknown,
            order,
            retained,
            place,
        }
    }

    /// Adds nodal forces on the contact surface, N, x and y of each contact node section by section, to a vector over all unknowns.
    pub(super) fn add_contact_forces(&self, forces: impl Iterator<Item = f64>, target: &mut [f64]) {
        let first = self.order - self.retained;
        let slots = self.place.iter().zip(forces);
        for (place, f) in slots.filter(|(place, _)| **place != HELD) {
            target[first + place] += f;
        }
    }

    /// Displacements of all nodes of a vector over all unknowns, zero where they are held.
    pub(super) fn nodal(&self, u: &[f64]) -> Vec<[f64; 3]> {
        let value = |slot: usize| if slot == HELD { 0.0 } else { u[slot] };
        self.unknown.iter().map(|slots| slots.map(value)).collect()
    }

    /// Nodal forces, N, of an even pressure on the far face whose resultant is one downward unit of force per length; `lengths` of the
    /// sections in mm.
    pub(super) fn far_face_load(&self, mesh: &PrismMesh<'_>, lengths: &[f64]) -> Vec<f64> {
        let x = mesh.section(0).x();
        let span = x[x.len() - 1] - x[0];
        let widths = crate::mesh::grading::tributary(x);
        let mut force = vec![0.0; self.order];
        for (k, length) in lengths.iter().enumerate() {
            for (i, width) in widths.iter().enumerate() {
                let node = k * mesh.nodes_of_section() + mesh.section(k).far_node(i);
                let slot = self.unknown[node][1];
                if slot != HELD {
                    force[slot] -= length * width / span;
                }
            }
        }
        force
    }
}

/// The unknowns of all nodes: constrained ones are marked, the others have no number yet.
fn held(mesh: &PrismMesh<'_>, support: Support, ends: Ends) -> Vec<[usize; 3]> {
    let nodes = mesh.nodes_of_section();
    let mirror = mesh.sections() - 1;
    let mut unknown = vec![[0; 3]; nodes * mesh.sections()];
    for k in 0..mesh.sections() {
        let section = mesh.section(k);
        let slots = &mut unknown[k * nodes..(k + 1) * nodes];
        if k == mirror || ends == Ends::Held {
            for slots in slots.iter_mut() {
                slots[2] = HELD;
            }
        }
        if support == Support::GuidedUnderPressure {
            for slots in slots.iter_mut() {
                slots[0] = HELD;
            }
        }
        for i in 0..section.spines() {
            match support {
                Support::FarFaceHeld => slots[section.far_node(i)] = [HELD; 3],
                Support::GuidedUnderPressure => slots[section.far_node(i)][2] = HELD,
            }
        }
        if support == Support::GuidedUnderPressure && k == mirror {
            slots[section.far_node(section.spines() / 2)][1] = HELD;
        }
    }
    unknown
}

/// Assembles the stiffness; the error is the number of an inverted element.
pub(super) fn assemble(
    mesh: &PrismMesh<'_>,
    numbering: &PrismNumbering,
    lame: Lame,
    b_bar: bool,
) -> Result<LowerTriangle, usize> {
    let prisms = mesh.prisms();
    let mut matrix = pattern(&prisms, numbering);
    let nodes = mesh.coordinates();
    for (element, prism) in prisms.iter().enumerate() {
        match prism {
            Prism::Hexahedron(n) => {
                let k = hex_stiffness(&n.map(|n| nodes[n]), lame, b_bar).ok_or(element)?;
                scatter(&mut matrix, numbering, n, &k);
            }
            Prism::Wedge(n) => {
                let k = stiffness::<Wedge6, 6, 3>(&n.map(|n| nodes[n]), lame, false);
                scatter(&mut matrix, numbering, n, &k.ok_or(element)?);
            }
        }
    }
    Ok(matrix)
}

/// The entries of the matrix, all zero.
fn pattern(prisms: &[Prism], numbering: &PrismNumbering) -> LowerTriangle {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); numbering.unknown.len()];
    for prism in prisms {
        let nodes: &[usize] = match prism {
            Prism::Hexahedron(nodes) => nodes,
            Prism::Wedge(nodes) => nodes,
        };
        for &node in nodes {
            neighbours[node].extend_from_slice(nodes);
        }
    }
    let mut columns: Vec<Vec<usize>> = vec![Vec::new(); numbering.order];
    for (node, around) in neighbours.iter_mut().enumerate() {
        around.sort_unstable();
        around.dedup();
        for &column in numbering.unknown[node].iter().filter(|slot| **slot != HELD) {
            let slots = around.iter().flat_map(|&node| numbering.unknown[node]);
            let rows = &mut columns[column];
            rows.extend(slots.filter(|row| *row != HELD && *row >= column));
            rows.sort_unstable();
        }
    }
    let mut matrix = LowerTriangle {
        starts: vec![0],
        rows: Vec::new(),
        values: Vec::new(),
    };
    for rows in columns {
        matrix.rows.extend(rows);
        matrix.starts.push(matrix.rows.len());
    }
    matrix.values = vec![0.0; matrix.rows.len()];
    matrix
}

fn scatter<const N: usize>(
    matrix: &mut LowerTriangle,
    numbering: &PrismNumbering,
    nodes: &[usize; N],
    k: &[[SMatrix<f64, 3, 3>; N]; N],
) {
    for (a, block_row) in nodes.iter().zip(k) {
        for (b, block) in nodes.iter().zip(block_row) {
            for (i, &row) in numbering.unknown[*a].iter().enumerate() {
                for (j, &column) in numbering.unknown[*b].iter().enumerate() {
                    if row == HELD || column == HELD || row < column {
                        continue;
                    }
                    let entries = matrix.starts[column]..matrix.starts[column + 1];
                    let place = matrix.rows[entries.clone()].partition_point(|r| *r < row);
                    matrix.values[entries.start + place] += block[(i, j)];
                }
            }
        }
    }
}
