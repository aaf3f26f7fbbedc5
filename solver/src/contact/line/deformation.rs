//! Deformation of both surfaces by forces at their nodes.

use super::mortar::Coupling;
use super::pair::Zones;
use super::state::ContactState;
use crate::condensation::ZoneOperators;
use crate::linear::vector::vectorized;
use crate::sides::Side;
use std::ops::Range;

/// From this number of loaded or coupled nodes on, their displacements are computed with compressed operators. Arbitrary: with 100 and 256
/// contacts of 160 to 640 nodes take as long, to 20 % (`cargo bench -p solver -- partial_slip`).
pub(super) const WIDE: usize = 200;

/// Displacements of some nodes of a coupling, mm: u_x and u_y of each. Buffers are reused.
#[derive(Debug, Default)]
pub(super) struct Deformation {
    /// The slave's nodes, and those of the master that they average.
    nodes: Range<usize>,
    masters: Range<usize>,
    master: Vec<f64>,
    slave: Vec<f64>,
    /// Forces on the nodes of the master.
    reaction: Vec<f64>,
}

impl Deformation {
    /// Resets to no displacement of some slave nodes.
    fn reset(&mut self, nodes: Range<usize>, masters: Range<usize>) {
        for (values, nodes) in [(&mut self.master, &masters), (&mut self.slave, &nodes)] {
            values.clear();
            values.resize(2 * nodes.len(), 0.0);
        }
        (self.nodes, self.masters) = (nodes, masters);
    }

    /// Of some nodes by a force on the slider at a coupled node of the slave, and its reaction on the receptacle.
    pub(super) fn under_force(
        &mut self,
        zones: Zones<'_>,
        coupling: &Coupling,
        node: usize,
        [x, y]: [f64; 2],
        nodes: Range<usize>,
    ) {
        let masters = coupling.masters(&nodes);
        self.reset(nodes, masters);
        let (from, weights) = coupling.dual_row(node);
        for (to, weight) in (from..).zip(weights) {
            let force = [weight * x, weight * y];
            add_force(&mut self.master, zones.master, to, force, &self.masters);
        }
        add_force(&mut self.slave, zones.slave, node, [x, y], &self.nodes);
    }

    /// By forces on the slider at all coupled nodes of the slave (x, y of each), and their reactions.
    pub(super) fn under_forces(&mut self, zones: Zones<'_>, coupling: &Coupling, forces: &[f64]) {
        let (begin, end) = coupling.master_range;
        let nodes = coupling.first..coupling.end;
        self.reset(nodes.clone(), begin..end);
        self.reaction.clear();
        self.reaction.resize(2 * (end - begin), 0.0);
        let (forces_of, _) = forces.as_chunks::<2>();
        for ((from, weights), [x, y]) in coupling.dual_rows(&nodes).zip(forces_of) {
            for (to, weight) in (from - begin..).zip(weights) {
                self.reaction[2 * to] += weight * x;
                self.reaction[2 * to + 1] += weight * y;
            }
        }
        let (masters, reaction) = (&self.masters, &self.reaction[..]);
        zones
            .master
            .add_displacements(masters, reaction, masters, &mut self.master);
        zones
            .slave
            .add_displacements(&nodes, forces, &nodes, &mut self.slave);
    }

    /// By all forces of a contact.
    pub(super) fn under_contact(
        &mut self,
        zones: Zones<'_>,
        slave: Side,
        coupling: &Coupling,
        contact: &ContactState,
    ) {
        let (begin, end) = coupling.master_range;
        self.reset(coupling.first..coupling.end, begin..end);
        let master = slave.other();
        let (masters, nodes) = (&self.masters, &self.nodes);
        add_forces(&mut self.master, masters, zones.master, contact, master);
        add_forces(&mut self.slave, nodes, zones.slave, contact, slave);
    }

    /// Relative displacements at the nodes: the master's, averaged, and the slave's.
    pub(super) fn averaged<'a>(
        &'a self,
        coupling: &'a Coupling,
    ) -> impl Iterator<Item = [f64; 2]> + 'a {
        let (master, _) = self.master.as_chunks::<2>();
        let (slave, _) = self.slave.as_chunks::<2>();
        let begin = self.masters.start;
        coupling
            .dual_rows(&self.nodes)
            .zip(slave)
            .map(move |((from, weights), own)| {
                let mut sum = *own;
                for (weight, u) in weights.iter().zip(&master[from - begin..]) {
                    sum[0] += weight * u[0];
                    sum[1] += weight * u[1];
                }
                sum
            })
    }
}

/// Displaces some nodes of a body by a force at a node.
fn add_force(
    displacement: &mut [f64],
    zone: &ZoneOperators,
    node: usize,
    force: [f64; 2],
    nodes: &Range<usize>,
) {
    let [per_x, per_y] = zone.to_force_at(node, nodes);
    vectorized(
        #[inline(always)]
        || {
            for (u, (per_x, per_y)) in displacement.iter_mut().zip(per_x.iter().zip(per_y)) {
                *u += force[0] * per_x + force[1] * per_y;
            }
        },
    );
}

/// Displaces some nodes of a body by the forces of a contact.
fn add_forces(
    displacement: &mut [f64],
    nodes: &Range<usize>,
    zone: &ZoneOperators,
    contact: &ContactState,
    side: Side,
) {
    let (force, loaded) = (contact.force.of(side), contact.loaded(side));
    if loaded.len() >= WIDE {
        let forces = &force[2 * loaded.start..2 * loaded.end];
        zone.add_displacements(&loaded, forces, nodes, displacement);
        return;
    }
    for node in loaded {
        let force = [force[2 * node], force[2 * node + 1]];
        if force[0] != 0.0 || force[1] != 0.0 {
            add_force(displacement, zone, node, force, nodes);
        }
    }
}
