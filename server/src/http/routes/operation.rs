//! Operation of the service: health checks, metrics, pages, OpenAPI document.

pub(crate) mod check_health;
pub(crate) mod drain_worker;
pub(crate) mod explain_problem;
pub(crate) mod list_workers;
pub(crate) mod serve_pages;
pub(crate) mod show_metrics;
pub(crate) mod show_openapi;
pub(crate) mod show_service;
