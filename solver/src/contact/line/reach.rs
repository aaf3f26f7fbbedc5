//! What the master's nodes take of a slave node's path where their wear rates differ, as those of a plating that is worn through in places.
//!
//! Constraints see means of the master's depths. Beside a node that is through to a base of 260 times the rate its neighbours would stand proud
//! unseen while it digs a hole that nothing could reach. What a node of the slave shares its path with is what it touches: a node that is
//! deeper than the mean of the slave's place by more than the bodies deform takes nothing, and the others take its part.
//!
//! Within an increment a node that is just through can still dig (`hard::beside_standing_plating` prints how deep); the stated error says so.
//! Planes of extruded bodies do without this.

use super::geometry::Geometry;
use super::mortar::Coupling;
use super::pair::{Pair, Surfaces};
use super::state::ContactState;
use crate::law::surface::SurfaceWear;

/// Depths below the mean over the indentation at which a node begins to lose its part, and has none. The first is above what curved surfaces differ
/// by between their nodes.
const REACHED: f64 = 1.0;
const OUT_OF_REACH: f64 = 2.0;

/// Takes the parts of the path from the master's nodes that are out of reach of the last contact, where a layer of the master wears faster than
/// its surface.
pub(super) fn share_among_reached(
    geometry: &mut Geometry,
    (pair, surfaces): (&Pair<'_>, &Surfaces<'_>),
    pairing_x: f64,
    (last, parts): (&ContactState, &mut Vec<f64>),
) {
    let wear = *pair.interface.wear.of(pair.interface.slave.other());
    let indentation = last.indentation;
    if indentation <= 0.0 || !wear.is_some_and(SurfaceWear::quickens) {
        return;
    }
    let coupling = &geometry.coupling;
    let slave = pair.interface.slave;
    let (own, other) = (surfaces.depth.of(slave), surfaces.depth.of(slave.other()));
    let (x, offset) = (&pair.slave().x, pair.offset(pairing_x));
    let (begin, end) = coupling.master_range;
    let mean = |i: usize| mean_gap(coupling, (own, other), i);
    let mut right = coupling.first + 1;
    if right >= coupling.end {
        return;
    }
    parts.clear();
    parts.extend((begin..end).map(|j| {
        let at = pair.master().x[j] + offset;
        while right + 1 < coupling.end && x[right] < at {
            right += 1;
        }
        let (a, b) = (right - 1, right);
        let share = ((at - x[a]) / (x[b] - x[a])).clamp(0.0, 1.0);
        let between = |left: f64, right: f64| left + share * (right - left);
        let gap = pair.unworn_gap(at, offset) + between(own[a], own[b]) + other[j];
        let deeper = (gap - between(mean(a), mean(b))) / indentation;
        ((OUT_OF_REACH - deeper) / (OUT_OF_REACH - REACHED)).clamp(0.0, 1.0)
    }));
    if parts.iter().any(|part| *part < 1.0) {
        geometry.coupling.share_among(parts);
    }
}

/// Gap of the worn, undeformed bodies at height 0 as a node of the slave sees it, mm.
fn mean_gap(coupling: &Coupling, (own, other): (&[f64], &[f64]), i: usize) -> f64 {
    let (from, weights) = coupling.dual_row(i);
    let worn = weights.iter().zip(&other[from..]);
    let worn: f64 = worn.map(|(weight, depth)| weight * depth).sum();
    coupling.gap[i - coupling.first] + own[i] + worn
}
