//! When a run does what: increments of a cycle, physical cycles of a computed one, and where it ends. The run and the
//! forecast follow the same schedule.

pub(crate) mod attempts;
pub(crate) mod equivalent_wear;
pub mod increments;
pub mod jump;
pub(crate) mod mission;
pub(crate) mod mission_state;
pub mod plan;
pub(crate) mod replay;
pub(crate) mod step;
pub mod stops;
pub(crate) mod stroke;
pub(crate) mod turning_steps;
