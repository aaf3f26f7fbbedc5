//! Prisms over the columns of several plane meshes: hexahedra over quadrilaterals, wedges over triangles.
//!
//! ```text
//!   z = 0, free end        o-----o-----o        section k of a body: its mesh at z_k, with surface heights of its own
//!     layers               |     |     |        node (k, n): section k, node n of its mesh
//!   z = w/2, mirror plane  o-----o-----o
//! ```
//! All sections have the same topology, so the surfaces at both ends of a prism may be worn differently.

use super::columns::{Cell, ColumnMesh, scaled_jacobian};
use super::{MeshError, grading};
use crate::element::{Hex8, Wedge6};

/// Places of the sections, and the lengths that they stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct NodePlanes {
    z: Vec<f64>,
}

impl NodePlanes {
    /// The planes of `layers` layers, which must be even, over a width in mm: from the free end to the mirror plane in its middle, each
    /// layer longer than the one before by the growth.
    pub fn new(width: f64, layers: usize, growth: f64) -> Self {
        let mut lengths = vec![1.0];
        while lengths.len() < layers / 2 {
            lengths.push(growth * lengths[lengths.len() - 1]);
        }
        let sum: f64 = lengths.iter().sum();
        let mut z = vec![0.0];
        for length in &lengths {
            z.push(z[z.len() - 1] + 0.5 * width * length / sum);
        }
        let last = z.len() - 1;
        z[last] = 0.5 * width;
        Self { z }
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.z.len()
    }

    /// Distance of each from the free end, mm.
    pub fn z(&self) -> &[f64] {
        &self.z
    }

    /// Length of the half width that each stands for, mm.
    pub fn lengths(&self) -> Vec<f64> {
        grading::tributary(&self.z)
    }

    /// The same over the half width; their sum is 1.
    pub fn shares(&self) -> Vec<f64> {
        let half = self.z[self.z.len() - 1];
        self.lengths().iter().map(|length| length / half).collect()
    }
}

/// A mesh of prisms.
#[derive(Debug, Clone, PartialEq)]
pub struct PrismMesh<'a> {
    sections: Vec<&'a ColumnMesh>,
    planes: &'a NodePlanes,
}

/// A prism by its nodes: those of one end, counter-clockwise, then those of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Prism {
    /// Over a quadrilateral.
    Hexahedron([usize; 8]),
    /// Over a triangle.
    Wedge([usize; 6]),
}

impl<'a> PrismMesh<'a> {
    /// Prisms between sections of the same topology, one in each plane.
    pub fn new(sections: Vec<&'a ColumnMesh>, planes: &'a NodePlanes) -> Self {
        debug_assert!(sections.len() == planes.count(), "a section in each plane");
        Self { sections, planes }
    }

    /// Number of sections.
    pub fn sections(&self) -> usize {
        self.sections.len()
    }

    /// The mesh of a section.
    pub fn section(&self, plane: usize) -> &ColumnMesh {
        self.sections[plane]
    }

    /// Number of nodes of a section.
    pub fn nodes_of_section(&self) -> usize {
        self.sections[0].nodes()
    }

    /// Coordinates of all nodes, mm, section by section.
    pub fn coordinates(&self) -> Vec<[f64; 3]> {
        let sections = self.sections.iter().zip(self.planes.z());
        let of_section = |(section, z): (&&ColumnMesh, &f64)| {
            let nodes = section.coordinates().into_iter();
            nodes.map(|[x, y]| [x, y, *z]).collect::<Vec<_>>()
        };
        sections.flat_map(of_section).collect()
    }

    /// All elements, layer by layer.
    pub fn prisms(&self) -> Vec<Prism> {
        let (cells, nodes) = (self.sections[0].cells(), self.nodes_of_section());
        let mut prisms = Vec::with_capacity(cells.len() * (self.sections() - 1));
        for layer in 0..self.sections() - 1 {
            let at = |n: usize, end: usize| (layer + end) * nodes + n;
            prisms.extend(cells.iter().map(|cell| match cell {
                Cell::Quad(n) => Prism::Hexahedron(std::array::from_fn(|a| at(n[a % 4], a / 4))),
                Cell::Tri(n) => Prism::Wedge(std::array::from_fn(|a| at(n[a % 3], a / 3))),
            }));
        }
        prisms
    }

    /// Checks that no element is inverted.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] where a Jacobian is not positive.
    pub fn check(&self) -> Result<(), MeshError> {
        let nodes = self.coordinates();
        for (element, prism) in self.prisms().iter().enumerate() {
            let (scaled, corner) = match prism {
                Prism::Hexahedron(n) => (scaled_jacobian::<Hex8, 8, 3>(&n.map(|n| nodes[n])), n[0]),
                Prism::Wedge(n) => (scaled_jacobian::<Wedge6, 6, 3>(&n.map(|n| nodes[n])), n[0]),
            };
            if scaled.is_none() {
                return Err(MeshError::Inverted {
                    element,
                    x_mm: nodes[corner][0],
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{Element, physical_gradient};

    fn volume<E: Element<N, 3>, const N: usize>(nodes: &[[f64; 3]; N]) -> f64 {
        let dv = |(xi, weight): &([f64; 3], f64)| {
            let (_, det) = physical_gradient(nodes, &E::gradient(*xi)).expect("not inverted");
            weight * det
        };
        E::QUADRATURE.iter().map(dv).sum()
    }

    #[test]
    fn layers_grow_from_the_free_end_to_the_mirror_plane() {
        let planes = NodePlanes::new(6.0, 4, 2.0);
        assert_eq!(planes.z(), [0.0, 1.0, 3.0]);
        assert_eq!(planes.lengths(), [0.5, 1.5, 1.0]);
        assert!((planes.shares().iter().sum::<f64>() - 1.0).abs() < 1e-15);
        assert_eq!(NodePlanes::new(6.0, 2, 2.0).z(), [0.0, 3.0]);
    }

    #[test]
    fn prisms_between_unlike_surfaces_fill_the_body() {
        let planes = NodePlanes::new(2.0, 4, 1.5);
        // Above and below its surface, with a fan of triangles at the tip of the middle.
        for far in [-1.0, 1.0] {
            let heights = |at: f64| vec![-far * at, 0.9 * far, far, 0.0];
            let x = vec![0.0, 1.0, 2.0, 2.5];
            let mesh = ColumnMesh::new(x, heights(0.0), far, vec![0.0, 0.5, 1.0]);
            let sections: Vec<ColumnMesh> = (planes.z().iter())
                .map(|z| mesh.with_surface(heights(*z)))
                .collect();
            let prisms = PrismMesh::new(sections.iter().collect(), &planes);
            assert!(prisms.check().is_ok());
            let nodes = prisms.coordinates();
            let filled: f64 = (prisms.prisms().iter())
                .map(|prism| match prism {
                    Prism::Hexahedron(n) => volume::<Hex8, 8>(&n.map(|n| nodes[n])),
                    Prism::Wedge(n) => volume::<Wedge6, 6>(&n.map(|n| nodes[n])),
                })
                .sum();
            // Areas 0.55 + 0.05 + 0.25 at z = 0, and half of z more.
            assert!((filled - (0.85 + 0.25)).abs() < 1e-14, "{filled}");
        }
    }
}
