//! The manifest: what a job produced.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::job::Status;

/// A file that a job produced.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct ResultFile {
    /// Its name, unique within the job.
    pub name: String,
    /// The cycle it belongs to; absent where it belongs to the whole run.
    pub cycle: Option<u64>,
    /// Its media type.
    pub media_type: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, hexadecimal.
    pub sha256: String,
}

/// What a job produced.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Manifest {
    /// The job.
    pub job: Uuid,
    /// Where it stands.
    pub status: Status,
    /// Whether nothing will be added: the job has ended.
    pub complete: bool,
    /// The files, by name.
    pub files: Vec<ResultFile>,
    /// Where they are: name to path; and `archive`, all of them as a zip.
    pub links: BTreeMap<String, String>,
}
