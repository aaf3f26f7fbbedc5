//! Statements that both engines execute. Each engine compiles this module and those below as its own, with the types of its `dialect`.

pub(super) mod attempts;
pub(super) mod batch_endings;
mod batch_submissions;
mod batches;
pub(super) mod checkpoints;
mod events;
mod expansion_rows;
mod files;
pub(super) mod held_leases;
mod integrity;
mod job_list;
pub(super) mod job_rows;
mod jobs;
pub(super) mod lost_jobs;
mod maintenance;
mod object_store;
pub(super) mod results;
pub(super) mod revisions;
pub(super) mod selects;
pub(super) mod stored_blocks;
mod stored_row;
mod worker_tokens;
pub(super) mod workers;

use super::{checkpoint_objects, dialect, expansions, queries, transitions};
