//! Response of one zone of a contact surface. Nodes are numbered along the whole surface of the body.

use std::ops::Range;

use super::compliance::{Compliance, Response};
use crate::linear::Hodlr;
use std::sync::OnceLock;

/// The response of a mesh that is fine along some of the contact nodes.
#[derive(Debug, Clone)]
pub struct ZoneOperators {
    /// First contact node of the zone.
    first: usize,
    /// Displacements of its nodes per force at them.
    compliance: Compliance,
    /// The same, compressed when a wide contact first asks for it.
    compressed: OnceLock<Hodlr>,
    /// Displacement of its surface unknowns per unit of normal load on the far face, mm per N/mm; zero where the far
    /// face is held.
    load_response: Vec<f64>,
}

impl ZoneOperators {
    /// Operators of a zone whose first contact node is `first`.
    pub(super) fn new(first: usize, compliance: Compliance, load_response: Vec<f64>) -> Self {
        Self {
            first,
            compliance,
            compressed: OnceLock::new(),
            load_response,
        }
    }

    /// Contact nodes.
    pub fn nodes(&self) -> Range<usize> {
        self.first..self.first + self.compliance.nodes()
    }

    /// The response of a range of its nodes to a force at one of them.
    pub(crate) fn to_force_at(&self, node: usize, of: &Range<usize>) -> Response<'_> {
        let of = of.start - self.first..of.end - self.first;
        self.compliance.to_force_at(node - self.first, &of)
    }

    /// Adds to the displacements of some of its nodes (x, y of each) those by forces at others, in an effort that grows little more
    /// than linearly with their number.
    pub(crate) fn add_displacements(
        &self,
        from: &Range<usize>,
        forces: &[f64],
        of: &Range<usize>,
        displacements: &mut [f64],
    ) {
        let compressed = self.compressed.get_or_init(|| self.compliance.compressed());
        let unknowns =
            |nodes: &Range<usize>| 2 * (nodes.start - self.first)..2 * (nodes.end - self.first);
        compressed.add_product(&unknowns(from), forces, &unknowns(of), displacements);
    }

    /// Displacement of surface unknown `row` = 2 i + d per force at unknown `column` = 2 j + e, mm per N/mm.
    pub fn compliance(&self, row: usize, column: usize) -> f64 {
        let first = 2 * self.first;
        self.compliance.get(row - first, column - first)
    }

    /// Displacement of one of its nodes per unit of normal load on the far face, mm per N/mm.
    pub(crate) fn under_load(&self, node: usize) -> [f64; 2] {
        let at = 2 * (node - self.first);
        [self.load_response[at], self.load_response[at + 1]]
    }

    /// Nodes between a range and the nearer end of the zone; none if it is not within the zone.
    pub(super) fn clearance(&self, range: &Range<usize>, surface: usize) -> Option<usize> {
        clearance(&self.nodes(), range, surface)
    }
}

/// Nodes between a range and the nearer end of a zone of these nodes, on a surface of so many; none if it is not within the zone.
pub(super) fn clearance(
    nodes: &Range<usize>,
    range: &Range<usize>,
    surface: usize,
) -> Option<usize> {
    let left = range.start.checked_sub(nodes.start)?;
    let right = nodes.end.checked_sub(range.end)?;
    // Beyond the end of the surface nothing is missing.
    let left = if nodes.start == 0 { usize::MAX } else { left };
    let right = if nodes.end == surface {
        usize::MAX
    } else {
        right
    };
    Some(left.min(right))
}
