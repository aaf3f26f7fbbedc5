//! Partition of the coupled nodes: whose pressures are solved for, and which of them may change their status without another factorisation.
//!
//! From one iteration to the next statuses change at the edges of the contacts of the planes. The nodes there are the border of the condensed
//! system, closed nodes elsewhere its core, as in `contact::line`.

/// Nodes on either side of an edge that belong to the border.
const EDGE: usize = 1;

/// Place of a coupled node in the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
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
    forms: Vec<Form>,
}

impl Partition {
    /// Chooses the unknowns for the statuses of planes of so many nodes each.
    pub(super) fn choose(&mut self, is_closed: &[bool], nodes_of_plane: usize) {
        self.forms.clear();
        for plane in is_closed.chunks_exact(nodes_of_plane) {
            self.forms.extend((0..plane.len()).map(|i| {
                let near = &plane[i.saturating_sub(EDGE)..(i + EDGE + 1).min(plane.len())];
                let closed = near.iter().filter(|closed| **closed).count();
                match closed {
                    0 => Form::Outside,
                    all if all == near.len() => Form::Core,
                    _ => Form::Border,
                }
            }));
        }
        let forms = &self.forms;
        let of = |form: Form| {
            let nodes = forms
                .iter()
                .enumerate()
                .filter(move |(_, own)| **own == form);
            nodes.map(|(node, _)| node)
        };
        self.nodes.clear();
        self.nodes.extend(of(Form::Core));
        self.core = self.nodes.len();
        self.nodes.extend(of(Form::Border));
    }

    /// Returns `true` if the unknowns allow statuses.
    pub(super) fn admits(&self, is_closed: &[bool]) -> bool {
        let admits = |(form, closed): (&Form, &bool)| match *form {
            Form::Outside => !closed,
            Form::Core => *closed,
            Form::Border => true,
        };
        self.forms.len() == is_closed.len() && self.forms.iter().zip(is_closed).all(admits)
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
