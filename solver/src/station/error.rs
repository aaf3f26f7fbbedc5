//! Errors of a run of stations.

use crate::condensation::OperatorError;
use crate::contact::ContactError;
use crate::mesh::MeshError;

/// Why a run failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StationError {
    /// The force is outside of its range.
    #[error("normal force in N is {0}, must be positive")]
    ForceRange(f64),
    /// The length of the line is outside of its range.
    #[error("length of the line in mm is {0}, must be positive")]
    LengthRange(f64),
    /// The amplitude is outside of its range.
    #[error("magnitude of the amplitude in mm is {0}, must be positive")]
    AmplitudeRange(f64),
    /// The ring is displaced by more than its radius.
    #[error(
        "amplitude is {amplitude_mm} mm, must be below the radius of the ring of {radius_mm} mm"
    )]
    Amplitude {
        /// Amplitude, mm.
        amplitude_mm: f64,
        /// The radius, mm.
        radius_mm: f64,
    },
    /// Too few stations.
    #[error("{stations} stations, at least 2 are needed")]
    Stations {
        /// Their number.
        stations: usize,
    },
    /// Too few stations in the unworn contact of a crown or a tilt.
    #[error(
        "{stations} stations, the unworn contact of the crown or the tilt needs at least {least}"
    )]
    Spacing {
        /// Their number.
        stations: usize,
        /// The least one.
        least: usize,
    },
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
    /// The receptacle below a ring that bends reaches over the axis of the ring.
    #[error(
        "the receptacle reaches {half_block_mm} mm to either side of the wire, over the axis of the ring of a radius of {radius_mm} mm"
    )]
    BeyondAxis {
        /// Half of the receptacle's length, mm.
        half_block_mm: f64,
        /// The radius, mm.
        radius_mm: f64,
    },
    /// A motion with turning points inside, or without any.
    #[error("stations slide to and fro between two turning points")]
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
    #[error("stations have one coefficient of friction")]
    FrictionLaw,
    /// A rigid top that is no rigid handle of each section.
    #[error("under a rigid top the sections are driven by their rigid top face")]
    Drive,
    /// A wear rate that depends on the state.
    #[error("the wear rate of the {side} is not the same in every state")]
    Law {
        /// The body.
        side: &'static str,
    },
    /// A contact has no solution.
    #[error(
        "cycle {cycle}, station {station}: {source}; the increment was halved {halvings} times"
    )]
    Contact {
        /// Cycles done.
        cycle: u64,
        /// Number of the station.
        station: usize,
        /// Number of halvings.
        halvings: u32,
        /// Why.
        source: ContactError,
    },
    /// No common height carries the force.
    #[error(
        "cycle {cycle}: the stations carry {found_n} N of {force_n} N after {iterations} iterations for their common height; the increment was halved {halvings} times"
    )]
    Height {
        /// Cycles done.
        cycle: u64,
        /// Force of the last iteration, N.
        found_n: f64,
        /// Normal force, N.
        force_n: f64,
        /// Iterations.
        iterations: usize,
        /// Number of halvings.
        halvings: u32,
    },
    /// A section cannot be meshed.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A section cannot be condensed.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}
