//! Results of a job.

pub(in crate::http) mod archive;
pub(in crate::http) mod download;
pub(in crate::http) mod friction_loop;
pub(in crate::http) mod list;
pub(in crate::http) mod pressure;
pub(in crate::http) mod profile;
pub(in crate::http) mod stored_part;
pub(in crate::http) mod wear_history;
