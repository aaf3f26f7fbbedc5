//! Operating the service: health, metrics, pages, and the description of the interface.

pub(in crate::http) mod health;
pub(in crate::http) mod metrics;
pub mod openapi;
pub(in crate::http) mod pages;
