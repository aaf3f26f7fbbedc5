//! Comparison with CalculiX on the same problem: one cycle of frictional sliding without wear, on the same meshes and
//! with the same number of increments, one code after the other on this machine.

use std::path::Path;
use std::process::{Command, Stdio};

use server::export::deck::cycle;
use server::solve::children_cpu_s;
use solver::SolveError;
use solver::cycle::{CycleError, CycleState, Integrator};

use crate::bench::cases::{CYLINDER, scene, set_up};
use crate::bench::{BenchError, measured};

/// Default sizes of the contact elements, um.
pub(super) const ELEMENTS_UM: [f64; 3] = [20.0, 10.0, 5.0];
/// Increments per quarter of a cycle: 32 per cycle.
const QUARTER: u32 = 8;
/// Name of the deck.
const DECK: &str = "cycle";

/// Tolerances of both codes.
pub(super) const TOLERANCES: [&str; 2] = [
    "contact conditions and load balance to 1e-11 of the indentation and to round-off, no penalty",
    "residual force 0.5 % of the mean force (its default), penalty of 5 E over an element, stick slope a tenth of it",
];

/// Results of both codes on the same meshes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comparison {
    /// Contact element, um.
    pub(super) element_um: f64,
    /// Nodes of both bodies.
    pub(super) nodes: usize,
    /// Processor seconds of this program: the set-up, and 40 increments (initial quarter and cycle).
    pub(super) ours_s: [f64; 2],
    /// Processor seconds of the other code for all of it, or why it failed, with the seconds until then.
    pub(super) theirs_s: Result<f64, String>,
    /// Largest |Q| / (mu P) of both codes over the cycle: above 1 only by the slope of the penalty.
    pub(super) friction_use: [f64; 2],
}

/// Runs both codes with one element size, with their files in a folder.
///
/// # Errors
/// [`BenchError`] if this engine fails or the other code cannot be started.
pub(super) fn compare(folder: &Path, element_um: f64) -> Result<Comparison, BenchError> {
    let scene = scene(CYLINDER, |scene| {
        scene.accuracy.contact_element_mm = Some(1e-3 * element_um);
        scene.accuracy.increments_per_cycle = Some(4 * QUARTER);
    })?;
    // mu P, N/mm.
    let limit = scene.friction.unworn() * scene.load_n_per_mm;
    let (setup_s, (model, condensed)) = set_up(&scene)?;
    let operators = &condensed.operators;
    let (cycle_s, (lowered_mm, forces)) = measured(3, || {
        let mut state = CycleState::start(operators, model.interface.slave);
        let mut integrator = Integrator::new(&scene, &model, operators);
        integrator.apply_load(&mut state)?;
        let lowered_mm = -state.contact.height;
        integrator.initial_quarter(&mut state)?;
        // Short of its stop, so that the loop has no points besides the increments.
        let cycle = integrator.compute_cycle(&mut state, 2, true)?;
        Ok((lowered_mm, cycle.friction_loop.tangential_force_n_per_mm))
    })
    .map_err(|error: CycleError| SolveError::from(error))?;

    let deck = cycle::friction_cycle(&scene, &model, lowered_mm, QUARTER);
    std::fs::write(folder.join(format!("{DECK}.inp")), deck)?;
    let before = children_cpu_s();
    let ran = Command::new("ccx")
        .arg(DECK)
        .current_dir(folder)
        .env("OMP_NUM_THREADS", "1")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()?;
    let took_s = children_cpu_s() - before;
    let printed = std::fs::read_to_string(folder.join(format!("{DECK}.dat"))).unwrap_or_default();
    let theirs = total_forces(&printed);
    let largest = |forces: &[f64]| forces.iter().fold(0.0, |m: f64, q| m.max(q.abs())) / limit;
    Ok(Comparison {
        element_um,
        nodes: usize::midpoint(model.bodies.slider.dofs(), model.bodies.receptacle.dofs()),
        ours_s: [setup_s, cycle_s],
        theirs_s: if ran.success() {
            Ok(took_s)
        } else {
            Err(format!("{ran} after {took_s:.0} s"))
        },
        friction_use: [largest(&forces), largest(&theirs)],
    })
}

/// Returns the total force along x of each increment in the output of CalculiX.
fn total_forces(printed: &str) -> Vec<f64> {
    let mut lines = printed.lines();
    let mut forces = Vec::new();
    while let Some(line) = lines.next() {
        if line.contains("total force") {
            let numbers = lines.by_ref().find(|line| !line.trim().is_empty());
            let first = numbers.and_then(|line| line.split_whitespace().next());
            forces.extend(first.and_then(|first| first.parse::<f64>().ok()));
        }
    }
    forces
}

#[test]
fn total_forces_are_read_from_the_output_of_calculix() {
    let printed = "\n total force (fx,fy,fz) for set RECEPTACLE_FAR and time  0.1000000E+00\n\n        \
                   1.475E+02  1.850E+02  3.3E-14\n\n total force (fx,fy,fz) for set RECEPTACLE_FAR and time  \
                   0.2E+00\n\n       -1.0E+00  1.850E+02  3.1E-14\n";
    assert_eq!(total_forces(printed), [147.5, -1.0]);
}

/// |Q| reaches mu P in gross slip, and never passes it; the slope of the penalty rounds it off.
#[test]
#[cfg_attr(not(has_ccx), ignore = "needs the program ccx of CalculiX")]
fn calculix_solves_the_same_cycle() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let compared = compare(folder.path(), 90.0).expect("both codes run");
    let theirs_s = compared.theirs_s.expect("CalculiX finds a solution");
    assert!(theirs_s > compared.ours_s.iter().sum());
    for used in compared.friction_use {
        assert!((0.98..=1.001).contains(&used), "{used}");
    }
}
