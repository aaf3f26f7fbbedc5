//! Calibration of this machine: the speed of the engine, measured once by a few small solves and cached in a file, which
//! converts a workload to processor seconds.
//!
//! Knows the engine and workloads; does not know HTTP, SQL or the terminal.

mod cache;
mod calibration;

use api::plan::MachineFigures;

use crate::estimate::workload::{Condensations, Workload};

pub use cache::{CalibrationCache, cache_file};

/// Candidate nodes of the increment whose time is part of the calibration.
const NODES: f64 = 30.0;
/// A sparse factorisation of a plane mesh takes between n log n and n^1.5 (George 1973). Measured from 2 500 to 57 000
/// unknowns.
const DOF_POWER: f64 = 1.2;
/// The dense block of the surface nodes is factored and inverted.
const SURFACE_POWER: i32 = 3;
/// Start of the process, meshes and documents, s.
const BASE_S: f64 = 0.01;

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
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}

/// Measures this machine.
///
/// # Errors
/// [`MachineError`] if a solve fails.
pub fn measure() -> Result<MachineFigures, MachineError> {
    calibration::calibrate(cache::program())
}

/// Checks that all coefficients are finite and positive; one of the two of a condensation may be too small to measure.
fn checked(figures: MachineFigures) -> Result<MachineFigures, MachineError> {
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

/// Processor seconds of a workload on a machine.
pub fn cpu_s(machine: &MachineFigures, workload: &Workload) -> f64 {
    let increments = workload.increments.iter().map(|(candidates, count)| {
        count * machine.increment_s * (candidates / NODES).powf(machine.increment_power)
    });
    let condensations = workload.condensations.iter().map(|body| {
        let [dofs, surface] = condensation_terms(body);
        machine.condensation_dof_s * dofs + machine.condensation_surface_s * surface
    });
    BASE_S + increments.sum::<f64>() + condensations.sum::<f64>()
}

/// The two terms of the time of condensations, without their coefficients.
fn condensation_terms(body: &Condensations) -> [f64; 2] {
    [
        body.count * body.dofs.powf(DOF_POWER),
        body.count * body.surface_nodes.powi(SURFACE_POWER),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_coefficients_are_refused() {
        let with = |increment_s, condensation_dof_s, condensation_surface_s| {
            checked(MachineFigures {
                program: "test".to_owned(),
                increment_s,
                increment_power: 2.0,
                condensation_dof_s,
                condensation_surface_s,
            })
        };
        assert!(with(1e-4, 1e-7, 0.0).is_ok());
        for (increment_s, dof_s, surface_s) in [
            (0.0, 1e-7, 1e-9),
            (f64::NAN, 1e-7, 1e-9),
            (f64::INFINITY, 1e-7, 1e-9),
            (1e-4, 0.0, 0.0),
            (1e-4, -1e-7, 1e-9),
            (1e-4, 1e-7, f64::NAN),
        ] {
            let refused = with(increment_s, dof_s, surface_s);
            assert!(
                matches!(refused, Err(MachineError::Coefficient { .. })),
                "{refused:?}"
            );
        }
    }

    #[test]
    fn seconds_are_proportional_to_the_workload() {
        let machine = MachineFigures {
            program: "test".to_owned(),
            increment_s: 1e-3,
            increment_power: 2.0,
            condensation_dof_s: 1e-7,
            condensation_surface_s: 1e-9,
        };
        let body = Condensations {
            count: 2.0,
            dofs: 1e5,
            surface_nodes: 1e3,
        };
        let workload = Workload {
            computed_cycles: 1.0,
            most_increments: 1,
            increments: vec![(30.0, 100.0), (60.0, 50.0)],
            condensations: [body, Condensations { count: 0.0, ..body }],
        };
        // 0.1 s and 0.2 s of increments, 2 x (0.1 + 1) s of condensations.
        let seconds = cpu_s(&machine, &workload);
        assert!((seconds - (0.3 + 2.2 + BASE_S)).abs() < 1e-9, "{seconds}");
    }
}
