//! Which runs a study is made of: chosen before anything is solved, from what each is expected to take.

use api::plan::MachineFigures;
use api::spec::{Accuracy, CycleJump, Overrides, Spec};
use serde::{Deserialize, Serialize};

use crate::batch::accuracy::grid::{Base, Grid, Settings};
use crate::estimate::{Estimate, machine};
use crate::spec;
use crate::spec::{Refused, Resolved};

/// Tolerances of a study, loose to tight.
const TOLERANCES: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.003];
/// Part of the budget that the tolerances may take.
const TOLERANCE_SHARE: f64 = 0.4;
/// Part of the budget that all runs are expected to take: expectations hold within a factor of two.
const EXPECTED_SHARE: f64 = 0.7;
/// The tolerance of a run whose settings are fixed, for the parts of the mesh that are not.
const TOLERANCE: f64 = 0.02;

/// Whether a run may be made where it is to be made.
pub type Accept<'a> = dyn Fn(&Estimate) -> Result<(), Refused> + 'a;

/// Why there are no runs.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunPlanError {
    /// Each is refused; the first of them for this reason.
    #[error("a run of the study: {0}")]
    Refused(#[from] Refused),
    /// None fits.
    #[error(
        "the cheapest run is expected to take {least_s:.1} s; all together may be expected to take {:.1} s of a budget of {budget_s} s",
        EXPECTED_SHARE * budget_s
    )]
    TooExpensive {
        /// The budget.
        budget_s: f64,
        /// What the cheapest run is expected to take.
        least_s: f64,
    },
}

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
    /// Its estimate.
    pub estimate: Estimate,
    /// Processor seconds that it is expected to take.
    pub expected_s: f64,
}

/// The runs of a study, in the order in which they are to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPlan {
    /// The grid among them.
    pub grid: Grid,
    /// All runs: tolerances, then the grid, coarsest first.
    pub runs: Vec<Wanted>,
    /// What does not fit into the budget, in words.
    pub left_out: Vec<String>,
}

impl RunPlan {
    /// The runs that are expected to fit into a budget of processor seconds, and that `accept` takes.
    ///
    /// # Errors
    /// [`RunPlanError`] if not even a coarse run can be meshed, is accepted and fits.
    pub fn within(
        scene: &Resolved,
        machine: &MachineFigures,
        budget_s: f64,
        accept: &Accept<'_>,
    ) -> Result<Self, RunPlanError> {
        let want = |asked: Asked| -> Result<Wanted, Refused> {
            let resolved = spec::resolve(&child(&scene.spec, asked)).map_err(Refused::Faults)?;
            let estimate = Estimate::of(&resolved);
            accept(&estimate)?;
            let expected_s = machine::cpu_s(machine, &estimate.workload);
            Ok(Wanted {
                asked,
                resolved,
                estimate,
                expected_s,
            })
        };
        let mut chosen = Chosen::default();
        for tolerance in TOLERANCES {
            let most_s = TOLERANCE_SHARE * EXPECTED_SHARE * budget_s;
            let asked = Asked::Tolerance(tolerance);
            chosen.weigh(asked, want(asked), most_s);
        }
        let most_s = EXPECTED_SHARE * budget_s;
        let estimate = Estimate::of(scene);
        let base = Base::of(
            scene,
            &estimate,
            machine::cpu_s(machine, &estimate.workload),
        );
        let pilot = base.pilot();
        let factor = want(Asked::Fixed(pilot))
            .map_or(1.0, |pilot_run| pilot_run.expected_s / base.cost_s(pilot));
        let grid = Grid::within(&base, factor, most_s - chosen.spent_s, &|settings| {
            want(Asked::Fixed(settings)).is_ok()
        });
        for settings in grid.coarsest_first() {
            let asked = Asked::Fixed(settings);
            chosen.weigh(asked, want(asked), most_s);
        }
        let Chosen { runs, left_out, .. } = chosen.unless_empty(budget_s)?;
        Ok(Self {
            grid,
            runs,
            left_out,
        })
    }
}

/// The runs that were chosen so far.
#[derive(Default)]
struct Chosen {
    runs: Vec<Wanted>,
    left_out: Vec<String>,
    spent_s: f64,
    /// The least that a run which did not fit is expected to take.
    least_s: Option<f64>,
    refused: Option<Refused>,
}

impl Chosen {
    /// Takes a run if it can be made and fits, all together, into so many seconds.
    fn weigh(&mut self, asked: Asked, run: Result<Wanted, Refused>, most_s: f64) {
        match run {
            Ok(run) if self.spent_s + run.expected_s <= most_s => {
                self.spent_s += run.expected_s;
                self.runs.push(run);
            }
            Ok(run) => {
                let least_s = self.least_s.unwrap_or(f64::INFINITY);
                self.least_s = Some(least_s.min(run.expected_s));
                let line = format!("{asked}: about {:.0} s", run.expected_s);
                self.left_out.push(line);
            }
            Err(refused) => {
                self.left_out.push(format!("{asked}: {}", reason(&refused)));
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// A study without a run is none: the cheapest is too dear, or all are refused.
    fn unless_empty(self, budget_s: f64) -> Result<Self, RunPlanError> {
        match (self.least_s, self.refused) {
            _ if !self.runs.is_empty() => Ok(Self {
                refused: None,
                ..self
            }),
            (Some(least_s), _) => Err(RunPlanError::TooExpensive { budget_s, least_s }),
            (None, refused) => Err(refused.unwrap_or(Refused::Faults(Vec::new())).into()),
        }
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
    use api::problem::Fault;

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

    fn programme(budget_s: f64) -> RunPlan {
        let text = br#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#;
        let scene = spec::read(text).expect("accepted");
        RunPlan::within(&scene, &machine(), budget_s, &|_| Ok(())).expect("it can be studied")
    }

    #[test]
    fn runs_are_expected_to_fit_and_a_larger_budget_makes_more_and_finer_ones() {
        let (small, large) = (programme(8.0), programme(80.0));
        assert!(expected_s(&small) <= 8.0 && expected_s(&large) <= 80.0);
        assert!(large.runs.len() >= small.runs.len());
        assert!(large.left_out.len() <= small.left_out.len());
        let finest = |programme: &RunPlan| programme.grid.levels(0, 0, 0).contact_element_mm;
        assert!(finest(&large) <= finest(&small));
    }

    fn expected_s(programme: &RunPlan) -> f64 {
        programme.runs.iter().map(|run| run.expected_s).sum()
    }

    #[test]
    fn a_grid_that_does_not_fit_even_at_its_coarsest_loses_runs() {
        let text = br#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#;
        let scene = spec::read(text).expect("accepted");
        let within = |budget_s| RunPlan::within(&scene, &machine(), budget_s, &|_| Ok(()));
        let programme = within(100.0).expect("some runs fit");
        assert!(
            expected_s(&programme) <= 100.0,
            "{}",
            expected_s(&programme)
        );
        assert!(programme.left_out.len() > 9, "{:?}", programme.left_out);
        let none = within(0.01).map(|programme| programme.runs.len());
        assert!(matches!(none, Err(RunPlanError::TooExpensive { least_s, .. }) if least_s > 0.01));
    }

    #[test]
    fn the_finest_run_of_a_grid_is_one_that_is_accepted() {
        let text = br#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#;
        let scene = spec::read(text).expect("accepted");
        let most = 1.5 * Estimate::of(&scene).footprint.dofs;
        let accept = |run: &Estimate| {
            let fault = || Fault::new("/accuracy", format!("{} unknowns", run.footprint.dofs));
            let small = run.footprint.dofs <= most;
            small
                .then_some(())
                .ok_or_else(|| Refused::Faults(vec![fault()]))
        };
        let programme = RunPlan::within(&scene, &machine(), 8e4, &accept).expect("some runs");
        let finest = Asked::Fixed(programme.grid.levels(0, 0, 0));
        assert!(programme.runs.iter().any(|run| run.asked == finest));
        assert!(
            programme
                .runs
                .iter()
                .all(|run| run.estimate.footprint.dofs <= most)
        );
        let told = |line: &String| line.starts_with("tolerance") && line.ends_with("unknowns");
        assert!(
            programme.left_out.iter().any(told),
            "{:?}",
            programme.left_out
        );
        let refused = RunPlan::within(&scene, &machine(), 8e4, &|_| {
            Err(Refused::Faults(vec![Fault::new("/output", "too much")]))
        });
        assert!(matches!(refused, Err(RunPlanError::Refused(_))));
    }

    #[test]
    fn a_grid_that_could_be_paid_but_not_meshed_is_coarser() {
        let text = br#"{"system":{"kind":"fuzz_button"},"accuracy":{"preset":"fine"}}"#;
        let scene = spec::read(text).expect("accepted");
        let programme =
            RunPlan::within(&scene, &machine(), 86_400.0, &|_| Ok(())).expect("some runs");
        let finest = Asked::Fixed(programme.grid.levels(0, 0, 0));
        assert!(programme.runs.iter().any(|run| run.asked == finest));
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
