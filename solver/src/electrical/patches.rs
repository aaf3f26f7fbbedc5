//! Patches of a contact: parts of its length on which each side shows one metal, for depths that are linear between the nodes.

use serde::{Deserialize, Serialize};

use crate::interpolation;
use crate::scene::Metal;
use crate::sides::{Side, Sides};

/// A worn surface: its nodes in ascending order and their depths, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) depth: &'a [f64],
}

/// All of the contact on which the sides show these metals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Patch {
    /// The metal that each side shows, from the surface down.
    pub(super) metal: Sides<usize>,
    /// Part of the contact's length or area, -.
    pub(super) share: f64,
    /// Mean depth of each side, mm.
    pub(super) depth: Sides<f64>,
}

/// The patches of a contact between two places, mm; those of its middle where it has no length.
pub(super) fn patches(
    (from, to): (f64, f64),
    surfaces: Sides<Surface<'_>>,
    metals: &Sides<Vec<Metal>>,
) -> Vec<Patch> {
    let mut places = vec![from, to];
    for side in Side::BOTH {
        add_changes((from, to), *surfaces.of(side), metals.of(side), &mut places);
    }
    places.sort_by(f64::total_cmp);
    let length = to - from;
    let mut found: Vec<Patch> = Vec::new();
    for ends in places.windows(2) {
        let share = if length > 0.0 {
            (ends[1] - ends[0]) / length
        } else {
            1.0
        };
        if share <= 0.0 {
            continue;
        }
        let middle = 0.5 * (ends[0] + ends[1]);
        let depth = surfaces.map(|surface| interpolation::linear(surface.x, surface.depth, middle));
        add(&mut found, metals, share, depth);
    }
    found
}

/// The patches of cells in contact by the worn depths of both sides, mm.
pub(super) fn patches_of_cells(depths_mm: &[Sides<f64>], metals: &Sides<Vec<Metal>>) -> Vec<Patch> {
    let share = 1.0 / crate::number::real(depths_mm.len());
    let mut found = Vec::new();
    for depth in depths_mm {
        add(&mut found, metals, share, *depth);
    }
    found
}

/// Adds a part of the contact to the patch of its metals.
fn add(found: &mut Vec<Patch>, metals: &Sides<Vec<Metal>>, share: f64, depth: Sides<f64>) {
    let metal = Sides::from_fn(|side| exposed(metals.of(side), *depth.of(side)));
    let known = found.iter_mut().find(|patch| patch.metal == metal);
    match known {
        Some(patch) => patch.add(share, depth),
        None => found.push(Patch {
            metal,
            share,
            depth,
        }),
    }
}

impl Patch {
    fn add(&mut self, share: f64, depth: Sides<f64>) {
        let whole = self.share + share;
        for side in Side::BOTH {
            let mean = self.depth.of_mut(side);
            *mean += share / whole * (depth.of(side) - *mean);
        }
        self.share = whole;
    }
}

/// The metal at a depth, the lower one at an interface.
fn exposed(metals: &[Metal], depth: f64) -> usize {
    let above = metals.iter().take_while(|metal| depth >= metal.bottom_mm);
    above.count().min(metals.len().saturating_sub(1))
}

/// Adds the places in a range at which the slope of a surface or its metal changes.
fn add_changes(
    (from, to): (f64, f64),
    surface: Surface<'_>,
    metals: &[Metal],
    places: &mut Vec<f64>,
) {
    let is_inside = |place: &f64| from < *place && *place < to;
    places.extend(surface.x.iter().filter(|place| is_inside(place)));
    let elements = surface.x.windows(2).zip(surface.depth.windows(2));
    let reached = elements.filter(|(x, _)| x[1] > from && x[0] < to);
    for (x, depth) in reached {
        let crossings = metals.iter().filter_map(|metal| {
            let (before, after) = (metal.bottom_mm - depth[0], metal.bottom_mm - depth[1]);
            let crosses = before * after < 0.0 && metal.bottom_mm.is_finite();
            crosses.then(|| x[0] + (x[1] - x[0]) * before / (before - after))
        });
        places.extend(crossings.filter(is_inside));
    }
}
