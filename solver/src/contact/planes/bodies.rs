//! Two extruded bodies in contact, and their displacement.

use super::super::line::{Pair, WarmStart};
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

impl<'a> Extruded<'a> {
    /// The pair of bodies that is paired alike in all planes.
    pub(super) fn pair(&self) -> Pair<'a> {
        Pair {
            operators: &self.operators.sections,
            interface: self.interface,
        }
    }
}

/// Displacement of one increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slide<'a> {
    /// Displacement of the slider at its end, mm.
    pub slider_x: f64,
    /// Number of equal slips that each slip represents in the wear.
    pub cycles: f64,
    /// Where the iteration starts in each plane; the last contacts, moved with the slider, if it is absent.
    pub starts: Option<&'a [WarmStart<'a>]>,
}
