//! The measurement: small solves in gross reciprocating sliding, in a contact that stays in its scar, and in one that
//! climbs the ends of its groove, on coarse and fine meshes. A power law is fitted to the times of their increments,
//! and the coefficients of two terms to the times of their condensations.

use std::ops::ControlFlow;

use api::plan::MachineFigures;
use solver::observer::{Event, Observer, Phase};

use crate::estimate::Estimate;
use crate::estimate::machine::coefficients::{MachineError, NODES, checked, condensation_terms};
use crate::estimate::workload::Workload;
use crate::number::real;
use crate::program;
use crate::solve::thread_cpu_s;
use crate::spec;

/// A pad that wears below an unworn contact.
const BARE_PAD: &str = r#""plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k":0.004,"hardness_mpa":1700}}}"#;
/// The surfaces of the fuzz button of the source.
const BARE_WIRE: &str = r#""plating":{"slider":[],"receptacle":[]},"materials":{"slider":"copper","receptacle":"copper"},"interface":{
    "friction":{"law":"coulomb","coefficient":1.21},
    "wear":{"slider":null,"receptacle":{"law":"archard","k":0.011,"hardness_mpa":427}}}"#;
const MCCOLL: &str = include_str!("../../../examples/mccoll.json");

/// Plausible powers of the number of solved nodes: from a column per node to the factorization of a dense matrix.
const POWERS: (f64, f64) = (1.0, 3.0);

/// Measurement of one small solve.
struct Sample {
    workload: Workload,
    increment_s: f64,
    condensation_s: f64,
}

/// Measures this machine.
///
/// # Errors
/// [`MachineError`] if a solve fails or a coefficient is impossible.
pub fn measure() -> Result<MachineFigures, MachineError> {
    let specifications = specifications()?;
    let samples: Result<Vec<Sample>, _> = specifications.iter().map(|text| solve(text)).collect();
    let samples = samples?;
    let (increment_s, increment_power) = power_law(&samples);
    let [condensation_dof_s, condensation_surface_s] = two_terms(&samples);
    checked(MachineFigures {
        program: program(),
        increment_s,
        increment_power,
        condensation_dof_s,
        condensation_surface_s,
    })
}

/// Few cycles on fine meshes, more on coarse ones: each takes a fraction of a second.
fn specifications() -> Result<[String; 5], MachineError> {
    const PRESET: &str = r#"{"preset": "standard"}"#;
    if !MCCOLL.contains(PRESET) {
        return Err(MachineError::Example(PRESET));
    }
    let system = |kind: &str, surfaces: &str, rest: &str| {
        format!(r#"{{"system":{{"kind":"{kind}"}},{surfaces},{rest}}}"#)
    };
    let mccoll = |accuracy: &str| MCCOLL.replace(PRESET, accuracy);
    Ok([
        mccoll(r#"{"preset": "draft"}"#),
        mccoll(r#"{"tolerance": 0.01, "overrides": {"cycle_jump": 1800}}"#),
        system("sd_card", BARE_PAD, r#""accuracy":{"preset":"draft"}"#),
        system(
            "dimm",
            BARE_PAD,
            r#""accuracy":{"tolerance":0.01},"cycles":8"#,
        ),
        system(
            "fuzz_button",
            BARE_WIRE,
            r#""accuracy":{"preset":"draft","overrides":{"cycle_jump":20}},"cycles":200"#,
        ),
    ])
}

fn solve(specification: &str) -> Result<Sample, MachineError> {
    let resolved = spec::read(specification.as_bytes())?;
    let mut clock = PhaseClock::default();
    let summary = solver::run::solve(&resolved.scene, &mut clock)?;
    clock.enter(None);
    let increments = u32::try_from(summary.resolution.work.increments.max(1)).unwrap_or(u32::MAX);
    Ok(Sample {
        workload: Estimate::of(&resolved).workload,
        increment_s: clock.increments_s / f64::from(increments),
        condensation_s: clock.condensation_s,
    })
}

/// Processor seconds by phase, of this thread alone.
#[derive(Default)]
struct PhaseClock {
    current: Option<(Phase, f64)>,
    increments_s: f64,
    condensation_s: f64,
}

impl PhaseClock {
    fn enter(&mut self, phase: Option<Phase>) {
        let now = thread_cpu_s();
        match self.current {
            Some((Phase::Cycles, since)) => self.increments_s += now - since,
            Some((Phase::Condense, since)) => self.condensation_s += now - since,
            _ => {}
        }
        self.current = phase.map(|phase| (phase, now));
    }
}

impl Observer for PhaseClock {
    fn on(&mut self, _: Event<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn on_phase(&mut self, phase: Phase) {
        self.enter(Some(phase));
    }
}

/// Time of an increment with `NODES` solved nodes, and its power: least squares of the logarithms.
fn power_law(samples: &[Sample]) -> (f64, f64) {
    let points: Vec<[f64; 2]> = samples
        .iter()
        .map(|sample| {
            let squares = sample.workload.increments.iter();
            let squares: f64 = squares.map(|(nodes, count)| count * nodes.powi(2)).sum();
            let nodes = (squares / sample.workload.increments()).sqrt();
            [(nodes / NODES).ln(), sample.increment_s.ln()]
        })
        .collect();
    let mean =
        [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / real(points.len()));
    let (mut product, mut square) = (0.0, 0.0);
    for point in &points {
        product += (point[0] - mean[0]) * (point[1] - mean[1]);
        square += (point[0] - mean[0]).powi(2);
    }
    let power = (product / square.max(f64::MIN_POSITIVE)).clamp(POWERS.0, POWERS.1);
    ((mean[1] - power * mean[0]).exp(), power)
}

/// Coefficients of `condensation_terms`: least squares of the relative errors, neither coefficient negative.
fn two_terms(samples: &[Sample]) -> [f64; 2] {
    let (mut a, mut b) = ([[0.0; 2]; 2], [0.0; 2]);
    for sample in samples {
        let bodies = sample
            .workload
            .condensations
            .map(|body| condensation_terms(&body));
        let row = [0, 1].map(|k| (bodies[0][k] + bodies[1][k]) / sample.condensation_s);
        for i in 0..2 {
            b[i] += row[i];
            for j in 0..2 {
                a[i][j] += row[i] * row[j];
            }
        }
    }
    let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    let solved = [
        (b[0] * a[1][1] - b[1] * a[0][1]) / determinant,
        (b[1] * a[0][0] - b[0] * a[1][0]) / determinant,
    ];
    if solved[0] < 0.0 {
        [0.0, b[1] / a[1][1]]
    } else if solved[1] < 0.0 {
        [b[0] / a[0][0], 0.0]
    } else {
        solved
    }
}

/// Identifies this build of the program: version and build time.
pub(crate) fn program() -> String {
    let built = || {
        let modified = program::own().metadata().ok()?.modified().ok()?;
        let since = modified.duration_since(std::time::UNIX_EPOCH).ok()?;
        Some(since.as_secs())
    };
    format!(
        "{} {}",
        env!("CARGO_PKG_VERSION"),
        built().unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::workload::{Condensations, LeftOut};

    fn sample(nodes: f64, increment_s: f64, dofs: f64, surface_nodes: f64) -> Sample {
        let body = Condensations {
            count: 1.0,
            dofs,
            surface_nodes,
        };
        let [small, large] = condensation_terms(&body);
        Sample {
            workload: Workload {
                computed_cycles: 1.0,
                most_increments: 1,
                increments: vec![(nodes, 7.0)],
                condensations: [body, Condensations { count: 0.0, ..body }],
                interiors: [Condensations { count: 0.0, ..body }; 2],
                cell_iterations: 0.0,
                cells: (0.0, 0.0),
                held_numbers: 0.0,
                stations: 1,
                planes: 1,
                left_out: LeftOut::Little,
                companions: Vec::new(),
            },
            increment_s,
            condensation_s: 3e-7 * small + 5e-10 * large,
        }
    }

    #[test]
    fn fits_recover_the_laws_of_exact_samples() {
        let at = |nodes: f64| 2e-4 * (nodes / NODES).powf(1.7);
        let samples = [
            sample(20.0, at(20.0), 1e4, 100.0),
            sample(50.0, at(50.0), 3e4, 900.0),
            sample(90.0, at(90.0), 5e4, 300.0),
        ];
        let (seconds, power) = power_law(&samples);
        assert!((seconds - 2e-4).abs() < 1e-12 && (power - 1.7).abs() < 1e-9);
        let [small, large] = two_terms(&samples);
        assert!((small / 3e-7 - 1.0).abs() < 1e-6, "{small}");
        assert!((large / 5e-10 - 1.0).abs() < 1e-6, "{large}");
    }
}
