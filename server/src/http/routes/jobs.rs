//! Jobs: plan, submit, list, show, cancel, delete, stream.

pub(in crate::http) mod cancel;
pub(in crate::http) mod delete;
pub(in crate::http) mod list;
pub(in crate::http) mod make_plan;
pub(in crate::http) mod show;
pub(in crate::http) mod stream_events;
pub(in crate::http) mod submit;
