//! Positions of the slider at which the contacts of a cycle are solved.
//!
//! A cycle on fixed shapes that are alike on both sides of the middle has mirrored contacts at mirrored positions, and the same ones in both
//! passes. The positions are those from the neutral one to a turning point, each with the path of the trapezoidal rule on both sides
//! and in both passes: 4 A in all, with the amplitude A.

use crate::number::{count_at_least, real};
use crate::point::lattice::Lattice;
use crate::sides::Sides;

/// A position, and the path in mm that it stands for in a cycle together with its mirrored one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JumpPosition {
    /// Position of the slider, cells from its leftmost one.
    pub(super) slider: usize,
    /// First rows of the window on both bodies.
    pub(super) rows: Sides<usize>,
    /// Offsets of the window from the middles of both bodies, cells.
    pub(super) offsets: Sides<f64>,
    pub(super) path: f64,
}

/// Positions of a lattice that are at most so many cells apart.
pub(super) fn positions(lattice: &Lattice, most_cells: f64) -> Vec<JumpPosition> {
    let amplitude = lattice.amplitude;
    let intervals = count_at_least(real(amplitude) / most_cells.max(1.0)).min(amplitude);
    let at = |number: usize| (amplitude * number + intervals / 2) / intervals;
    let position = |number: usize| {
        let (before, after) = (
            at(number.saturating_sub(1)),
            at((number + 1).min(intervals)),
        );
        let slider = amplitude + at(number);
        let rows = Sides::from_fn(|side| lattice.first_row(side, slider));
        JumpPosition {
            slider,
            rows,
            offsets: Sides::from_fn(|side| lattice.offset_mm(side, slider) / lattice.size_mm.0),
            path: 2.0 * lattice.size_mm.0 * real(after - before),
        }
    };
    (0..=intervals).map(position).collect()
}
