//! Errors of a run of extruded bodies.

use crate::condensation::OperatorError;
use crate::contact::ContactError;
use crate::mesh::MeshError;

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
    /// The amplitude is outside of its range.
    #[error("magnitude of the amplitude in mm is {0}, must be positive")]
    AmplitudeRange(f64),
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
    /// A motion with turning points inside, or without any.
    #[error("extruded bodies slide to and fro between two turning points")]
    Motion,
    /// Part of the contact may stick through the whole stroke.
    #[error(
        "a part of the contact may stick: amplitude is {amplitude_mm} mm, twice the displacement at which all of it slips is {least_mm:.3e} mm"
    )]
    Sticks {
        /// Amplitude, mm.
        amplitude_mm: f64,
        /// The least one, mm.
        least_mm: f64,
    },
    /// Friction that changes.
    #[error("extruded bodies have one coefficient of friction")]
    FrictionLaw,
    /// The contact leaves the receptacle.
    #[error(
        "amplitude is {amplitude_mm} mm, must be below half of the receptacle's length of {half_block_mm} mm"
    )]
    LeavesReceptacle {
        /// Amplitude, mm.
        amplitude_mm: f64,
        /// Half of the length, mm.
        half_block_mm: f64,
    },
    /// A wear rate that depends on the state.
    #[error("the wear rate of the {side} is not the same in every state")]
    Law {
        /// The body.
        side: &'static str,
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
    /// A contact has no solution.
    #[error("cycle {cycle}: {source}; the increment was halved {halvings} times")]
    Contact {
        /// Cycles done.
        cycle: u64,
        /// Number of halvings.
        halvings: u32,
        /// Why.
        source: ContactError,
    },
    /// A body cannot be meshed.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A body cannot be condensed.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}
