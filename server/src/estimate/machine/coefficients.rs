//! Coefficients of the machine: their terms, and the check of measured values.

use api::plan::MachineFigures;

use crate::estimate::workload::Condensations;

/// Solved nodes of the increment whose time is part of the calibration.
pub(super) const NODES: f64 = 30.0;
/// A sparse factorisation of a plane mesh takes between n log n and n^1.5 (George 1973). Measured from 2 500 to 57 000
/// unknowns.
const DOF_POWER: f64 = 1.2;
/// The dense block of the surface nodes is factored and inverted.
const SURFACE_POWER: i32 = 3;
/// Reason for which a machine could not be calibrated.
#[derive(Debug, thiserror::Error)]
pub enum MachineError {
    /// A solve of the calibration failed.
    #[error("a solve of the calibration failed: {0}")]
    Solve(#[from] solver::SolveError),
    /// A specification of the calibration was refused.
    #[error("a specification of the calibration was refused: {0}")]
    Refused(#[from] crate::spec::Refused),
    /// The example that the calibration solves has changed.
    #[error("the example of the calibration has no {0}")]
    Example(&'static str),
    /// An impossible coefficient.
    #[error("{name} of the machine is {value}; it must be finite and positive")]
    Coefficient {
        /// Name.
        name: &'static str,
        /// Value.
        value: f64,
    },
}

/// Checks that all coefficients are finite and positive; one of the two of a condensation may be too small to measure.
pub(super) fn checked(figures: MachineFigures) -> Result<MachineFigures, MachineError> {
    let [dofs, surface] = [figures.condensation_dof_s, figures.condensation_surface_s];
    // The flag allows 0.
    let coefficients = [
        ("increment_s", figures.increment_s, false),
        ("increment_power", figures.increment_power, false),
        ("condensation_dof_s", dofs, surface > 0.0),
        ("condensation_surface_s", surface, dofs > 0.0),
    ];
    let mut impossible = coefficients.into_iter().filter(|(_, value, zero)| {
        let possible = *value > 0.0 || (*zero && *value >= 0.0);
        !(possible && value.is_finite())
    });
    match impossible.next() {
        Some((name, value, _)) => Err(MachineError::Coefficient { name, value }),
        None => Ok(figures),
    }
}

/// The two terms of the time of condensations, without their coefficients.
pub(super) fn condensation_terms(body: &Condensations) -> [f64; 2] {
    [
        body.count * body.dofs.powf(DOF_POWER),
        body.count * body.surface_nodes.powi(SURFACE_POWER),
    ]
}
