//! What this machine takes for the engine's work: measured once by a few small solves, kept in a file, and used to tell
//! processor seconds from counted work.
//!
//! Knows the engine and the counted work; does not know HTTP, SQL or the terminal.

mod cache;
mod calibration;

use api::plan::{MachineFigures, Plan};

use crate::estimate::workload::{Condensations, Workload};
use crate::spec::Resolved;

pub use cache::{CalibrationCache, cache_file};

/// Watched nodes of the increment whose time is told.
const NODES: f64 = 30.0;
/// A sparse factorisation of a plane mesh takes between n log n and n^1.5 (George 1973). Measured from 2 500 to 57 000
/// unknowns.
const DOF_POWER: f64 = 1.2;
/// The dense block of the surface is factored and inverted.
const SURFACE_POWER: i32 = 3;
/// Start of the process, meshes and documents, s.
const BASE_S: f64 = 0.01;

/// Why a machine could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum MachineError {
    /// One of the small solves failed.
    #[error("a small solve of the calibration: {0}")]
    Solve(#[from] solver::SolveError),
    /// One of its specifications was refused.
    #[error("a specification of the calibration: {0}")]
    Refused(#[from] crate::spec::Refused),
    /// The example that is solved has changed.
    #[error("the example of the calibration has no {0}")]
    Example(&'static str),
    /// A figure that no machine has.
    #[error("{name} of the machine is {value}; it must be finite and positive")]
    Figure {
        /// Which one.
        name: &'static str,
        /// What it came to.
        value: f64,
    },
}

/// Measures this machine now.
///
/// # Errors
/// [`MachineError`] if one of the small solves fails.
pub fn measure() -> Result<MachineFigures, MachineError> {
    calibration::calibrate(cache::program())
}

/// Figures that a machine can have. One of the two parts of a condensation may be too small to show.
fn checked(figures: MachineFigures) -> Result<MachineFigures, MachineError> {
    let [dofs, surface] = [figures.condensation_dof_s, figures.condensation_surface_s];
    // Each with whether it may be nothing.
    let told = [
        ("increment_s", figures.increment_s, false),
        ("increment_power", figures.increment_power, false),
        ("condensation_dof_s", dofs, surface > 0.0),
        ("condensation_surface_s", surface, dofs > 0.0),
    ];
    let mut wrong = told.into_iter().filter(|(_, value, nothing)| {
        let possible = *value > 0.0 || (*nothing && *value >= 0.0);
        !(possible && value.is_finite())
    });
    match wrong.next() {
        Some((name, value, _)) => Err(MachineError::Figure { name, value }),
        None => Ok(figures),
    }
}

/// Processor seconds that a machine takes for some work.
pub fn cpu_s(machine: &MachineFigures, work: &Workload) -> f64 {
    let increments = work.increments.iter().map(|(watched, many)| {
        many * machine.increment_s * (watched / NODES).powf(machine.increment_power)
    });
    let condensations = work.condensations.iter().map(|body| {
        let [dofs, surface] = parts(body);
        machine.condensation_dof_s * dofs + machine.condensation_surface_s * surface
    });
    BASE_S + increments.sum::<f64>() + condensations.sum::<f64>()
}

/// What the time of condensations is made of.
fn parts(body: &Condensations) -> [f64; 2] {
    [
        body.count * body.dofs.powf(DOF_POWER),
        body.count * body.surface_nodes.powi(SURFACE_POWER),
    ]
}

/// The plan of a specification, with its time on a machine.
pub fn plan(resolved: &Resolved, machine: Option<&MachineFigures>) -> Plan {
    let mut plan = crate::estimate::plan(resolved);
    if let Some(machine) = machine {
        let seconds = cpu_s(machine, &resolved.workload);
        plan.estimates.insert("cpu_s".to_owned(), seconds);
    }
    plan
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_no_machine_has_are_refused() {
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
                matches!(refused, Err(MachineError::Figure { .. })),
                "{refused:?}"
            );
        }
    }

    #[test]
    fn seconds_follow_the_work() {
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
        let work = Workload {
            computed_cycles: 1.0,
            most_increments: 1,
            increments: vec![(30.0, 100.0), (60.0, 50.0)],
            condensations: [body, Condensations { count: 0.0, ..body }],
        };
        // 0.1 s and 0.2 s of increments, 2 x (0.1 + 1) s of condensations.
        let seconds = cpu_s(&machine, &work);
        assert!((seconds - (0.3 + 2.2 + BASE_S)).abs() < 1e-9, "{seconds}");
    }
}
