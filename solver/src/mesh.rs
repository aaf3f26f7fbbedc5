//! Structured meshes: columns of quadrilaterals hanging on straight spines, with triangles where a column
//! shrinks to a point; prisms over such meshes. A mesh knows no law.

pub mod columns;
pub(crate) mod grading;
pub mod prisms;

pub use columns::{ColumnMesh, Quality};
pub use prisms::{NodePlanes, Prism, PrismMesh};

/// Why a mesh cannot be built or moved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// An element is inverted.
    #[error("element {element} near x = {x_mm:.6} mm is inverted")]
    Inverted {
        /// Number, columns first.
        element: usize,
        /// Where it is, mm.
        x_mm: f64,
    },
    /// The mesh would be larger than the engine takes.
    #[error(
        "{nodes} surface nodes on one body are more than the limit of {limit}: the contact is too narrow for its travel"
    )]
    TooLarge {
        /// Surface nodes asked for.
        nodes: usize,
        /// The limit.
        limit: usize,
    },
}
