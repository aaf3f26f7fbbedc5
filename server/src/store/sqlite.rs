//! The embedded store: `SQLite` through one writing connection and a pool of readers.

pub(in crate::store) mod backup;
pub(in crate::store) mod batches;
pub(in crate::store) mod checkpoints;
pub(in crate::store) mod claims;
pub(in crate::store) mod conclusion;
pub(in crate::store) mod document;
pub(in crate::store) mod events;
pub(in crate::store) mod files;
pub(in crate::store) mod folder;
pub(in crate::store) mod jobs;
pub(in crate::store) mod leases;
pub(in crate::store) mod levels;
pub(in crate::store) mod open;
pub(in crate::store) mod queries;
pub(in crate::store) mod rescues;
pub(in crate::store) mod results;
pub(in crate::store) mod submissions;
pub(in crate::store) mod upkeep;
