#![doc = include_str!("../README.md")]
#![expect(
    clippy::duplicate_mod,
    reason = "both engines of the store compile the statements in `store/sql/`, each with its own types"
)]

mod backoff;
pub mod batch;
pub mod cli;
pub mod client;
pub mod clock;
mod control_group;
pub mod estimate;
pub mod export;
mod groups;
pub mod http;
mod json_bytes;
pub mod metrics;
mod number;
pub mod objects;
pub mod placement;
pub mod program;
pub mod queue;
pub mod rating;
pub mod reference;
pub mod service;
pub mod solve;
pub mod spec;
pub mod store;
pub mod supervision;
mod text;
pub mod words;
pub mod worker;
