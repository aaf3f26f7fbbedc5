//! Contact systems: presets, and JSON Schemas of their specifications.

pub(crate) mod list;
pub(crate) mod schema;
pub(crate) mod show;
