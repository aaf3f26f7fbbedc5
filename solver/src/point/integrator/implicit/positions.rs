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
use crate::sides::{Side, Sides};

/// A place of the slider, and the path in mm that it stands for in a cycle together with its mirrored one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Position of the slider, cells from its leftmost one.
    pub(super) slider: usize,
    /// Offsets of the window from the middles of both bodies, cells.
    pub(super) offsets: Sides<f64>,
    pub(super) path: f64,
}

/// Rows of a body under the window, and the path in mm that they are there for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stay {
    pub(super) first_row: usize,
    pub(super) path: f64,
}

/// Places that have one pressure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JumpPosition {
    pub(super) places: Vec<Place>,
    /// The same by the rows of each body: one stay of a slider on a flat, whose contact does not move on it.
    pub(super) stays: Sides<Vec<Stay>>,
    /// Path of all of them, mm.
    pub(super) path: f64,
}

impl JumpPosition {
    /// All places, with the path of each over that of all.
    pub(super) fn weights(&self) -> impl Iterator<Item = (&Place, f64)> {
        let places = self.places.iter();
        places.map(|place| (place, place.path / self.path))
    }

    /// All stays on a side, with the path of each over that of all.
    pub(super) fn stays(&self, side: Side) -> impl Iterator<Item = (usize, f64)> {
        let stays = self.stays.of(side).iter();
        stays.map(|stay| (stay.first_row, stay.path / self.path))
    }
}

/// Positions of a lattice, with parts in cells.
pub(super) fn positions(lattice: &Lattice, parts: StrokeParts) -> Vec<JumpPosition> {
    let amplitude = lattice.amplitude;
    let length = parts.length.max(1.0);
    let parts = StrokeParts { length, ..parts };
    let intervals = count_at_least(real(amplitude) / length).min(amplitude);
    let at = |number: f64| real(amplitude) * number / real(intervals);
    // Where the path about an end of an interval begins, cells from the neutral place.
    let begin = |number: usize| match number {
        0 => 0.0,
        number if number > intervals => real(amplitude),
        number => at(real(number) - 0.5),
    };
    let mut positions = Vec::new();
    let mut rest = intervals + 1;
    while rest > 0 {
        let last = rest - 1;
        let together = parts.lengths(real(amplitude) - at(real(last)));
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
            stays: Sides::from_fn(|side| stays(lattice, side, &places)),
            path: places.iter().map(|place| place.path).sum(),
            places,
        }
    }
}

/// Stays of the window on a side.
fn stays(lattice: &Lattice, side: Side, places: &[Place]) -> Vec<Stay> {
    let mut stays: Vec<Stay> = Vec::new();
    for Place { slider, path, .. } in places {
        let first_row = lattice.first_row(side, *slider);
        match stays.last_mut() {
            Some(last) if last.first_row == first_row => last.path += path,
            _ => stays.push(Stay {
                first_row,
                path: *path,
            }),
        }
    }
    stays
}

impl Place {
    /// So many cells from the neutral position, with the path of a number of cells to either side and in both passes.
    fn of(lattice: &Lattice, cell: usize, cells: f64) -> Self {
        let slider = lattice.amplitude + cell;
        Self {
            slider,
            offsets: Sides::from_fn(|side| lattice.offset_mm(side, slider) / lattice.size_mm.0),
            path: 4.0 * lattice.size_mm.0 * cells,
        }
    }
}
