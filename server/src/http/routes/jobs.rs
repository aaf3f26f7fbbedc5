//! Jobs: plan, submit, list, show, cancel, delete, stream.

pub(in crate::http) mod cancel;
pub(in crate::http) mod delete;
pub(in crate::http) mod list;
pub(in crate::http) mod plan;
pub(in crate::http) mod show;
pub(in crate::http) mod stream;
pub(in crate::http) mod submit;
