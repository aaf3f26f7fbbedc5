//! Estimates of a solve from the lengths of its scene, before anything is meshed or solved: unknowns, memory, output,
//! contact increments, and the processor time that this machine needs for them.

pub(crate) mod expected_time;
pub mod footprint;
pub(crate) mod foreseen;
mod life;
pub mod machine;
mod notes;
mod plan;
pub mod workload;

use crate::spec::Resolved;
use footprint::Footprint;
use workload::Workload;

/// Estimated size and work of a solve.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Unknowns, memory and output.
    pub footprint: Footprint,
    /// Contact increments and condensations.
    pub workload: Workload,
}

impl Estimate {
    /// Estimates the solve of a resolved specification; takes up to 10 ms.
    pub fn of(resolved: &Resolved) -> Self {
        let Resolved { scene, layout, .. } = resolved;
        let workload = Workload::of(scene, layout.as_ref());
        Self {
            footprint: Footprint::of(scene, layout.as_ref(), &workload),
            workload,
        }
    }
}
