//! Errors of a run of stations.

use crate::along_line::SectionsError;

/// Why a run failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StationError {
    /// The force is outside of its range.
    #[error("normal force in N is {0}, must be positive")]
    ForceRange(f64),
    /// The length of the line is outside of its range.
    #[error("length of the line in mm is {0}, must be positive")]
    LengthRange(f64),
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
    /// A rigid top that is no rigid handle of each section.
    #[error("under a rigid top the sections are driven by their rigid top face")]
    Drive,
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
    /// A fault of the sections.
    #[error(transparent)]
    Sections(#[from] SectionsError),
}
