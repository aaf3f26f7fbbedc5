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

    /// Returns `true` if the dose of a node is unknown.
    pub(crate) fn contains(&self, side: Side, node: usize) -> bool {
        self.of(side, node).is_some()
    }

    pub(super) fn of(&self, side: Side, node: usize) -> Option<usize> {
        let number = self.number.of(side)[node];
        (number != NONE).then_some(number)
    }
}
