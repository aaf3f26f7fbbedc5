//! Columns of quadrilaterals between a contact surface and a straight far face.
//!
//! ```text
//!   far face    o-----o-----o-----o        node (i, l): spine i, layer l
//!               |     |     |     |        l = 0 on the contact surface,
//!               o-----o-----o-----o        l = layers on the far face
//!   surface     o-----o-----o-----o
//! ```
//! Spines are vertical, so the surface is a graph y(x) and wear shortens spines without changing the topology.
//! A spine whose length is zero is one node; its neighbours end there in a fan of triangles.

use super::MeshError;
use crate::element::{Element, Quad4, Tri3, physical_gradient};

/// Spines shorter than this part of the longest one are taken as one node.
const TIP: f64 = 1e-9;

/// Returns `true` if a spine of a length, in a mesh whose longest spine is `longest`, is a single node.
pub(crate) fn is_tip(length: f64, longest: f64) -> bool {
    length.abs() <= TIP * longest
}

/// A structured mesh of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnMesh {
    x: Vec<f64>,
    surface_y: Vec<f64>,
    far_y: f64,
    fractions: Vec<f64>,
    /// First node of each spine, and the number of nodes at the end.
    first: Vec<usize>,
}

/// An element by its nodes, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// Quadrilateral.
    Quad([usize; 4]),
    /// Triangle.
    Tri([usize; 3]),
}

/// The worst element of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Smallest determinant of the Jacobian over the element's mean, 1 for parallelograms.
    pub smallest_scaled_jacobian: f64,
    /// Shortest spine, mm.
    pub shortest_spine_mm: f64,
}

impl ColumnMesh {
    /// A mesh on spines at `x` (ascending) from `surface_y` to `far_y`, cut at `fractions` (0 to 1).
    pub fn new(x: Vec<f64>, surface_y: Vec<f64>, far_y: f64, fractions: Vec<f64>) -> Self {
        debug_assert!(x.len() == surface_y.len(), "one surface height a spine");
        let longest = surface_y
            .iter()
            .fold(0.0, |m: f64, y| m.max((far_y - y).abs()));
        let mut first = Vec::with_capacity(x.len() + 1);
        let mut next = 0;
        for y in &surface_y {
            first.push(next);
            next += if is_tip(far_y - y, longest) {
                1
            } else {
                fractions.len()
            };
        }
        first.push(next);
        Self {
            x,
            surface_y,
            far_y,
            fractions,
            first,
        }
    }

    /// The same topology with another surface.
    #[must_use]
    pub(crate) fn with_surface(&self, surface_y: Vec<f64>) -> Self {
        Self {
            surface_y,
            ..self.clone()
        }
    }

    /// Number of spines, which is the number of surface nodes.
    pub fn spines(&self) -> usize {
        self.x.len()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.first[self.x.len()]
    }

    /// Positions of the spines, mm.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Heights of the surface nodes, mm.
    pub fn surface_y(&self) -> &[f64] {
        &self.surface_y
    }

    /// The surface node of spine `i`.
    pub fn surface_node(&self, i: usize) -> usize {
        self.first[i]
    }

    /// The far node of spine `i`.
    pub fn far_node(&self, i: usize) -> usize {
        self.first[i + 1] - 1
    }

    /// The node of spine `i` on a layer; of a spine without length its only one.
    pub fn node(&self, i: usize, layer: usize) -> usize {
        (self.first[i] + layer).min(self.far_node(i))
    }

    fn is_tip(&self, i: usize) -> bool {
        self.first[i + 1] - self.first[i] == 1
    }

    /// Coordinates of all nodes, mm.
    pub fn coordinates(&self) -> Vec<[f64; 2]> {
        let mut nodes = Vec::with_capacity(self.nodes());
        for (i, (&x, &y)) in self.x.iter().zip(&self.surface_y).enumerate() {
            if self.is_tip(i) {
                nodes.push([x, self.far_y]);
            } else {
                nodes.extend(self.fractions.iter().map(|f| [x, y + f * (self.far_y - y)]));
            }
        }
        nodes
    }

    /// Checks whether the far face lies above the surface, by the longest spine: the rounded end of one without length may lie on either side.
    fn is_upward(&self) -> bool {
        let lengths = self.surface_y.iter().map(|y| self.far_y - y);
        lengths.fold(0.0, |most: f64, length| {
            if length.abs() > most.abs() {
                length
            } else {
                most
            }
        }) > 0.0
    }

    /// All elements, columns first, layer by layer.
    pub fn cells(&self) -> Vec<Cell> {
        let up = self.is_upward();
        let mut cells = Vec::new();
        for i in 0..self.spines() - 1 {
            let (a, b) = (self.first[i], self.first[i + 1]);
            for l in 0..self.fractions.len() - 1 {
                match (self.is_tip(i), self.is_tip(i + 1)) {
                    (false, false) => cells.push(Cell::Quad(if up {
                        [a + l, b + l, b + l + 1, a + l + 1]
                    } else {
                        [a + l + 1, b + l + 1, b + l, a + l]
                    })),
                    (false, true) => cells.push(Cell::Tri(ordered([a + l, b, a + l + 1], up))),
                    (true, false) => cells.push(Cell::Tri(ordered([a, b + l, b + l + 1], up))),
                    (true, true) => {}
                }
            }
        }
        cells
    }

    /// The worst element.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] where a Jacobian is not positive.
    pub fn quality(&self) -> Result<Quality, MeshError> {
        let worst = self.scaled_jacobians()?.into_iter().fold(1.0, f64::min);
        let shortest = (0..self.spines())
            .filter(|&i| !self.is_tip(i))
            .fold(f64::INFINITY, |m, i| {
                m.min((self.far_y - self.surface_y[i]).abs())
            });
        Ok(Quality {
            smallest_scaled_jacobian: worst,
            shortest_spine_mm: shortest,
        })
    }

    /// Smallest determinant of the Jacobian over its mean, for every element; 1 for parallelograms.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] where a Jacobian is not positive.
    pub(crate) fn scaled_jacobians(&self) -> Result<Vec<f64>, MeshError> {
        let nodes = self.coordinates();
        let scaled = |(element, cell): (usize, &Cell)| {
            let (scaled, corner) = match cell {
                Cell::Quad(n) => (scaled_jacobian::<Quad4, 4, 2>(&n.map(|n| nodes[n])), n[0]),
                Cell::Tri(n) => (scaled_jacobian::<Tri3, 3, 2>(&n.map(|n| nodes[n])), n[0]),
            };
            scaled.ok_or(MeshError::Inverted {
                element,
                x_mm: nodes[corner][0],
            })
        };
        self.cells().iter().enumerate().map(scaled).collect()
    }
}

fn ordered(nodes: [usize; 3], counter_clockwise: bool) -> [usize; 3] {
    if counter_clockwise {
        nodes
    } else {
        [nodes[0], nodes[2], nodes[1]]
    }
}

pub(super) fn scaled_jacobian<E: Element<N, D>, const N: usize, const D: usize>(
    nodes: &[[f64; D]; N],
) -> Option<f64> {
    let (mut smallest, mut sum) = (f64::INFINITY, 0.0);
    for &(xi, _) in E::QUADRATURE {
        let (_, det) = physical_gradient(nodes, &E::gradient(xi))?;
        smallest = smallest.min(det);
        sum += det;
    }
    Some(smallest * crate::number::real(E::QUADRATURE.len()) / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(mesh: &ColumnMesh) -> f64 {
        let nodes = mesh.coordinates();
        let shoelace = |ids: &[usize]| -> f64 {
            (0..ids.len())
                .map(|k| {
                    let (a, b) = (nodes[ids[k]], nodes[ids[(k + 1) % ids.len()]]);
                    0.5 * (a[0] * b[1] - b[0] * a[1])
                })
                .sum()
        };
        mesh.cells()
            .iter()
            .map(|cell| match cell {
                Cell::Quad(n) => shoelace(n),
                Cell::Tri(n) => shoelace(n),
            })
            .sum()
    }

    #[test]
    fn a_block_has_its_area_and_positive_elements_above_and_below_its_surface() {
        for far in [-2.0, 2.0] {
            let mesh = ColumnMesh::new(
                vec![-1.0, 0.0, 0.5, 1.0],
                vec![0.0; 4],
                far,
                vec![0.0, 0.2, 1.0],
            );
            assert!((area(&mesh) - 4.0).abs() < 1e-14);
            let quality = mesh.quality().expect("no element is inverted");
            assert!((quality.smallest_scaled_jacobian - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_spine_without_length_is_one_node_with_a_fan_of_triangles() {
        let mesh = ColumnMesh::new(
            vec![0.0, 1.0, 2.0],
            vec![1.0, 0.0, 1.0],
            1.0,
            vec![0.0, 0.5, 1.0],
        );
        assert_eq!(mesh.nodes(), 5);
        assert_eq!(mesh.cells().len(), 4);
        assert!((area(&mesh) - 1.0).abs() < 1e-14);
        assert!(mesh.quality().is_ok());
    }

    #[test]
    fn the_rounded_end_of_a_spine_without_length_turns_no_element() {
        for far in [-0.1_f64, 0.1] {
            for beside in [far.next_down(), far, far.next_up()] {
                let surface = vec![beside, 0.0, beside];
                let mesh = ColumnMesh::new(vec![0.0, 0.1, 0.2], surface, far, vec![0.0, 0.5, 1.0]);
                assert!((area(&mesh) - 0.01).abs() < 1e-15);
                assert!(mesh.quality().is_ok());
            }
        }
    }

    #[test]
    fn one_surface_beyond_the_far_face_inverts_the_elements_at_its_spine_alone() {
        let x = vec![0.0, 1.0, 2.0, 3.0];
        let mesh = ColumnMesh::new(x, vec![0.0, 0.0, 0.0, 1.5], 1.0, vec![0.0, 1.0]);
        let inverted = MeshError::Inverted {
            element: 2,
            x_mm: 2.0,
        };
        assert_eq!(mesh.quality(), Err(inverted));
    }

    #[test]
    fn moving_the_surface_keeps_the_topology() {
        let mesh = ColumnMesh::new(vec![0.0, 1.0], vec![0.0; 2], -1.0, vec![0.0, 0.5, 1.0]);
        let worn = mesh.with_surface(vec![-0.9, -0.5]);
        assert_eq!(mesh.cells(), worn.cells());
        assert!((area(&worn) - 0.3).abs() < 1e-14);
    }
}
