//! Plane contact along a line: large sliding with friction between two condensed bodies, wear inside the solve.
//!
//! Both surfaces are graphs over x. The nodes of one of them, the slave, carry the constraints and the tractions: the
//! receptacle, or a slider that wears (`resolution` chooses). With the slope s of the interface there, a mean of
//! both surfaces' (`Interface::slope_weights`), the vectors N = (-s, 1) and T = (1, s) are normal and tangent of an
//! element of *projected* length dx, so that integrals over the surface are integrals over x and nodal widths never
//! change:
//!
//! * traction on the slider per dx: p N - q T, with the true pressure p and the true shear q;
//! * vertical gap g and tangential slip sigma = T . (relative displacement since the last increment);
//! * Archard per dx: vertical recession = k p |sigma|, energy = |q sigma|;
//! * slip along the line besides: `slip_along`.
//!
//! A jump u of the surfaces, slider over receptacle, changes the gap at a point of the slave by (-s', 1) . u with the
//! slope s' of the *master*, which the jump shifts: a sticking contact stays at its position on the slave although the
//! imposed displacement has increased.
//!
//! The dual mortar method couples nodal averages over the slave, e.g.
//! jump_i = sum_j Mhat_ij u_j(slider) - u_i(receptacle), and the response to nodal forces F is
//! jump = (Mhat C_m Mhat^T + C_s) F with the condensed compliances of master and slave.

mod active_set;
pub(super) mod active_window;
pub(super) mod band;
mod complementarity;
mod deformation;
mod error;
pub(super) mod friction;
mod geometry;
mod increment;
mod linearised;
pub(super) mod local_slopes;
pub(super) mod mortar;
mod newton;
mod outcome;
mod pair;
mod pairing;
mod predictor;
mod problem;
mod rate_contrast;
mod response;
mod slip_along;
mod state;
mod status;
mod unknown;
pub(super) mod wear_coupling;
mod work;

pub(crate) use active_window::CANDIDATE_GAP;
pub use error::ContactError;
pub(crate) use friction::coefficients_in_contact;
pub use increment::Solver;
pub(crate) use linearised::{DoseUnknowns, LinearisedContact, PassPosition, Place};
pub use outcome::Increment;
pub(crate) use pair::slopes_of_both;
pub use pair::{Displacement, Pair, Surfaces, WarmStart, slopes};
pub(crate) use problem::GAP_TOLERANCE;
pub(crate) use rate_contrast::{NextWorn, Thickness};
pub use state::ContactState;
pub use status::Status;
pub use work::Work;

#[cfg(test)]
mod tests;
