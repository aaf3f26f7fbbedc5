//! Parts that the requests of all kinds share: a base specification, a name, and the jobs they are expanded into.

use api::problem::Fault;
use api::sweep::Changes;
use serde::de::DeserializeOwned;

use crate::estimate::Estimate;
use crate::spec::{NAME_LIMIT, Refused, Resolved};

/// Decides whether a job may be queued here.
pub type Accept<'a> = dyn Fn(&Estimate) -> Result<(), Refused> + 'a;

/// A job of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// Changes against the base specification.
    pub overrides: Changes,
    /// Specification of the variation as it would be sent, JSON.
    pub sent: String,
    /// Specification.
    pub resolved: Resolved,
    /// Estimate.
    pub estimate: Estimate,
}

/// Reads a document with a specification in it.
pub(in crate::batch) fn read<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Refused> {
    let (request, unknown) = api::spec::read(bytes)?;
    if unknown.is_empty() {
        Ok(request)
    } else {
        Err(Refused::Faults(unknown))
    }
}

/// Returns the fault of a name that is too long, or that no database can store.
pub(in crate::batch) fn name_fault(name: Option<&str>) -> Option<Fault> {
    let name = name?;
    let length = name.chars().count();
    if length > NAME_LIMIT {
        let detail = format!("{length} characters, at most {NAME_LIMIT} are allowed");
        return Some(Fault::new("/name", detail));
    }
    let has_nul = name.contains('\0');
    has_nul.then(|| Fault::new("/name", "the character U+0000 is not allowed"))
}
