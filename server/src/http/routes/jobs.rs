//! Jobs: plan, submit, list, show, specification as it was sent, cancel, retry, delete, stream.

pub(crate) mod cancel;
pub(crate) mod delete;
pub(crate) mod feed;
mod filter;
pub(crate) mod list;
pub(crate) mod list_labels;
pub(crate) mod plan;
pub(crate) mod retry;
pub(crate) mod retry_filtered;
pub(crate) mod show;
pub(crate) mod show_spec;
pub(crate) mod stream;
pub(crate) mod submit;
