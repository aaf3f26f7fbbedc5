//! Decisions about effects.

use solver::effects::Decision;

/// Error of a result by an effect that is beyond its limit and not simulated.
pub(crate) fn missed(decision: &Decision) -> String {
    let calls = if decision.effect.is_available() && decision.is_available {
        "the scene calls for it"
    } else {
        "it is beyond its limit and not simulated"
    };
    format!("{calls}: {}", decision.reason)
}
