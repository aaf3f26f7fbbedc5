//! Routes: one file a route, always in the order error, handler, tests. Ids in paths and the problems that all routes
//! share are described in `http/openapi.rs`.

pub(in crate::http) mod batches;
pub(in crate::http) mod jobs;
pub(in crate::http) mod operation;
pub(in crate::http) mod results;
pub(in crate::http) mod systems;
pub(in crate::http) mod worker;
pub(in crate::http) mod worker_tokens;
