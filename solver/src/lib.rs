#![doc = include_str!("../README.md")]

pub mod ale;
pub mod checkpoint;
pub mod condensation;
pub mod contact;
pub mod cycle;
pub mod effects;
pub mod element;
mod error;
pub mod fields;
pub mod friction;
pub mod interpolation;
pub mod linear;
pub mod material;
pub mod mesh;
pub mod model;
mod number;
pub mod observer;
pub mod record;
pub mod run;
pub mod scene;
pub mod wear;

pub use error::SolveError;
