//! Contact systems: presets, units, and the schema of a specification.

pub(in crate::http) mod read;
pub(in crate::http) mod schema;
