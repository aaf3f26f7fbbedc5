//! Inputs that a scene lacks.

use serde::{Deserialize, Serialize};

use crate::sides::Sides;

/// Input that a scene lacks for an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MissingInput {
    /// Thermal conductivities of materials.
    Conductivity,
    /// Melting temperatures of materials of the sides that are true.
    MeltingTemperature(Sides<bool>),
    /// A property of the contact as an electrical conductor.
    Conductor(MissingProperty),
}

/// Property of the contact as an electrical conductor that is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MissingProperty {
    /// All of them.
    All,
    /// The force on the contact.
    Force,
    /// Resistivity of a material.
    Resistivity,
    /// Hardness of a material.
    Hardness,
}
