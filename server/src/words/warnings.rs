//! Warnings of results.

use solver::record::{Excess, Quantity, Warning};

use crate::words::{decisions, effects};

/// A warning.
pub(crate) fn warning(warning: &Warning) -> String {
    match warning {
        Warning::Excess(found) => excess(found),
        Warning::NoCompanion => {
            "errors are not estimated: a coarse companion has no solution".to_owned()
        }
        Warning::NoFinerRun => "a finer run has no solution".to_owned(),
        Warning::Missed(decision) => {
            let name = effects::name(decision.effect);
            format!("{name}: {}", decisions::missed(decision))
        }
    }
}

/// All errors outside of the tolerance.
pub(crate) fn all_excess(all: &[Excess]) -> String {
    let all: Vec<String> = all.iter().map(excess).collect();
    all.join("; ")
}

/// An error outside of the tolerance.
fn excess(found: &Excess) -> String {
    let name = match found.quantity {
        Quantity::WornDepth => "worn depth",
        Quantity::ScarHalfWidth => "scar width",
        Quantity::WornArea => "worn area",
        Quantity::PeakPressure => "peak pressure",
        Quantity::ContactResistance => "contact resistance",
    };
    format!(
        "the estimated error of the {name} is {:.2} %, the tolerance allows {:.2} %",
        100.0 * found.relative,
        100.0 * found.allowed
    )
}
