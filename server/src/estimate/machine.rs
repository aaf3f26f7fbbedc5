//! Calibration of this machine: the speed of the engine, measured once by a few small solves and cached in a file,
//! which converts a workload to processor seconds.
//!
//! Knows the engine and workloads; does not know HTTP, SQL or the terminal.

mod cache;
mod calibration;
mod coefficients;

use api::plan::MachineFigures;

use crate::estimate::workload::Workload;
use coefficients::{NODES, condensation_terms};

pub use cache::{CalibrationCache, cache_file};
pub use calibration::measure;
pub use coefficients::MachineError;

/// Start of the process, meshes and documents, s.
const BASE_S: f64 = 0.01;

/// Processor time of an iteration of an area contact and a cell over that of an increment with 30 solved nodes. Measured.
const CELL_INCREMENTS: f64 = 1.6e-3;

/// Processor seconds of a workload on a machine.
pub fn cpu_s(machine: &MachineFigures, workload: &Workload) -> f64 {
    let increments = workload.increments.iter().map(|(nodes, count)| {
        count * machine.increment_s * (nodes / NODES).powf(machine.increment_power)
    });
    let bodies = workload.condensations.iter().chain(&workload.interiors);
    let condensations = bodies.map(|body| {
        let [dofs, surface] = condensation_terms(body);
        machine.condensation_dof_s * dofs + machine.condensation_surface_s * surface
    });
    let area = workload.cell_iterations * CELL_INCREMENTS * machine.increment_s;
    let companions = workload.companions.iter();
    let companions = companions.map(|companion| cpu_s(machine, companion) - BASE_S);
    BASE_S + area + increments.sum::<f64>() + condensations.sum::<f64>() + companions.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::coefficients::checked;
    use super::*;
    use crate::estimate::workload::{Condensations, LeftOut};

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
            interiors: [Condensations { count: 0.0, ..body }; 2],
            cell_iterations: 0.0,
            cells: (0.0, 0.0),
            held_numbers: 0.0,
            stations: 1,
            planes: 1,
            left_out: LeftOut::Little,
            companions: Vec::new(),
        };
        // 0.1 s and 0.2 s of increments, 2 x (0.1 + 1) s of condensations.
        let seconds = cpu_s(&machine, &workload);
        assert!((seconds - (0.3 + 2.2 + BASE_S)).abs() < 1e-9, "{seconds}");
    }
}
