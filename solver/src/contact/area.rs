//! Contact of two bodies over an area: elastic half-spaces between the surfaces, on a regular grid of rectangular cells.
//!
//! The bodies are half-spaces of a common contact modulus E* (Johnson, Contact Mechanics, 1985, section 4.1), so that the
//! displacement by the pressure is a discrete convolution (`kernel`, `convolution`); the shapes of the surfaces only enter
//! the gap. Valid for contacts that are small against the bodies, away from their edges, of surfaces with small slopes.
//! Limiting case: Hertz' ellipse of contact.

mod cells;
mod convolution;
mod error;
mod kernel;
mod normal;
mod preconditioner;
mod tangential;

pub use cells::Cells;
pub use convolution::Parity;
pub use error::AreaError;
pub use kernel::ShearCompliance;
pub use normal::{
    MOST_ITERATIONS, NormalContact, NormalProblem, NormalSolution, RESIDUAL_TOLERANCE,
};
pub(crate) use tangential::TangentialContact;
pub use tangential::{MOST_TANGENTIAL_ITERATIONS, SHEAR_TOLERANCE, Shear, Slip, TangentialError};
