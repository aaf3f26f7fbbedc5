//! Errors that all runs of sections along a line have in common.

use crate::condensation::OperatorError;
use crate::contact::ContactError;
use crate::mesh::MeshError;

/// Why sections along a line cannot be simulated, or their contact has no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SectionsError {
    /// The amplitude is outside of its range.
    #[error("magnitude of the amplitude in mm is {0}, must be positive")]
    AmplitudeRange(f64),
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
    /// A motion with turning points inside, or without any.
    #[error("sections along a line slide to and fro between two turning points")]
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
    /// A wear rate that depends on the state.
    #[error("the wear rate of the {side} is not the same in every state")]
    Law {
        /// The body.
        side: &'static str,
    },
    /// The contacts of all sections together have no solution.
    #[error("cycle {cycle}: {source}; the increment was halved {halvings} times")]
    Contact {
        /// Cycles done.
        cycle: u64,
        /// Number of halvings.
        halvings: u32,
        /// Why.
        source: ContactError,
    },
    /// The contact of a section has no solution.
    #[error(
        "cycle {cycle}, station {station}: {source}; the increment was halved {halvings} times"
    )]
    Station {
        /// Cycles done.
        cycle: u64,
        /// Number of the section.
        station: usize,
        /// Number of halvings.
        halvings: u32,
        /// Why.
        source: ContactError,
    },
    /// A section cannot be meshed.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A section cannot be condensed.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}
