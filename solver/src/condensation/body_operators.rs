//! A body as seen from its contact surface.

use std::ops::Range;

use super::zone_operators::ZoneOperators;
use crate::model::Profile;
use crate::sides::Sides;

/// Condensed operators of both bodies.
pub type Operators = Sides<BodyOperators>;

/// One body seen from its contact surface.
#[derive(Debug, Clone)]
pub struct BodyOperators {
    /// Places of the contact nodes in the body's frame, mm, ascending.
    pub x: Vec<f64>,
    /// Length of surface that belongs to each node, projected on x, mm.
    pub widths: Vec<f64>,
    /// The unworn surface.
    pub profile: Profile,
    /// Responses of the surface, zone by zone.
    pub zones: Vec<ZoneOperators>,
}

impl BodyOperators {
    /// The zone in whose interior a range of contact nodes lies farthest; none if it is wider than each.
    pub fn zone(&self, range: &Range<usize>) -> Option<&ZoneOperators> {
        self.zone_number(range).map(|zone| &self.zones[zone])
    }

    /// Number of the same zone.
    pub(crate) fn zone_number(&self, range: &Range<usize>) -> Option<usize> {
        let clearances = self.zones.iter().enumerate().filter_map(|(number, zone)| {
            let clearance = zone.clearance(range, self.x.len())?;
            Some((clearance, number))
        });
        // Of equals the first.
        let best = clearances.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, number)| number)
    }
}
