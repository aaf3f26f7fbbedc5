//! Reasons of restarts.

use solver::observer::Restart;

use crate::words::{effects, warnings};

/// The reason of a restart.
pub(crate) fn restart(restart: &Restart<'_>) -> String {
    match restart {
        Restart::WiderZones(error) => error.to_string(),
        Restart::Without(effect, error) => format!("without {}: {error}", effects::name(*effect)),
        Restart::Finer(excess) => warnings::all_excess(excess),
        Restart::NoFinerRun(error) => format!("the finer run has no solution: {error}"),
    }
}
