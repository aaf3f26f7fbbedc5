//! Events and results as they are stored.

use std::path::PathBuf;

use api::results::ResultFile;
use serde::{Deserialize, Serialize};

/// A stored event.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredEvent {
    /// Its number within the job, from 1 without gaps.
    pub seq: i64,
    /// Its name.
    pub name: String,
    /// Its document, JSON.
    pub data: String,
}

/// A file to be added to a manifest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NewFile {
    /// Its entry in the manifest.
    pub file: ResultFile,
    /// The content, if it is small; otherwise it is a file of that name in the attempt's folder.
    pub content: Option<Vec<u8>>,
}

/// Content of a result file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// The bytes, from the database.
    Inline(Vec<u8>),
    /// Path of the file.
    File(PathBuf),
}

/// A document of a snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SnapshotPart {
    /// Worn depth.
    Profile,
    /// Contact tractions.
    Pressure,
    /// Friction loop.
    Loop,
}
