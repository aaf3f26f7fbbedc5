//! Contact systems: presets, and JSON Schemas of their specifications.

pub(in crate::http) mod list;
pub(in crate::http) mod schema;
pub(in crate::http) mod show;
