//! The list of contact systems.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::spec::{Spec, SystemKind};

/// A contact system and its preset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SystemDocument {
    /// Kind.
    pub kind: SystemKind,
    /// Description.
    pub description: String,
    /// The specification that `{"system": {"kind": ..}}` resolves to, with the provenance of each value.
    pub preset: Spec,
    /// JSON Schema (2020-12) of a specification of this kind.
    pub schema: serde_json::Value,
}

/// Every contact system.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SystemList {
    /// The systems.
    pub systems: Vec<SystemDocument>,
}
