//! Batches: parameter sweeps and studies of accuracy.

pub(in crate::http) mod cancel_study;
pub(in crate::http) mod cancel_sweep;
pub(in crate::http) mod list_sweeps;
pub(in crate::http) mod remove_sweep;
pub(in crate::http) mod show_study;
pub(in crate::http) mod show_sweep;
pub(in crate::http) mod study_picture;
pub(in crate::http) mod study_table;
pub(in crate::http) mod submit_study;
pub(in crate::http) mod submit_sweep;
pub(in crate::http) mod sweep_outcomes;
