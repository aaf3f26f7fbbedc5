//! Which runs a study is made of: chosen before anything is solved, from what each is expected to take.

use api::plan::MachineFigures;
use api::spec::{Accuracy, CycleJump, Overrides, Spec};
use serde::{Deserialize, Serialize};

use super::grid::{Base, Grid, Settings};
use crate::machine;
use crate::translate::{self, Refused, Resolved};

/// Tolerances of a study, loose to tight.
const TOLERANCES: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.003];
/// Part of the budget that the tolerances may take.
const TOLERANCE_SHARE: f64 = 0.4;
/// Part of the budget that all runs are expected to take: expectations hold within a factor of two.
const EXPECTED_SHARE: f64 = 0.7;
/// The tolerance of a run whose settings are fixed, for the parts of the mesh that are not.
const TOLERANCE: f64 = 0.02;

/// What one run asks for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Asked {
    /// A tolerance.
    Tolerance(f64),
    /// Fixed settings.
    Fixed(Settings),
}

impl Asked {
    /// What a specification of a study's run asks for.
    pub fn of(accuracy: &Accuracy) -> Option<Self> {
        match &accuracy.overrides {
            None => accuracy.tolerance.map(Self::Tolerance),
            Some(overrides) => Settings::of(overrides).map(Self::Fixed),
        }
    }

    /// As a specification asks for it.
    pub fn accuracy(self) -> Accuracy {
        match self {
            Self::Tolerance(tolerance) => Accuracy {
                tolerance: Some(tolerance),
                ..Accuracy::default()
            },
            Self::Fixed(settings) => Accuracy {
                preset: None,
                tolerance: Some(TOLERANCE),
                overrides: Some(Overrides {
                    contact_element_mm: Some(settings.contact_element_mm),
                    increments_per_cycle: Some(settings.increments_per_cycle),
                    cycle_jump: Some(CycleJump::Fixed(settings.jump())),
                }),
            },
        }
    }
}

impl std::fmt::Display for Asked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Tolerance(tolerance) => write!(f, "tolerance {tolerance}"),
            Self::Fixed(settings) => settings.fmt(f),
        }
    }
}

/// A run that is to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// What it asks for.
    pub asked: Asked,
    /// Its specification.
    pub resolved: Resolved,
    /// Processor seconds that it is expected to take.
    pub expected_s: f64,
}

/// The runs of a study, in the order in which they are to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Programme {
    /// The grid among them.
    pub grid: Grid,
    /// All runs: tolerances, then the grid, coarsest first.
    pub runs: Vec<Wanted>,
    /// What does not fit into the budget, in words.
    pub left_out: Vec<String>,
}

impl Programme {
    /// The runs that are expected to fit into a budget of processor seconds.
    ///
    /// # Errors
    /// [`Refused`] if not even a coarse run can be meshed.
    pub fn within(
        scene: &Resolved,
        machine: &MachineFigures,
        budget_s: f64,
    ) -> Result<Self, Refused> {
        let want = |asked: Asked| -> Result<Wanted, Refused> {
            let resolved = translate::scene(&child(&scene.spec, asked)).map_err(Refused::Faults)?;
            let expected_s = machine::cpu_s(machine, &resolved.work);
            Ok(Wanted {
                asked,
                resolved,
                expected_s,
            })
        };
        let (mut runs, mut left_out, mut spent) = (Vec::new(), Vec::new(), 0.0);
        for tolerance in TOLERANCES {
            let asked = Asked::Tolerance(tolerance);
            let run = match want(asked) {
                Ok(run) => run,
                Err(refused) => {
                    left_out.push(format!("{asked}: {}", reason(&refused)));
                    continue;
                }
            };
            if spent + run.expected_s <= TOLERANCE_SHARE * EXPECTED_SHARE * budget_s {
                spent += run.expected_s;
                runs.push(run);
            } else {
                left_out.push(format!("{}: about {:.0} s", run.asked, run.expected_s));
            }
        }
        let base = Base::of(scene, machine::cpu_s(machine, &scene.work));
        let pilot = base.pilot();
        let factor = want(Asked::Fixed(pilot))?.expected_s / base.cost_s(pilot);
        let grid = Grid::within(&base, factor, EXPECTED_SHARE * budget_s - spent);
        for settings in grid.coarsest_first() {
            let asked = Asked::Fixed(settings);
            match want(asked) {
                Ok(run) => runs.push(run),
                Err(refused) => left_out.push(format!("{asked}: {}", reason(&refused))),
            }
        }
        Ok(Self {
            grid,
            runs,
            left_out,
        })
    }
}

/// Why a run cannot be made: its first fault.
fn reason(refused: &Refused) -> String {
    match refused {
        Refused::Faults(faults) if !faults.is_empty() => faults[0].detail.clone(),
        other => other.to_string(),
    }
}

/// The specification of a run.
fn child(spec: &Spec, asked: Asked) -> Spec {
    let mut spec = Spec {
        accuracy: asked.accuracy(),
        ..spec.clone()
    };
    // The end is a snapshot of its own accord; any other would cut jumps short.
    spec.output.fields = Some(false);
    spec.output.snapshots_at_distance_mm = None;
    spec.output.snapshots_at_cycles = spec.cycles.map(|cycles| vec![cycles]);
    spec
}

#[cfg(test)]
mod tests {
    use super::*;

    fn machine() -> MachineFigures {
        MachineFigures {
            program: "test".to_owned(),
            increment_s: 2e-4,
            increment_power: 1.7,
            condensation_dof_s: 4e-7,
            condensation_surface_s: 7e-10,
        }
    }

    fn programme(budget_s: f64) -> Programme {
        let text = br#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#;
        let scene = translate::read(text).expect("accepted");
        Programme::within(&scene, &machine(), budget_s).expect("it can be studied")
    }

    #[test]
    fn runs_are_expected_to_fit_and_a_larger_budget_makes_more_and_finer_ones() {
        let expected = |programme: &Programme| -> f64 {
            programme.runs.iter().map(|run| run.expected_s).sum()
        };
        let (small, large) = (programme(8.0), programme(80.0));
        assert!(expected(&small) <= 8.0 && expected(&large) <= 80.0);
        assert!(large.runs.len() >= small.runs.len());
        assert!(large.left_out.len() <= small.left_out.len());
        let finest = |programme: &Programme| programme.grid.levels(0, 0, 0).contact_element_mm;
        assert!(finest(&large) <= finest(&small));
    }

    #[test]
    fn runs_differ_in_their_accuracy_alone() {
        let programme = programme(8.0);
        for run in &programme.runs {
            let spec = &run.resolved.spec;
            assert_eq!((spec.cycles, spec.output.fields), (Some(300), Some(false)));
            assert_eq!(spec.output.snapshots_at_cycles.as_deref(), Some(&[300][..]));
            match run.asked {
                Asked::Tolerance(tolerance) => assert_eq!(spec.accuracy.tolerance, Some(tolerance)),
                Asked::Fixed(settings) => {
                    let overrides = spec.accuracy.overrides.as_ref().expect("overrides");
                    let element = overrides.contact_element_mm;
                    assert_eq!(element, Some(settings.contact_element_mm));
                }
            }
        }
    }
}
