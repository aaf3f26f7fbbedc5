//! `/v1/worker-tokens`: tokens of remote workers.

pub(in crate::http) mod create;
pub(in crate::http) mod list;
pub(in crate::http) mod revoke;
