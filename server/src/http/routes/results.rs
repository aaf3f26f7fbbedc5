//! Results of a job.

pub(crate) mod compare_histories;
pub(crate) mod download_archive;
pub(crate) mod download_file;
pub(crate) mod list;
pub(crate) mod list_quantities;
pub(crate) mod max_points;
pub(crate) mod read_history;
pub(crate) mod read_snapshot;
