//! Criteria: how far a contact wears until a run, or a life, ends.

use crate::sides::Side;

/// A criterion: a part of a scar is worn to a depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Criterion {
    /// The side that wears.
    pub side: Side,
    /// Part of the scar's length that is at least as deep, -; 0 for its deepest point, below 1 because a scar has no depth at its
    /// ends.
    pub part: f64,
    /// The depth, mm.
    pub depth_mm: f64,
}

impl Criterion {
    /// The deepest point of a side has reached a depth, mm.
    pub const fn deepest(side: Side, depth_mm: f64) -> Self {
        Self {
            side,
            part: 0.0,
            depth_mm,
        }
    }
}
