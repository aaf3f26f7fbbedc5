//! Nodes whose doses are unknown.

use crate::sides::{Side, Sides};

/// Marks a node that is no unknown.
const NONE: usize = usize::MAX;

/// Numbers of the nodes whose doses are unknown.
#[derive(Debug, Default)]
pub(crate) struct DoseUnknowns {
    number: Sides<Vec<usize>>,
    /// Side and node of each unknown.
    pub(crate) nodes: Vec<(Side, usize)>,
}

impl DoseUnknowns {
    /// Resets to none of so many nodes of each side.
    pub(crate) fn reset(&mut self, nodes: Sides<usize>) {
        self.nodes.clear();
        for side in Side::BOTH {
            let number = self.number.of_mut(side);
            number.clear();
            number.resize(*nodes.of(side), NONE);
        }
    }

    pub(super) fn insert(&mut self, side: Side, node: usize) {
        let number = &mut self.number.of_mut(side)[node];
        if *number == NONE {
            *number = self.nodes.len();
            self.nodes.push((side, node));
        }
    }

    /// Numbers the unknowns of a side first, in their order along the surface.
    pub(crate) fn number_first(&mut self, side: Side) {
        self.nodes.sort_by_key(|(of, node)| (*of != side, *node));
        for (number, (side, node)) in self.nodes.iter().enumerate() {
            self.number.of_mut(*side)[*node] = number;
        }
    }

    /// Number of unknowns of a side.
    pub(crate) fn count(&self, side: Side) -> usize {
        self.nodes.iter().filter(|(of, _)| *of == side).count()
    }

    /// Returns `true` if the dose of a node is unknown.
    pub(crate) fn contains(&self, side: Side, node: usize) -> bool {
        self.of(side, node).is_some()
    }

    pub(super) fn of(&self, side: Side, node: usize) -> Option<usize> {
        let number = self.number.of(side)[node];
        (number != NONE).then_some(number)
    }
}
