//! The manifest: what a job produced.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::job::Status;

/// A file that a job produced.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct ResultFile {
    /// File name, unique within the job.
    pub name: String,
    /// The cycle it belongs to; null if it belongs to the whole run.
    pub cycle: Option<u64>,
    /// Media type.
    pub media_type: String,
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 of the content, hexadecimal.
    #[schema(pattern = "^[0-9a-f]{64}$")]
    pub sha256: String,
    /// How the stored content was found to differ from this entry; absent while no damage was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damaged: Option<String>,
}

/// Result files of a job.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Manifest {
    /// The job.
    pub job: Uuid,
    /// Status of the job.
    pub status: Status,
    /// True once the job has ended: no file will be added.
    pub complete: bool,
    /// The files, by name.
    pub files: Vec<ResultFile>,
    /// Paths of the files by name; `archive` is a zip of all files.
    pub links: BTreeMap<String, String>,
}
