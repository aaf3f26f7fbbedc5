//! Frictional contact between two condensed bodies. Contact knows operators, not meshes.

pub mod area;
pub mod line;
pub mod planes;

pub(crate) use line::slopes_of_both;
pub use line::{
    ContactError, ContactState, Displacement, Increment, Pair, Solver, Status, Surfaces, WarmStart,
    Work, slopes,
};
pub(crate) use line::{DoseUnknowns, LinearisedContact, NextWorn, PassPosition, Place, Thickness};
