//! Partition of the coupled nodes: whose pressures are solved for, and which of them may change their status without another factorisation.
//!
//! From one iteration to the next statuses change at the edges of the contacts of the planes. The nodes there are the border of the condensed
//! system, closed nodes elsewhere its core, as in `contact::line`.

/// Nodes on either side of an edge that belong to the border.
const EDGE: usize = 1;

/// Block of the system that a coupled node belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SystemBlock {
    /// Open.
    Outside,
    /// Closed.
    Core,
    /// Open or closed.
    Border,
}

/// The unknowns of the system.
#[derive(Debug, Default)]
pub(super) struct Partition {
    /// Nodes of the core, then those of the border.
    pub(super) nodes: Vec<usize>,
    /// Number of nodes of the core.
    pub(super) core: usize,
    blocks: Vec<SystemBlock>,
}

impl Partition {
    /// Chooses the unknowns for the statuses of planes of so many nodes each.
    pub(super) fn choose(&mut self, is_closed: &[bool], nodes_of_plane: usize) {
        self.blocks.clear();
        for plane in is_closed.chunks_exact(nodes_of_plane) {
            self.blocks.extend((0..plane.len()).map(|i| {
                let near = &plane[i.saturating_sub(EDGE)..(i + EDGE + 1).min(plane.len())];
                let closed = near.iter().filter(|closed| **closed).count();
                match closed {
                    0 => SystemBlock::Outside,
                    all if all == near.len() => SystemBlock::Core,
                    _ => SystemBlock::Border,
                }
            }));
        }
        let blocks = &self.blocks;
        let of = |block: SystemBlock| {
            let nodes = blocks
                .iter()
                .enumerate()
                .filter(move |(_, own)| **own == block);
            nodes.map(|(node, _)| node)
        };
        self.nodes.clear();
        self.nodes.extend(of(SystemBlock::Core));
        self.core = self.nodes.len();
        self.nodes.extend(of(SystemBlock::Border));
    }

    /// Returns `true` if the unknowns allow statuses.
    pub(super) fn admits(&self, is_closed: &[bool]) -> bool {
        let admits = |(block, closed): (&SystemBlock, &bool)| match *block {
            SystemBlock::Outside => !closed,
            SystemBlock::Core => *closed,
            SystemBlock::Border => true,
        };
        self.blocks.len() == is_closed.len() && self.blocks.iter().zip(is_closed).all(admits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_of_each_plane_may_change() {
        let mut is_closed = [false; 16];
        is_closed[2..8].fill(true);
        is_closed[9..12].fill(true);
        let mut partition = Partition::default();
        partition.choose(&is_closed, 8);
        // The first plane ends with the coupled nodes, not with the contact: nodes 3 to 7, then 10.
        assert_eq!(partition.nodes[..partition.core], [3, 4, 5, 6, 7, 10]);
        assert_eq!(partition.nodes[partition.core..], [1, 2, 8, 9, 11, 12]);
        assert!(partition.admits(&is_closed));
        for (node, admitted) in [(1, true), (2, true), (5, false), (8, true), (14, false)] {
            let mut changed = is_closed;
            changed[node] = !changed[node];
            assert_eq!(partition.admits(&changed), admitted, "{node}");
        }
    }
}
