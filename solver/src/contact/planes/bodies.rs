//! Two extruded bodies in contact, and their displacement.

use crate::condensation::ExtrudedOperators;
use crate::model::Interface;

/// Two extruded bodies: operators, laws, and the shares of the planes in the width, whose sum is 1.
#[derive(Debug, Clone, Copy)]
pub struct Extruded<'a> {
    /// Condensed bodies.
    pub operators: &'a ExtrudedOperators,
    /// Friction, wear, mean line load.
    pub interface: Interface,
    /// Share of each plane.
    pub shares: &'a [f64],
}

/// Displacement of one increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// Displacement of the slider at its end, mm.
    pub slider_x: f64,
    /// Number of equal slips that each slip represents in the wear.
    pub cycles: f64,
}
