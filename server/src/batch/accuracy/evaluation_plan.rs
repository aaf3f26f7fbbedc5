//! The evaluation plan of an accuracy study: what the comparison of its results needs besides the results themselves.

use api::spec::Spec;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

use crate::batch::accuracy::grid::Grid;
use crate::batch::error::EvaluateError;

/// Format that this program writes and reads: raised when the grid changes its meaning.
const FORMAT: u32 = 1;

/// Evaluation plan, stored as JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct EvaluationPlan {
    format: u32,
    /// The resolved specification whose accuracy is varied.
    pub(super) spec: Spec,
    /// The grid among the runs.
    pub(super) grid: Grid,
    /// Runs that did not fit into the budget, in words.
    pub(super) left_out: Vec<String>,
}

/// The part of the document that all formats share.
#[derive(Deserialize)]
struct Header {
    format: u32,
}

impl EvaluationPlan {
    /// A plan in the present format.
    pub(super) fn new(spec: Spec, grid: Grid, left_out: Vec<String>) -> Self {
        Self {
            format: FORMAT,
            spec,
            grid,
            left_out,
        }
    }

    /// Reads the plan of a study.
    pub(super) fn decode(id: Uuid, text: &str) -> Result<Self, EvaluateError> {
        let corrupt = |cause| EvaluateError::Corrupt {
            id,
            what: "evaluation plan",
            cause,
        };
        let Header { format } = serde_json::from_str(text).map_err(corrupt)?;
        if format != FORMAT {
            return Err(EvaluateError::Format {
                id,
                found: format,
                supported: FORMAT,
            });
        }
        serde_json::from_str(text).map_err(corrupt)
    }
}
