//! Contact of two bodies over an area: elastic half-spaces between the surfaces, on a regular grid of rectangular cells.
//!
//! The bodies are half-spaces of a common contact modulus E* (Johnson, Contact Mechanics, 1985, section 4.1), so that the
//! displacement by the pressure is a discrete convolution (`kernel`, `convolution`); the shapes of the surfaces only enter
//! the gap. Valid for contacts that are small against the bodies, away from their edges, of surfaces with small slopes.
//! Limiting case: Hertz' ellipse of contact.

mod cells;
mod convergence;
mod convolution;
mod error;
mod kernel;
mod normal;
mod preconditioner;
mod tangential;
mod transform;

pub use cells::Cells;
pub(crate) use convolution::{Convolution, Parity};
pub use error::AreaError;
pub(crate) use kernel::{ShearCompliance, normal_influence};
pub use normal::{NormalContact, NormalProblem, NormalSolution};
pub(crate) use tangential::SHEAR_TOLERANCE;
pub(crate) use tangential::TangentialContact;
pub use tangential::{Shear, Slip, TangentialError};
pub(crate) use transform::PlaneTransform;
