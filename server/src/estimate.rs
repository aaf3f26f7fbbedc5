//! What a solve will take, estimated before anything is solved: unknowns, memory, output, contact increments, and the
//! processor time that this machine needs for them.

pub mod footprint;
pub mod machine;
mod notes;
mod plan;
pub mod workload;

pub use plan::plan;
