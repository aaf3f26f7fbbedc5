//! Reasons of restarts.

use solver::observer::Restart;

use crate::words::warnings;

/// The reason of a restart.
pub(crate) fn restart(restart: &Restart<'_>) -> String {
    match restart {
        Restart::WiderZones(error) => error.to_string(),
        Restart::Without(effect, error) => format!("without {}: {error}", effect.name()),
        Restart::Finer(excess) => warnings::all_excess(excess),
        Restart::NoFinerRun(error) => format!("the finer run has no solution: {error}"),
    }
}
