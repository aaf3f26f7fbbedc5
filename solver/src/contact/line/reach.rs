//! What the master's nodes take of a slave node's path where their wear rates differ, as those of a plating that is worn through in places.
//!
//! Constraints see means of the master's depths, with weights that are negative beyond two thirds of an element (`mortar`). Beside a node that
//! is through to a base of 260 times the rate its neighbours would stand proud unseen while it digs a hole that nothing could reach, and one of
//! negative weight would raise the pressure that it wears by. What a node of the slave shares its path with is what it touches: a node that is
//! deeper than the mean of the slave's place by more than the bodies deform takes nothing, nor does one that wears faster than the others and is seen
//! with less than half of its share. The others take its part.

use super::geometry::Geometry;
use super::mortar::Coupling;
use super::pair::{Pair, Surfaces};
use crate::law::dose::DoseCurve;

/// Depths below the mean over the indentation at which a node begins to lose its part, and has none. The first is above what curved surfaces differ
/// by between their nodes.
const REACHED: f64 = 1.0;
const OUT_OF_REACH: f64 = 2.0;

/// Rate of a node over the mean of a row from which on it wears faster than the others. Arbitrary.
const FASTER: f64 = 3.0;
/// Weight in the mean over the share with which it must be seen then.
const SEEN: f64 = 0.5;
/// Depth over the present one down to which the rate of a node counts: that of what an increment may bring to light.
const AHEAD: f64 = 1.25;

/// Buffers of the shares.
#[derive(Debug, Default)]
pub(super) struct Reach {
    /// Of the master's nodes in the range: the part within reach, and the wear rate.
    reached: Vec<f64>,
    rate: Vec<f64>,
    row: Vec<f64>,
}

impl Reach {
    /// Shares the path among the master's nodes that a contact of an indentation in mm reaches, worn by a dose.
    pub(super) fn share(
        &mut self,
        geometry: &mut Geometry,
        (pair, surfaces): (&Pair<'_>, &Surfaces<'_>),
        pairing_x: f64,
        (curve, indentation): (&DoseCurve, f64),
    ) {
        let (begin, end) = geometry.coupling.master_range;
        let depths = &surfaces.depth.of(pair.interface.slave.other())[begin..end];
        self.rate.clear();
        self.rate
            .extend(depths.iter().map(|depth| curve.largest_rate(AHEAD * depth)));
        let first = self.rate.first().copied();
        if first.is_none_or(|first| {
            self.rate
                .iter()
                .all(|rate| *rate <= first && *rate >= first)
        }) {
            return;
        }
        self.find_reached(&geometry.coupling, (pair, surfaces), pairing_x, indentation);
        let coupling = &geometry.coupling;
        let means: Vec<f64> = (coupling.first..coupling.end)
            .map(|l| {
                let (from, shares) = coupling.standard_row(l);
                let rates = self.rate[from - begin..].iter().zip(shares);
                let (sum, whole) = rates.fold((0.0, 0.0), |(sum, whole), (rate, share)| {
                    (sum + rate * share, whole + share)
                });
                sum / whole
            })
            .collect();
        let (first, rate, reached) = (coupling.first, &self.rate, &self.reached);
        let part = |l: usize, j: usize, [share, weight]: [f64; 2]| {
            let is_fast = rate[j - begin] > FASTER * means[l - first];
            if is_fast && weight < SEEN * share {
                0.0
            } else {
                reached[j - begin]
            }
        };
        geometry.coupling.share_by(part, &mut self.row);
    }

    /// The parts of the master's nodes that are within reach.
    fn find_reached(
        &mut self,
        coupling: &Coupling,
        (pair, surfaces): (&Pair<'_>, &Surfaces<'_>),
        pairing_x: f64,
        indentation: f64,
    ) {
        let slave = pair.interface.slave;
        let (own, other) = (surfaces.depth.of(slave), surfaces.depth.of(slave.other()));
        let (x, offset) = (&pair.slave().x, pair.offset(pairing_x));
        let (begin, end) = coupling.master_range;
        let mean = |i: usize| mean_gap(coupling, (own, other), i);
        let mut right = coupling.first + 1;
        self.reached.clear();
        if right >= coupling.end {
            self.reached.resize(end - begin, 1.0);
            return;
        }
        self.reached.extend((begin..end).map(|j| {
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
    }
}

/// Gap of the worn, undeformed bodies at height 0 as a node of the slave sees it, mm.
fn mean_gap(coupling: &Coupling, (own, other): (&[f64], &[f64]), i: usize) -> f64 {
    let (from, weights) = coupling.dual_row(i);
    let worn = weights.iter().zip(&other[from..]);
    let worn: f64 = worn.map(|(weight, depth)| weight * depth).sum();
    coupling.gap[i - coupling.first] + own[i] + worn
}
