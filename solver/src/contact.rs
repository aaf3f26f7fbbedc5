//! Frictional contact between two condensed bodies. Contact knows operators, not meshes.

pub mod area;
pub mod line;
pub mod planes;

pub use line::{
    ContactError, ContactState, Displacement, Increment, Pair, Solver, Status, Surfaces, WarmStart,
    Work, slopes,
};
pub(crate) use line::{DoseUnknowns, LinearisedContact, NextWorn, PassPosition, Place, Thickness};
pub(crate) use line::{coefficients_in_contact, slopes_of_both};
