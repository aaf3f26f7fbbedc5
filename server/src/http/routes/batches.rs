//! Batches: one implementation per verb, mounted below `/v1/sweeps` and below `/v1/studies`.
//!
//! Every batch is a sweep to these routes: `/v1/sweeps` lists, shows, cancels and deletes studies too.

pub(crate) mod cancel;
pub(crate) mod delete;
mod error;
pub(crate) mod list;
pub(crate) mod outcomes;
pub(crate) mod picture;
pub(crate) mod plan;
pub(crate) mod retry;
pub(crate) mod show;
pub(crate) mod show_base;
pub(crate) mod submit;
