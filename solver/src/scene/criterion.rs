//! Criteria: how far a contact wears until a run, or a life, ends.

use crate::sides::Side;

/// A criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Criterion {
    /// The deepest wear has reached a depth.
    WornDepth {
        /// The side; either if absent.
        side: Option<Side>,
        /// The depth, mm.
        depth_mm: f64,
    },
    /// A part of the scar is worn through a layer and all layers above it.
    ExposedFraction {
        /// The side.
        side: Side,
        /// Number of the layer among those of the plating, from 0.
        layer: usize,
        /// Length on which the layer below is exposed over that of the scar, -.
        fraction: f64,
    },
}
