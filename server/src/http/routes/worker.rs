//! `/v1/worker/`: what remote workers ask of the service. Between programs of the same version, and so no part of the OpenAPI
//! document.

pub(in crate::http) mod claim;
pub(in crate::http) mod put_file;
pub(in crate::http) mod renew;
pub(in crate::http) mod restart;
pub(in crate::http) mod show_checkpoint;
pub(in crate::http) mod show_demand;
pub(in crate::http) mod write;
