//! Routes: one file a route, always in the order error, handler, tests.

pub(in crate::http) mod batches;
pub(in crate::http) mod jobs;
pub(in crate::http) mod operation;
pub(in crate::http) mod results;
pub(in crate::http) mod systems;
