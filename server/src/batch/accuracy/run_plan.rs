//! The run plan of a study: its runs, chosen before anything is solved, by their expected time.

use api::plan::MachineFigures;
use serde_json::{Value, json};

use crate::batch::accuracy::grid::{Baseline, Grid};
use crate::batch::accuracy::run_accuracy::RunAccuracy;
use crate::batch::accuracy::settings::Settings;
use crate::batch::variation::Accept;
use crate::estimate::Estimate;
use crate::estimate::expected_time::ExpectedTime;
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

/// The specification whose accuracy a study varies.
#[derive(Debug, Clone, Copy)]
pub struct Base<'a> {
    /// As it was sent.
    pub sent: &'a Value,
    /// With every default filled in.
    pub resolved: &'a Resolved,
}

/// A planned run.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// Accuracy setting.
    pub accuracy: RunAccuracy,
    /// Specification of the run as it would be sent, JSON.
    pub sent: String,
    /// Resolved specification.
    pub resolved: Resolved,
    /// Estimate of the run.
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
        base: Base<'_>,
        machine: &MachineFigures,
        budget_s: f64,
        accept: &Accept<'_>,
    ) -> Result<Self, RunPlanError> {
        let planned = |accuracy| plan_run(base, accuracy, machine, accept);
        let mut chosen = Chosen::default();
        for tolerance in TOLERANCES {
            let most_s = TOLERANCE_SHARE * EXPECTED_SHARE * budget_s;
            let accuracy = RunAccuracy::Tolerance(tolerance);
            chosen.add(accuracy, planned(accuracy), most_s);
        }
        let most_s = EXPECTED_SHARE * budget_s;
        let estimate = Estimate::of(base.resolved);
        let expected_s = ExpectedTime::of(machine, &estimate.workload).likely_s;
        let baseline = Baseline::of(base.resolved, &estimate, expected_s);
        let (grid, runs) = grid_within(&baseline, most_s - chosen.spent_s, &planned);
        for (settings, run) in runs {
            chosen.add(RunAccuracy::Fixed(settings), run, most_s);
        }
        chosen.into_plan(grid, budget_s)
    }
}

/// A run, or why it is refused.
type Planned = Result<PlannedRun, Refused>;

/// Plans a run at another accuracy.
fn plan_run(
    base: Base<'_>,
    accuracy: RunAccuracy,
    machine: &MachineFigures,
    accept: &Accept<'_>,
) -> Planned {
    let sent = run_spec(base, accuracy).to_string();
    let resolved = spec::read(sent.as_bytes())?;
    let estimate = Estimate::of(&resolved);
    accept(&estimate)?;
    let expected_s = ExpectedTime::of(machine, &estimate.workload).likely_s;
    Ok(PlannedRun {
        accuracy,
        sent,
        resolved,
        estimate,
        expected_s,
    })
}

/// The finest grid whose runs are expected to take so many seconds, and its runs, coarsest first.
fn grid_within(
    baseline: &Baseline,
    most_s: f64,
    planned: &dyn Fn(RunAccuracy) -> Planned,
) -> (Grid, Vec<(Settings, Planned)>) {
    let fixed = |settings| planned(RunAccuracy::Fixed(settings));
    let within = |factor: f64| {
        let grid = Grid::within(baseline, factor, most_s, &|settings| {
            fixed(settings).is_ok()
        });
        let runs = grid.coarsest_first().into_iter();
        let runs: Vec<_> = runs.map(|settings| (settings, fixed(settings))).collect();
        (grid, runs)
    };
    let pilot = baseline.pilot();
    let factor = fixed(pilot).map_or(1.0, |run| run.expected_s / baseline.cost_s(pilot));
    let (grid, runs) = within(factor);
    let (expected, foreseen) = sums(&runs, baseline);
    // The expected times of this grid's runs are a better estimate than that of the pilot.
    if expected > most_s && expected > factor * foreseen {
        within(expected / foreseen)
    } else {
        (grid, runs)
    }
}

/// Expected seconds of all accepted runs, and what the baseline foresees for them.
fn sums(runs: &[(Settings, Planned)], baseline: &Baseline) -> (f64, f64) {
    let accepted = runs.iter().filter_map(|(settings, run)| {
        let run = run.as_ref().ok()?;
        Some((run.expected_s, baseline.cost_s(*settings)))
    });
    accepted.fold((0.0, 0.0), |(a, b), (expected, foreseen)| {
        (a + expected, b + foreseen)
    })
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
    fn add(&mut self, accuracy: RunAccuracy, run: Planned, most_s: f64) {
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

/// Returns the specification of a run: the base with another accuracy and less output.
fn run_spec(base: Base<'_>, accuracy: RunAccuracy) -> Value {
    let Base { sent, resolved } = base;
    let mut run = sent.clone();
    run["accuracy"] = json!(accuracy.as_spec());
    // The last cycle always has a snapshot; any other snapshot would cut jumps short.
    let cycles = (!spec::is_continuous(&resolved.spec)).then(|| [spec::cycles(&resolved.spec)]);
    let output = &mut run["output"];
    output["fields"] = json!(false);
    output["snapshots_at_cycles"] = json!(cycles);
    if let Some(output) = output.as_object_mut() {
        output.remove("snapshots_at_distance_mm");
    }
    // The dimension of the base, where it was chosen for its output too.
    if resolved.chosen.is_some() {
        run["model"] = json!(resolved.spec.model);
    }
    run
}

#[cfg(test)]
mod tests;
