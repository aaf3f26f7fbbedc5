#![doc = include_str!("../README.md")]

pub mod ale;
pub mod along_line;
mod change;
pub mod checkpoint;
pub mod closed_form;
pub mod condensation;
pub mod contact;
pub mod cycle;
pub mod effects;
pub mod electrical;
pub mod element;
mod error;
pub mod error_control;
pub mod extruded;
pub mod fields;
pub mod forecast;
pub mod interpolation;
pub mod law;
mod linear;
pub mod mesh;
pub mod model;
mod number;
pub mod observer;
pub mod point;
pub mod record;
pub mod resolution;
pub mod run;
pub mod scene;
pub mod schedule;
pub mod sides;
pub mod station;
mod threads;

pub use error::SolveError;

// The suite names the engine as other crates do, and reaches what is private.
#[cfg(test)]
extern crate self as solver;
#[cfg(test)]
#[path = "../tests/verification.rs"]
mod verification;
