//! Shares of the master's nodes in a slave node's path where their wear rates differ, as those of a plating that is worn through in places.
//!
//! Constraints see means of the master's depths. Where each node took its share of the path by its place alone, one that is through to a base of
//! 260 times the rate would dig a hole unseen while the nickel beside it carries the contact; dual means have negative weights, which let it dig the
//! faster. On the scale of an element the bodies conform: all that a node of the slave faces recedes together, p_j k_j = const. Each node of the
//! master then takes its share in proportion to 1/k_j, and the rate of the slave's node is their harmonic mean. Means have positive weights there.
//!
//! 1/k_j is that of a thickness which is worn next, so that the share of a node changes before its layer ends: the indentation, and what
//! a jump wears that is implicit in the worn shapes.
//! Planes of extruded bodies do without this.

use std::ops::Range;

use super::mortar::Coupling;
use super::pair::Pair;
use crate::law::dose::DoseCurve;
use crate::law::surface::SurfaceWear;

/// Ratio of wear rates within the support of a node of the slave from which the shares depend on them.
const CONTRAST: f64 = 2.0;
/// Dose that a surface takes which no dose wears, over that of its outermost layer. Arbitrary.
const UNWORN: f64 = 1e6;

/// Depths of the master's nodes, and the thicknesses that are worn next there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NextWorn<'a> {
    /// Depths, mm.
    pub(crate) depth: &'a [f64],
    pub(crate) thickness: Thickness<'a>,
}

/// Thicknesses that are worn next at the master's nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Thickness<'a> {
    /// One of all nodes, mm.
    Even(f64),
    /// One of each node, mm.
    OfNodes(&'a [f64]),
}

impl Thickness<'_> {
    /// The largest at some nodes, mm.
    fn largest(self, nodes: Range<usize>) -> f64 {
        match self {
            Self::Even(thickness) => thickness,
            Self::OfNodes(of) => of[nodes].iter().fold(0.0, |m: f64, of| m.max(*of)),
        }
    }
}

/// Shares paths by the resistance of the master's nodes to wear where it differs; only where a layer of the master wears faster than its
/// surface.
pub(super) fn share_by_resistance(coupling: &mut Coupling, pair: &Pair<'_>, next: NextWorn<'_>) {
    let master = pair.interface.slave.other();
    let wear = pair.interface.wear.of(master);
    let wear = wear.filter(|wear| wear.quickens());
    let Some(curve) = wear.and_then(SurfaceWear::dose_curve) else {
        return;
    };
    let depth = next.depth;
    for i in coupling.first..coupling.end {
        let (from, weights) = coupling.dual_row(i);
        let nodes = from..from + weights.len();
        let thickness = next.thickness.largest(nodes.clone());
        if thickness <= 0.0 {
            continue;
        }
        let depths = &depth[nodes];
        let least = depths.iter().map(|depth| curve.rate(*depth));
        let most = depths.iter().map(|depth| curve.rate(depth + thickness));
        if most.fold(0.0, f64::max) > CONTRAST * least.fold(f64::INFINITY, f64::min) {
            coupling.share_by(i, |j| resistance(&curve, depth[j], thickness));
        }
    }
}

/// Dose that wears a thickness below a depth, over that in the outermost layer.
fn resistance(curve: &DoseCurve, depth: f64, thickness: f64) -> f64 {
    if depth + thickness > curve.deepest() {
        return UNWORN;
    }
    (curve.equivalent(depth + thickness) - curve.equivalent(depth)) / thickness
}
