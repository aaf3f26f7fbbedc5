//! Wear of a point contact in reciprocating sliding: two bodies of finite relative radii in both directions, as half-spaces.
//!
//! `contact::area` solves for the pressure of each increment on a window that follows the contact (`sliding`), with the wear of the
//! increment inside the solve. The bodies' surfaces are grids of their own (`surface`); the slider's moves by whole cells (`lattice`).
//! A computed cycle stands for a jump of cycles (`jump`, `integrator`).
//!
//! In gross slip the whole contact slips by the displacement (`SlipRegime::Gross`). Where a part of it may stick (`Partial`), the slip of
//! each cell follows from Coulomb's law in the plane (`stick`), and surfaces wear in place.
//!
//! x is the sliding direction, z lies across it; lengths are mm, forces N, pressures MPa. Shear does not change the pressure, which is
//! exact for like bodies. Limiting cases: Hertz' contact without wear; in gross slip the worn volume is k F s on either side; Mindlin's
//! loop in partial slip.

mod check;
mod contact_at_position;
mod energy;
mod error;
mod field;
mod friction;
mod integrator;
mod jump;
mod lattice;
mod legs;
mod mission;
mod motion_history;
mod motions;
mod point_state;
mod record;
mod run;
mod section;
mod sliding;
mod spring;
mod state;
mod stick;
mod surface;
mod window;

pub(crate) use contact_at_position::ContactAtPosition;
pub use error::PointError;
pub(crate) use integrator::PointIntegrator;
pub(crate) use jump::{
    ITERATIONS, ITERATIONS_OF_IMPLICIT, JumpBounds, JumpControl, laws_of_implicit_jumps, saves_work,
};
pub(crate) use lattice::is_steady;
pub(crate) use legs::legs;
pub use motion_history::PointHistory;
pub(crate) use motions::PointMotions;
pub use point_state::PointState;
pub use record::{DepthMap, PointCycle, PointOutcome, PointSummary};
pub use run::run;
