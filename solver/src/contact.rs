//! Frictional contact between two condensed bodies. Contact knows operators, not meshes.

pub mod area;
pub mod line;
pub mod planes;

pub use line::{
    ContactError, ContactState, Displacement, GAP_TOLERANCE, Increment, MOST_ITERATIONS, Pair,
    Solver, Status, Surfaces, WarmStart, Work, slopes,
};
