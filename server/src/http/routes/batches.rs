//! Batches: one implementation per verb, mounted below `/v1/sweeps` and below `/v1/studies`.
//!
//! Every batch is a sweep to these routes: `/v1/sweeps` lists, shows, cancels and deletes studies too.

pub(in crate::http) mod cancel;
pub(in crate::http) mod delete;
mod error;
pub(in crate::http) mod list;
pub(in crate::http) mod outcomes;
pub(in crate::http) mod picture;
pub(in crate::http) mod show;
pub(in crate::http) mod submit;
