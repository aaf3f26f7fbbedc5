//! A submitted accuracy study: its base is a specification like any other.

use api::plan::MachineFigures;
use api::problem::Fault;
use api::study::StudyRequest;

use crate::batch::accuracy::evaluation_plan::EvaluationPlan;
use crate::batch::accuracy::run_plan::{BUDGET_S, Base, RunPlan, RunPlanError};
use crate::batch::error::ExpandError;
use crate::batch::variation::{Accept, Variation, name_fault};
use crate::spec::{Refused, Resolved};

/// Range of a study's budget, processor seconds.
const BUDGET_RANGE_S: (f64, f64) = (1.0, 86_400.0);

/// Returns the jobs of a study in order, and its evaluation plan as JSON. Up to some forty scenes are resolved, which
/// takes seconds.
///
/// # Errors
/// [`ExpandError`] with the faults of the study and of its base.
pub(in crate::batch) fn expand(
    request: &StudyRequest,
    machine: &MachineFigures,
    accept: &Accept<'_>,
) -> Result<(Vec<Variation>, String), ExpandError> {
    let resolved = resolve(request)?;
    let budget_s = request.budget_s.unwrap_or(BUDGET_S);
    let base = Base {
        sent: &request.base,
        resolved: &resolved,
    };
    let run_plan = RunPlan::within(base, machine, budget_s, accept).map_err(refused)?;
    let evaluation_plan = EvaluationPlan::new(resolved.spec, run_plan.grid, run_plan.left_out);
    let runs = run_plan.runs.into_iter().map(|run| {
        let accuracy = serde_json::to_value(run.accuracy.as_spec())?;
        Ok(Variation {
            overrides: [("/accuracy".to_owned(), accuracy)].into(),
            sent: run.sent,
            resolved: run.resolved,
            estimate: run.estimate,
        })
    });
    let variations = runs.collect::<Result<_, serde_json::Error>>()?;
    Ok((variations, serde_json::to_string(&evaluation_plan)?))
}

/// Resolves the base of a study, with its own accuracy.
fn resolve(request: &StudyRequest) -> Result<Resolved, Refused> {
    let mut faults = Vec::from_iter(name_fault(request.name.as_deref()));
    let (least, most) = BUDGET_RANGE_S;
    if let Some(budget) = request.budget_s.filter(|s| !(least..=most).contains(s)) {
        let detail = format!("{budget} is outside {least} to {most}");
        faults.push(Fault::new("/budget_s", detail));
    }
    // A document that was read can be serialized.
    let base = serde_json::to_vec(&request.base).unwrap_or_default();
    match crate::spec::read(&base).map_err(of_base) {
        Ok(resolved) if faults.is_empty() => return Ok(resolved),
        Ok(_) => {}
        Err(Refused::Faults(of_base)) => faults.extend(of_base),
        Err(broken) => return Err(broken),
    }
    Err(Refused::Faults(faults))
}

/// Returns the faults of a study for which there are no runs.
fn refused(error: RunPlanError) -> Refused {
    match error {
        RunPlanError::Refused(refused) => of_base(refused),
        RunPlanError::TooExpensive { .. } => {
            Refused::Faults(vec![Fault::new("/budget_s", error.to_string())])
        }
    }
}

/// Moves the faults of the base, or of a run of it, to their pointers in the study.
fn of_base(refused: Refused) -> Refused {
    match refused {
        Refused::Parse(mut error) => {
            error.pointer.insert_str(0, "/base");
            for fault in &mut error.others {
                fault.pointer.insert_str(0, "/base");
            }
            Refused::Parse(error)
        }
        Refused::Faults(mut faults) => {
            for fault in &mut faults {
                fault.pointer.insert_str(0, "/base");
            }
            Refused::Faults(faults)
        }
    }
}
