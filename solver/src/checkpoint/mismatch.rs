//! Mismatch between a checkpoint and a scene.

/// Mismatch between a checkpoint and a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointMismatch {
    /// The scene has another mesh.
    #[error("it has {found} values for the {nodes} contact nodes of the {body}")]
    Nodes {
        /// Which body.
        body: &'static str,
        /// Values in the checkpoint.
        found: usize,
        /// Nodes of the scene.
        nodes: usize,
    },
    /// The scene has another number of sections along its line.
    #[error("it has {found} sections along the line of {stations}")]
    Stations {
        /// Sections in the checkpoint.
        found: usize,
        /// Sections of the scene.
        stations: usize,
    },
    /// The scene has another dimension.
    #[error("it is of a contact of another dimension")]
    Dimension,
    /// The scene ends before it.
    #[error("it is at cycle {cycle} of {cycles}")]
    Beyond {
        /// Cycle of the checkpoint.
        cycle: u64,
        /// Cycles of the scene.
        cycles: u64,
    },
}
