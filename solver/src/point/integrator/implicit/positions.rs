//! Positions of the slider at which the contacts of a cycle are solved.
//!
//! A cycle on fixed shapes that are alike on both sides of the middle has mirrored contacts at mirrored positions, and the same ones in both
//! passes. A position is a part of the stroke from the neutral place to a turning point, with the path on both sides and in both passes: 4 A in
//! all, with the amplitude A.
//!
//! The contact has one pressure in a part, at each cell that the slider passes there. Its gap is the mean of theirs by their paths, so that the
//! pressures are those of least energy among fewer, and leave no ripples of the length of a part. Parts are longer where the groove of a long
//! stroke is even (`closed_form::stroke_parts`).

use std::ops::Range;

use crate::closed_form::StrokeParts;
use crate::number::{count_at_least, nearest, real};
use crate::point::lattice::Lattice;
use crate::sides::Sides;

/// A place of the slider, and the path in mm that it stands for in a cycle together with its mirrored one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Position of the slider, cells from its leftmost one.
    pub(super) slider: usize,
    /// First rows of the window on both bodies.
    pub(super) rows: Sides<usize>,
    /// Offsets of the window from the middles of both bodies, cells.
    pub(super) offsets: Sides<f64>,
    pub(super) path: f64,
}

/// Places that have one pressure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JumpPosition {
    pub(super) places: Vec<Place>,
    /// Path of all of them, mm.
    pub(super) path: f64,
}

impl JumpPosition {
    /// All places, with the path of each over that of all.
    pub(super) fn weights(&self) -> impl Iterator<Item = (&Place, f64)> {
        let places = self.places.iter();
        places.map(|place| (place, place.path / self.path))
    }
}

/// Positions of a lattice, with parts in cells.
pub(super) fn positions(lattice: &Lattice, parts: StrokeParts) -> Vec<JumpPosition> {
    let amplitude = lattice.amplitude;
    let length = parts.length.max(1.0);
    let parts = StrokeParts { length, ..parts };
    let intervals = count_at_least(real(amplitude) / length).min(amplitude);
    let at = |number: usize| (amplitude * number + intervals / 2) / intervals;
    // Where the path about an end of an interval begins, cells from the neutral place.
    let begin = |number: usize| match number {
        0 => 0.0,
        number if number > intervals => real(amplitude),
        number => 0.5 * real(at(number - 1) + at(number)),
    };
    let mut positions = Vec::new();
    let mut rest = intervals + 1;
    while rest > 0 {
        let last = rest - 1;
        let together = parts.lengths(real(amplitude - at(last)));
        let first = rest - together.min(rest);
        positions.push(JumpPosition::of(lattice, begin(first)..begin(rest)));
        rest = first;
    }
    positions.reverse();
    positions
}

impl JumpPosition {
    /// A part of the stroke, in cells from the neutral place.
    fn of(lattice: &Lattice, part: Range<f64>) -> Self {
        let cells = nearest(part.start)..nearest(part.end) + 1;
        let places = cells.filter_map(|cell| {
            let start = part.start.max(real(cell) - 0.5);
            let end = part.end.min(real(cell) + 0.5);
            (end > start).then(|| Place::of(lattice, cell, end - start))
        });
        let places: Vec<Place> = places.collect();
        Self {
            path: places.iter().map(|place| place.path).sum(),
            places,
        }
    }
}

impl Place {
    /// So many cells from the neutral position, with the path of a number of cells to either side and in both passes.
    fn of(lattice: &Lattice, cell: usize, cells: f64) -> Self {
        let slider = lattice.amplitude + cell;
        let rows = Sides::from_fn(|side| lattice.first_row(side, slider));
        Self {
            slider,
            rows,
            offsets: Sides::from_fn(|side| lattice.offset_mm(side, slider) / lattice.size_mm.0),
            path: 4.0 * lattice.size_mm.0 * cells,
        }
    }
}
