//! Problem documents (RFC 9457) and the faults of a specification.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A fault of a specification.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Fault {
    /// JSON pointer (RFC 6901) into the submitted document.
    pub pointer: String,
    /// Description, with the value and its limit.
    pub detail: String,
}

impl Fault {
    /// Creates a fault at `pointer`.
    pub fn new(pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        Self {
            pointer: pointer.into(),
            detail: detail.into(),
        }
    }
}

/// A problem document (RFC 9457); media type `application/problem+json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Problem {
    /// Stable type of the problem, a relative URI reference.
    #[serde(rename = "type")]
    pub kind: String,
    /// Title of the type; the same for every problem of that type.
    pub title: String,
    /// HTTP status code.
    pub status: u16,
    /// Description of this occurrence.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub detail: Option<String>,
    /// Every fault found in the submitted document.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub faults: Vec<Fault>,
}
