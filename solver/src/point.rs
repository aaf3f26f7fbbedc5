//! Wear of a point contact in gross reciprocating sliding: two convex bodies of finite radii in both directions, as half-spaces.
//!
//! `contact::area` solves for the pressure of each increment on a window that follows the contact (`sliding`), with the wear of the
//! increment inside the solve. The bodies' surfaces are grids of their own (`surface`); the slider's moves by whole cells (`lattice`).
//! A computed cycle stands for a jump of cycles (`jump`, `run`).
//!
//! x is the sliding direction, z lies across it; lengths are mm, forces N, pressures MPa. Friction only dissipates: mu F acts along x
//! and does not change the pressure, which is exact for like bodies. Limiting cases: Hertz' contact without wear; the worn volume is k F s on either
//! side.

mod error;
mod field;
mod jump;
mod lattice;
mod record;
mod run;
mod scene;
mod sliding;
mod surface;

pub use error::PointError;
pub use record::{DepthMap, PointCycle, PointOutcome, PointSummary};
pub use run::run;
pub use scene::{PointAccuracy, PointBody, PointScene};
