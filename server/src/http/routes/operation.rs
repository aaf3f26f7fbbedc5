//! Operation of the service: health checks, metrics, pages, OpenAPI document.

pub(in crate::http) mod check_health;
pub(in crate::http) mod serve_pages;
pub(in crate::http) mod show_metrics;
pub(in crate::http) mod show_openapi;
