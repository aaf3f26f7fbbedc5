//! Zones of a surface: a contact that travels far needs fine elements under it, not along the whole way at once.
//!
//! ```text
//!   contact nodes   ..........................................
//!   zone 0          ............  .  .   .     .        .    .
//!   zone 1          .    .   . ............ .  .   .    .    .
//!   zone 2          .    .        .     .   .  . .............
//! ```
//! Each zone is a mesh of the whole body that is fine along some of the contact nodes and coarsens away from them. Only
//! its fine nodes are retained by condensation, so that the work grows with the travel, not with its cube. Zones
//! overlap by the widest contact: any contact lies within one of them, and its response is that of one mesh. The worn
//! depth lives on all contact nodes and knows no zone.

use crate::number::{count_at_least, real};

/// Most contact nodes that one mesh takes. Arbitrary: the condensation of 700 nodes costs as much as a few hundred
/// increments.
const MOST_NODES: usize = 700;
/// Nodes beside a contact: candidates, and those of the neighbours' meshes. Arbitrary: a contact that needs more has wider
/// zones.
const MARGIN_NODES: usize = 16;
/// Growth of elements away from a zone.
const OUTER_GROWTH: f64 = 1.25;
/// Factor by which zones become wider where a contact has outgrown them.
pub(crate) const ZONE_WIDENING: f64 = 2.0;

/// Spines of the mesh of one zone.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Numbers of its spines among those of the body, ascending.
    pub spines: Vec<usize>,
    /// Spines whose surface nodes are retained, among `spines`: first and one past the last.
    pub contact: (usize, usize),
}

impl Zone {
    /// A mesh of all spines of a body.
    fn whole(spines: usize, contact: (usize, usize)) -> Self {
        Self {
            spines: (0..spines).collect(),
            contact,
        }
    }

    /// Number of retained nodes.
    pub fn nodes(&self) -> usize {
        self.contact.1 - self.contact.0
    }

    /// The first retained spine among those of the body.
    pub fn first(&self) -> usize {
        self.spines[self.contact.0]
    }
}

/// Sizing parameters of zones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZoneSizes {
    /// Half-width of the widest expected contact, mm.
    pub half_width: f64,
    /// Nodes of a zone over those of that contact.
    pub width: f64,
    /// Fewest nodes of a zone.
    pub fewest: f64,
    /// Largest element away from a zone, mm.
    pub largest: f64,
}

/// Divides the spines `contact` of a body at `x` into zones.
pub(super) fn divide(x: &[f64], contact: (usize, usize), sizes: ZoneSizes) -> Vec<Zone> {
    let nodes = contact.1 - contact.0;
    if nodes <= MOST_NODES {
        return vec![Zone::whole(x.len(), contact)];
    }
    let widest = MARGIN_NODES + widest_contact(&x[contact.0..contact.1], sizes.half_width);
    let size = count_at_least((sizes.width * real(widest)).max(sizes.fewest));
    if 2 * size > nodes {
        return vec![Zone::whole(x.len(), contact)];
    }
    let overlap = widest.min(size / 2);
    let count = (nodes - size).div_ceil(size - overlap) + 1;
    let last = contact.1 - size;
    let begin = |zone: usize| contact.0 + (last - contact.0) * zone / (count - 1);
    (0..count)
        .map(|zone| around(x, (begin(zone), begin(zone) + size), sizes.largest))
        .collect()
}

/// Most nodes within a length of two half-widths.
fn widest_contact(x: &[f64], half_width: f64) -> usize {
    let mut end = 0;
    let mut most = 1;
    for (begin, &left) in x.iter().enumerate() {
        while end < x.len() && x[end] <= left + 2.0 * half_width {
            end += 1;
        }
        most = most.max(end - begin);
    }
    most
}

/// The zone that retains the spines `first..end`, with ever longer steps from one spine to the next outside of them.
fn around(x: &[f64], (first, end): (usize, usize), largest: f64) -> Zone {
    let mut left = outward(x[..=first].iter().rev().copied(), largest);
    left.reverse();
    let contact = (left.len(), left.len() + end - first);
    let left = left.into_iter().map(|step| first - step);
    let right = outward(x[end - 1..].iter().copied(), largest);
    let right = right.into_iter().map(|step| end - 1 + step);
    Zone {
        spines: left.chain(first..end).chain(right).collect(),
        contact,
    }
}

/// Numbers of the places to take from a line, its first being taken already: each step is longer than the one before by
/// the growth, up to the largest, and the last place is taken.
fn outward(line: impl Iterator<Item = f64>, largest: f64) -> Vec<usize> {
    let line: Vec<f64> = line.collect();
    let distance = |from: usize, to: usize| (line[to] - line[from]).abs();
    let last = line.len() - 1;
    let mut taken = Vec::new();
    let (mut at, mut step) = (0, 0.0);
    while at < last {
        let least = (OUTER_GROWTH * step).min(largest);
        let next = (at + 1..last).find(|&to| distance(at, to) >= least);
        // A rest shorter than half a step is part of the last one.
        at = next
            .filter(|&to| distance(to, last) >= 0.5 * least)
            .unwrap_or(last);
        let from = taken.last().copied().unwrap_or(0);
        step = distance(from, at);
        taken.push(at);
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(nodes: usize) -> Vec<f64> {
        (0..nodes).map(|i| 0.5 * real(i)).collect()
    }

    fn sizes(half_width: f64) -> ZoneSizes {
        ZoneSizes {
            half_width,
            width: 2.0,
            fewest: 240.0,
            largest: 100.0,
        }
    }

    #[test]
    fn a_short_surface_is_one_zone() {
        let zones = divide(&line(MOST_NODES), (0, MOST_NODES), sizes(2.0));
        assert_eq!(zones, [Zone::whole(MOST_NODES, (0, MOST_NODES))]);
    }

    #[test]
    fn any_contact_of_the_expected_width_lies_within_a_zone() {
        let x = line(5_000);
        let half_width = 30.0;
        let zones = divide(&x, (3, 4_990), sizes(half_width));
        assert!(zones.len() > 5);
        let contact = widest_contact(&x, half_width);
        for first in 3..4_990 - contact {
            let holds = |zone: &Zone| {
                zone.first() <= first && first + contact <= zone.first() + zone.nodes()
            };
            assert!(zones.iter().any(holds), "{first}");
        }
    }

    #[test]
    fn spines_coarsen_away_from_a_zone_and_reach_both_ends() {
        let x = line(5_000);
        for zone in divide(&x, (0, 5_000), sizes(5.0)) {
            assert_eq!(
                (zone.spines[0], *zone.spines.last().unwrap_or(&0)),
                (0, 4_999)
            );
            assert!(zone.spines.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(zone.spines.len() < zone.nodes() + 110);
            let steps: Vec<f64> = zone.spines.windows(2).map(|w| x[w[1]] - x[w[0]]).collect();
            let grows =
                |pair: &[f64]| pair[1] < 2.0 * pair[0] + 0.5 && pair[0] < 2.0 * pair[1] + 0.5;
            let inner = &steps[1..steps.len() - 1];
            assert!(inner.windows(2).all(grows), "{steps:?}");
        }
    }
}
