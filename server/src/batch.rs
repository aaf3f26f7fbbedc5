//! Many jobs of one question: parameter sweeps and studies of accuracy.

pub mod accuracy;
pub mod outcomes;
pub mod sweep;
