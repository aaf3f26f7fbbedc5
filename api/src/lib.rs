#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod batch;
mod enum_value;
pub mod event;
pub mod job;
pub mod outcome;
pub mod plan;
pub mod problem;
pub mod rating;
pub mod results;
pub mod service;
pub mod spec;
pub mod study;
pub mod sweep;
pub mod system;
pub mod worker;
