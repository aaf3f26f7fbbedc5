//! A submitted study of accuracy: its base is a specification like any other.

use api::problem::Fault;
use api::spec::ParseError;
use api::study::StudyRequest;

use crate::batch::sweep;
use crate::spec::{NAME_LIMIT, Refused, Resolved};

/// Processor seconds that a study may be given.
const BUDGET_S: (f64, f64) = (1.0, 86_400.0);

/// Reads a study.
///
/// # Errors
/// [`Refused`] for what cannot be read.
pub fn read(bytes: &[u8]) -> Result<StudyRequest, Refused> {
    sweep::document(bytes)
}

/// The scene of a study, with its own accuracy.
///
/// # Errors
/// [`Refused`] with the faults of the study and of its base.
pub fn scene(request: &StudyRequest) -> Result<Resolved, Refused> {
    let mut faults = Vec::new();
    let name = request.name.as_deref().unwrap_or_default().chars().count();
    if name > NAME_LIMIT {
        let detail = format!("{name} characters, at most {NAME_LIMIT} are kept");
        faults.push(Fault::new("/name", detail));
    }
    let (least, most) = BUDGET_S;
    if let Some(budget) = request.budget_s.filter(|s| !(least..=most).contains(s)) {
        let detail = format!("{budget} is outside {least} to {most}");
        faults.push(Fault::new("/budget_s", detail));
    }
    // A document that was read can be written.
    let base = serde_json::to_vec(&request.base).unwrap_or_default();
    match crate::spec::read(&base).map_err(of_base) {
        Ok(resolved) if faults.is_empty() => return Ok(resolved),
        Ok(_) => {}
        Err(Refused::Faults(of_base)) => faults.extend(of_base),
        Err(broken) => return Err(broken),
    }
    Err(Refused::Faults(faults))
}

/// What is wrong with the base, or with a run of it, with its place in the study.
pub fn of_base(refused: Refused) -> Refused {
    let placed = |pointer: &str| format!("/base{pointer}");
    match refused {
        Refused::Parse(error) => Refused::Parse(ParseError {
            pointer: placed(&error.pointer),
            ..error
        }),
        Refused::Faults(faults) => Refused::Faults(
            faults
                .into_iter()
                .map(|fault| Fault::new(placed(&fault.pointer), fault.detail))
                .collect(),
        ),
    }
}
