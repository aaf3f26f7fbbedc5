//! Errors of a run of extruded bodies.

use crate::along_line::SectionsError;

/// Why a run failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExtrudedError {
    /// The width is outside of its range.
    #[error("width in mm is {0}, must be positive")]
    WidthRange(f64),
    /// The growth of layers is outside of its range.
    #[error("growth of layers is {0}, must be positive")]
    GrowthRange(f64),
    /// The line load is outside of its range.
    #[error("line load in N/mm is {0}, must be positive")]
    LoadRange(f64),
    /// No node plane would lie in the middle of the width.
    #[error("{layers} layers over the width, must be an even number from 2 to {limit}")]
    Layers {
        /// Their number.
        layers: usize,
        /// The largest one.
        limit: u32,
    },
    /// Layers of too unlike lengths.
    #[error(
        "{layers} layers that grow by {growth} make the longest {ratio:.1e} times as long as the shortest, at most {limit:e} can be solved"
    )]
    UnlikeLayers {
        /// Their number.
        layers: usize,
        /// Length of a layer over that of its neighbour toward the end.
        growth: f64,
        /// Length of the longest over that of the shortest.
        ratio: f64,
        /// The largest ratio.
        limit: f64,
    },
    /// The condensed compliance would be larger than the engine takes.
    #[error(
        "{nodes} contact nodes of all planes in a zone of the {side} are more than the limit of {limit}: fewer layers or coarser elements are needed"
    )]
    TooLarge {
        /// Nodes of all planes.
        nodes: usize,
        /// The body.
        side: &'static str,
        /// The limit.
        limit: usize,
    },
    /// A fault of the sections.
    #[error(transparent)]
    Sections(#[from] SectionsError),
}
