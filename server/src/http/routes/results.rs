//! Results of a job.

pub(in crate::http) mod download_archive;
pub(in crate::http) mod download_file;
pub(in crate::http) mod list;
pub(in crate::http) mod max_points;
pub(in crate::http) mod read_history;
pub(in crate::http) mod read_snapshot;
