//! Accuracy studies: one scene solved at many resolutions, compared with the converged solution.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::batch::BatchOverview;
use crate::job::{Outcome, Status};
use crate::spec::Spec;

/// A study to be submitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyRequest {
    /// Name for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The specification whose accuracy is varied.
    #[schema(value_type = Spec)]
    pub base: Value,
    /// Budget for the expected time of all runs together, processor seconds; 180 unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget_s: Option<f64>,
}

/// A job of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StudyJob {
    /// The job.
    pub id: Uuid,
    /// Tolerance; absent where the settings are fixed.
    pub tolerance: Option<f64>,
    /// Surface element size under the contact, mm, where it is fixed.
    pub contact_element_mm: Option<f64>,
    /// Increments per computed cycle, where they are fixed.
    pub increments_per_cycle: Option<u32>,
    /// Jump, where that is fixed.
    pub cycle_jump: Option<f64>,
    /// Sections along a line, where they are fixed.
    pub stations: Option<u32>,
    /// Status.
    pub status: Status,
    /// How its solve ended.
    pub outcome: Option<Outcome>,
}

/// A study in the service: its jobs, and the comparison of their results so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StudyDocument {
    /// Id.
    pub id: Uuid,
    /// Name for people.
    pub name: Option<String>,
    /// Time of its submission (RFC 3339).
    #[schema(format = DateTime)]
    pub created_at: String,
    /// Number of its jobs by status, including statuses that no job has.
    pub counts: BTreeMap<String, u64>,
    /// Jobs in order, without those that were deleted.
    pub jobs: Vec<StudyJob>,
    /// The results so far, compared; absent until a job at a tolerance, or the finest of the grid, has succeeded.
    pub study: Option<Study>,
    /// Related resources: relation to path.
    pub links: BTreeMap<String, String>,
}

/// A page of studies, newest first.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct StudyList {
    /// The studies.
    pub studies: Vec<BatchOverview>,
    /// Token of the next page, if there is one.
    pub next_page_token: Option<String>,
}

/// Accuracy against processor time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Study {
    /// The resolved specification whose accuracy was varied.
    pub spec: Spec,
    /// The solution that the runs are compared with.
    pub reference: Reference,
    /// The runs, cheapest first.
    pub runs: Vec<StudyRun>,
    /// Runs that were left out to stay within the budget, in words.
    pub left_out: Vec<String>,
}

/// One run of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StudyRun {
    /// Tolerance; absent where the settings were fixed.
    pub tolerance: Option<f64>,
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Elements along the receptacle's contact surface.
    pub contact_elements: u64,
    /// Increments per computed cycle (the largest number that was used).
    pub increments_per_cycle: u32,
    /// Mean number of physical cycles per computed cycle.
    pub cycle_jump: f64,
    /// Sections along the line; absent where the contact has none.
    pub stations: Option<u32>,
    /// How it ended; absent where it failed.
    pub outcome: Option<Outcome>,
    /// Why it failed.
    pub failure: Option<String>,
    /// Errors against the reference; absent where it failed.
    pub errors: Option<Errors>,
    /// Names of its errors that are smaller than the uncertainty of the reference, and so only bounded by it.
    #[serde(rename = "below_doubt")]
    pub below_uncertainty: Vec<String>,
    /// Processor time of its process, s.
    pub cpu_s: f64,
    /// Largest resident memory of its process, MiB.
    pub peak_memory_mb: f64,
    /// True if it is on the Pareto front: no cheaper run has errors of depth and width as small.
    pub on_front: bool,
}

/// Relative differences of two solutions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Errors {
    /// Largest difference of worn depth anywhere on either surface, over the largest depth.
    pub depth: f64,
    /// Of the scar's half-width.
    pub width: f64,
    /// Of the peak pressure at the neutral position at the end.
    pub peak_pressure: f64,
    /// Of the worn area.
    pub area: f64,
}

impl Errors {
    /// The error that a tolerance bounds: the larger one of depth and width.
    pub fn tolerance_error(&self) -> f64 {
        self.depth.max(self.width)
    }

    /// The larger one of each of these errors and others.
    #[must_use]
    pub fn at_least(&self, other: &Self) -> Self {
        Self {
            depth: self.depth.max(other.depth),
            width: self.width.max(other.width),
            peak_pressure: self.peak_pressure.max(other.peak_pressure),
            area: self.area.max(other.area),
        }
    }

    /// Names of the errors that are smaller than others.
    pub fn below(&self, other: &Self) -> Vec<String> {
        let pairs = [
            ("depth", self.depth, other.depth),
            ("width", self.width, other.width),
            ("peak_pressure", self.peak_pressure, other.peak_pressure),
            ("area", self.area, other.area),
        ];
        let below = pairs.into_iter().filter(|(_, mine, theirs)| mine < theirs);
        below.map(|(name, ..)| name.to_owned()).collect()
    }
}

/// The solution that runs are compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Reference {
    /// Derivation, in words.
    pub method: String,
    /// Largest worn depth, mm.
    pub max_depth_mm: f64,
    /// Half the width of the scar, mm.
    pub scar_half_width_mm: f64,
    /// Peak pressure at the neutral position at the end, MPa.
    pub peak_pressure_mpa: f64,
    /// Worn area, mm^2.
    pub worn_area_mm2: f64,
    /// Uncertainty: the sizes of all corrections that lead from the finest run to it.
    pub uncertainty: Errors,
    /// Observed orders of convergence, one row for each setting.
    pub orders: Vec<Orders>,
}

/// Observed orders p of one setting: halving it divides the error by 2^p. Absent where three levels do not converge
/// monotonically.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Orders {
    /// The setting: `contact_element_mm`, `increments_per_cycle`, `cycle_jump` or `stations`.
    pub setting: String,
    /// Three levels, finest first.
    pub levels: Vec<f64>,
    /// Of the largest worn depth.
    pub depth: Option<f64>,
    /// Of the scar's half-width.
    pub width: Option<f64>,
    /// Of the peak pressure.
    pub peak_pressure: Option<f64>,
    /// Of the worn area.
    pub area: Option<f64>,
}
