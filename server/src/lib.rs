#![doc = include_str!("../README.md")]

pub mod bench;
pub mod cli;
pub mod clock;
pub mod documents;
pub mod files;
pub mod http;
pub mod machine;
pub mod metrics;
pub mod plot;
pub mod queue;
pub mod service;
pub mod solve;
pub mod store;
pub mod study;
pub mod translate;
pub mod worker;
