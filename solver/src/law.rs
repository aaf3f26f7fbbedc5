//! Constitutive laws. A law knows no mesh: it takes a local state and returns a value with its derivatives.

pub mod dose;
pub(crate) mod dose_laws;
pub mod elastic;
pub mod friction;
pub(crate) mod heating;
pub mod pace;
pub mod plating;
pub mod resistance;
pub mod skin_effect;
pub mod softening;
pub mod surface;
pub mod temperature;
pub mod wear;
