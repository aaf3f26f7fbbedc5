//! The condensed response of a contact surface.

/// Displacements of contact nodes per force at contact nodes, mm per N/mm, in blocks of a pair of nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Compliance {
    nodes: usize,
    blocks: Vec<Block>,
}

/// Response of a node to a force at a node: u_x and u_y per force along x, then per force along y.
pub type Block = [f64; 4];

impl Compliance {
    /// A compliance of zeros.
    pub(super) fn zeros(nodes: usize) -> Self {
        Self {
            nodes,
            blocks: vec![[0.0; 4]; nodes * nodes],
        }
    }

    /// Number of contact nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// The response of all nodes to a force at a node.
    pub fn to_force_at(&self, node: usize) -> &[Block] {
        &self.blocks[node * self.nodes..(node + 1) * self.nodes]
    }

    /// Displacement of surface unknown `row` = 2 i + d per force at unknown `column` = 2 j + e.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.blocks[(column / 2) * self.nodes + row / 2][2 * (column % 2) + row % 2]
    }

    /// Mutable access to the same entry.
    pub(super) fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.blocks[(column / 2) * self.nodes + row / 2][2 * (column % 2) + row % 2]
    }
}
