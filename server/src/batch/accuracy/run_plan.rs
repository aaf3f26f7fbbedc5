//! The run plan of a study: its runs, chosen before anything is solved, by their expected time.

use api::plan::MachineFigures;
use api::spec::Spec;

use crate::batch::accuracy::grid::{Baseline, Grid};
use crate::batch::accuracy::run_accuracy::RunAccuracy;
use crate::batch::variation::Accept;
use crate::estimate::{Estimate, machine};
use crate::spec;
use crate::spec::{Refused, Resolved};

/// Budget of all runs of a study together unless another is given, processor seconds.
pub const BUDGET_S: f64 = 180.0;

/// Tolerances of a study, loose to tight.
const TOLERANCES: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.003];
/// Largest share of the budget for the runs at tolerances.
const TOLERANCE_SHARE: f64 = 0.4;
/// Share of the budget that the expected times of all runs may add up to: they are right within a factor of two.
const EXPECTED_SHARE: f64 = 0.7;

/// Why there is no run plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunPlanError {
    /// Every run is refused, the first of them for this reason.
    #[error("a run of the study: {0}")]
    Refused(#[from] Refused),
    /// No run fits into the budget.
    #[error(
        "the cheapest run is expected to take {least_s:.1} s; all together may be expected to take {:.1} s of a budget of {budget_s} s",
        EXPECTED_SHARE * budget_s
    )]
    TooExpensive {
        /// The budget, processor seconds.
        budget_s: f64,
        /// Expected time of the cheapest run, processor seconds.
        least_s: f64,
    },
}

/// A planned run.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// Its accuracy setting.
    pub accuracy: RunAccuracy,
    /// Its specification.
    pub resolved: Resolved,
    /// Its estimate.
    pub estimate: Estimate,
    /// Expected processor seconds.
    pub expected_s: f64,
}

/// The runs of a study, in the order in which they are solved.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPlan {
    /// The grid among the runs.
    pub grid: Grid,
    /// All runs: tolerances, then the grid, coarsest first.
    pub runs: Vec<PlannedRun>,
    /// Runs that do not fit into the budget or are refused, in words.
    pub left_out: Vec<String>,
}

impl RunPlan {
    /// The accepted runs whose expected times fit into a budget of processor seconds.
    ///
    /// # Errors
    /// [`RunPlanError`] if no run can be resolved, is accepted and fits.
    pub fn within(
        scene: &Resolved,
        machine: &MachineFigures,
        budget_s: f64,
        accept: &Accept<'_>,
    ) -> Result<Self, RunPlanError> {
        let planned = |accuracy: RunAccuracy| -> Result<PlannedRun, Refused> {
            let resolved =
                spec::resolve(&run_spec(&scene.spec, accuracy)).map_err(Refused::Faults)?;
            let estimate = Estimate::of(&resolved);
            accept(&estimate)?;
            let expected_s = machine::cpu_s(machine, &estimate.workload);
            Ok(PlannedRun {
                accuracy,
                resolved,
                estimate,
                expected_s,
            })
        };
        let mut chosen = Chosen::default();
        for tolerance in TOLERANCES {
            let most_s = TOLERANCE_SHARE * EXPECTED_SHARE * budget_s;
            let accuracy = RunAccuracy::Tolerance(tolerance);
            chosen.add(accuracy, planned(accuracy), most_s);
        }
        let most_s = EXPECTED_SHARE * budget_s;
        let estimate = Estimate::of(scene);
        let expected_s = machine::cpu_s(machine, &estimate.workload);
        let baseline = Baseline::of(scene, &estimate, expected_s);
        let pilot = baseline.pilot();
        let factor = planned(RunAccuracy::Fixed(pilot)).map_or(1.0, |pilot_run| {
            pilot_run.expected_s / baseline.cost_s(pilot)
        });
        let grid = Grid::within(&baseline, factor, most_s - chosen.spent_s, &|settings| {
            planned(RunAccuracy::Fixed(settings)).is_ok()
        });
        for settings in grid.coarsest_first() {
            let accuracy = RunAccuracy::Fixed(settings);
            chosen.add(accuracy, planned(accuracy), most_s);
        }
        chosen.into_plan(grid, budget_s)
    }
}

/// Runs chosen so far.
#[derive(Default)]
struct Chosen {
    runs: Vec<PlannedRun>,
    left_out: Vec<String>,
    spent_s: f64,
    /// Smallest expected time of a run that did not fit.
    least_s: Option<f64>,
    refused: Option<Refused>,
}

impl Chosen {
    /// Adds a run if it is not refused and all runs together still fit into so many seconds.
    fn add(&mut self, accuracy: RunAccuracy, run: Result<PlannedRun, Refused>, most_s: f64) {
        match run {
            Ok(run) if self.spent_s + run.expected_s <= most_s => {
                self.spent_s += run.expected_s;
                self.runs.push(run);
            }
            Ok(PlannedRun { expected_s, .. }) => {
                let least_s = self.least_s.unwrap_or(f64::INFINITY);
                self.least_s = Some(least_s.min(expected_s));
                let line = format!("{accuracy}: about {expected_s:.0} s");
                self.left_out.push(line);
            }
            Err(refused) => {
                let line = format!("{accuracy}: {}", reason(&refused));
                self.left_out.push(line);
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// Refuses an empty study: the cheapest run is too expensive, or all are refused.
    fn into_plan(self, grid: Grid, budget_s: f64) -> Result<RunPlan, RunPlanError> {
        match (self.least_s, self.refused) {
            _ if !self.runs.is_empty() => Ok(RunPlan {
                grid,
                runs: self.runs,
                left_out: self.left_out,
            }),
            (Some(least_s), _) => Err(RunPlanError::TooExpensive { budget_s, least_s }),
            (None, refused) => Err(refused.unwrap_or(Refused::Faults(Vec::new())).into()),
        }
    }
}

/// Returns the first fault of a refused run.
fn reason(refused: &Refused) -> String {
    match refused {
        Refused::Faults(faults) if !faults.is_empty() => faults[0].detail.clone(),
        other => other.to_string(),
    }
}

/// Returns the specification of a run.
fn run_spec(spec: &Spec, accuracy: RunAccuracy) -> Spec {
    let mut spec = Spec {
        accuracy: accuracy.as_spec(),
        ..spec.clone()
    };
    // The last cycle always has a snapshot; any other snapshot would cut jumps short.
    spec.output.fields = Some(false);
    spec.output.snapshots_at_distance_mm = None;
    let cycles = (!spec::is_continuous(&spec)).then(|| spec::cycles(&spec));
    spec.output.snapshots_at_cycles = cycles.map(|cycles| vec![cycles]);
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

    fn run_plan(budget_s: f64) -> RunPlan {
        let text = br#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#;
        let scene = spec::read(text).expect("accepted");
        RunPlan::within(&scene, &machine(), budget_s, &|_| Ok(())).expect("a run plan")
    }

    #[test]
    fn runs_fit_into_the_budget_and_a_larger_one_makes_more_and_finer_runs() {
        let (small, large) = (run_plan(8.0), run_plan(80.0));
        assert!(expected_s(&small) <= 8.0 && expected_s(&large) <= 80.0);
        assert!(large.runs.len() >= small.runs.len());
        assert!(large.left_out.len() <= small.left_out.len());
        let finest = |plan: &RunPlan| plan.grid.finest().contact_element_mm;
        assert!(finest(&large) <= finest(&small));
    }

    fn expected_s(plan: &RunPlan) -> f64 {
        plan.runs.iter().map(|run| run.expected_s).sum()
    }

    #[test]
    fn the_coarsest_grid_loses_the_runs_that_do_not_fit() {
        let text = br#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#;
        let scene = spec::read(text).expect("accepted");
        let within = |budget_s| RunPlan::within(&scene, &machine(), budget_s, &|_| Ok(()));
        let plan = within(100.0).expect("some runs fit");
        assert!(expected_s(&plan) <= 100.0, "{}", expected_s(&plan));
        assert!(plan.left_out.len() > 9, "{:?}", plan.left_out);
        let none = within(0.01).map(|plan| plan.runs.len());
        assert!(matches!(none, Err(RunPlanError::TooExpensive { least_s, .. }) if least_s > 0.01));
    }

    #[test]
    fn the_finest_run_of_a_grid_is_accepted() {
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
        let plan = RunPlan::within(&scene, &machine(), 8e4, &accept).expect("some runs");
        let finest = RunAccuracy::Fixed(plan.grid.finest());
        assert!(plan.runs.iter().any(|run| run.accuracy == finest));
        assert!(
            plan.runs
                .iter()
                .all(|run| run.estimate.footprint.dofs <= most)
        );
        let reported = |line: &String| line.starts_with("tolerance") && line.ends_with("unknowns");
        assert!(plan.left_out.iter().any(reported), "{:?}", plan.left_out);
        let refused = RunPlan::within(&scene, &machine(), 8e4, &|_| {
            Err(Refused::Faults(vec![Fault::new("/output", "too much")]))
        });
        assert!(matches!(refused, Err(RunPlanError::Refused(_))));
    }

    #[test]
    fn a_grid_that_fits_but_cannot_be_meshed_is_made_coarser() {
        let text = br#"{"system":{"kind":"fuzz_button"},"accuracy":{"preset":"fine"}}"#;
        let scene = spec::read(text).expect("accepted");
        let plan = RunPlan::within(&scene, &machine(), 86_400.0, &|_| Ok(())).expect("some runs");
        let finest = RunAccuracy::Fixed(plan.grid.finest());
        assert!(plan.runs.iter().any(|run| run.accuracy == finest));
    }

    #[test]
    fn sections_of_a_line_are_varied_and_bodies_of_a_width_keep_their_layers() {
        let plan = |model: &str| {
            let text = format!(
                r#"{{"system":{{"kind":"sd_card"}},"model":{model},"load":{{"kind":"force","n":0.5}},"cycles":300}}"#
            );
            let scene = spec::read(text.as_bytes()).expect("accepted");
            RunPlan::within(&scene, &machine(), 8e4, &|_| Ok(())).expect("some runs")
        };
        let line = plan(r#"{"dimension":"line","width_mm":0.8,"crown_radius_mm":10}"#);
        let levels = |run: &PlannedRun| match run.accuracy {
            RunAccuracy::Fixed(settings) => settings.stations,
            RunAccuracy::Tolerance(_) => None,
        };
        let levels: std::collections::BTreeSet<u32> = line.runs.iter().filter_map(levels).collect();
        let levels = Vec::from_iter(levels);
        assert_eq!(levels.len(), 3, "{levels:?}");
        assert_eq!(levels[2] - 1, 4 * (levels[0] - 1), "{levels:?}");
        assert!(
            line.left_out.iter().all(|line| line.contains("about")),
            "{:?}",
            line.left_out
        );
        let extruded = plan(r#"{"dimension":"extruded","width_mm":0.8}"#);
        let settings = extruded
            .runs
            .iter()
            .map(|run| run.accuracy.as_spec().overrides);
        assert!(
            settings
                .flatten()
                .all(|overrides| overrides.stations.is_none())
        );
    }

    #[test]
    fn runs_differ_in_their_accuracy_alone() {
        let plan = run_plan(8.0);
        for run in &plan.runs {
            let spec = &run.resolved.spec;
            assert_eq!((spec.cycles, spec.output.fields), (Some(300), Some(false)));
            assert_eq!(spec.output.snapshots_at_cycles.as_deref(), Some(&[300][..]));
            match run.accuracy {
                RunAccuracy::Tolerance(tolerance) => {
                    assert_eq!(spec.accuracy.tolerance, Some(tolerance));
                }
                RunAccuracy::Fixed(settings) => {
                    let overrides = spec.accuracy.overrides.as_ref().expect("overrides");
                    let element = overrides.contact_element_mm;
                    assert_eq!(element, Some(settings.contact_element_mm));
                }
            }
        }
    }
}
