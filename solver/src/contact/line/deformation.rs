//! Deformation of both surfaces by forces at their nodes.

use super::mortar::Coupling;
use super::pair::Zones;
use super::state::ContactState;
use crate::condensation::ZoneOperators;
use crate::linear::vector::vectorized;
use crate::sides::Side;

/// Displacements of the nodes of a coupling, mm: u_x and u_y of each. Buffers are reused.
#[derive(Debug, Default)]
pub(super) struct Deformation {
    master: Vec<f64>,
    slave: Vec<f64>,
}

impl Deformation {
    /// Resets to no displacement.
    fn reset(&mut self, coupling: &Coupling) {
        let (begin, end) = coupling.master_range;
        for (values, nodes) in [
            (&mut self.master, end - begin),
            (&mut self.slave, coupling.len()),
        ] {
            values.clear();
            values.resize(2 * nodes, 0.0);
        }
    }

    /// By a force on the slider at a coupled node of the slave, and its reaction on the receptacle.
    pub(super) fn under_force(
        &mut self,
        zones: Zones<'_>,
        coupling: &Coupling,
        node: usize,
        [x, y]: [f64; 2],
    ) {
        self.reset(coupling);
        let (from, weights) = coupling.dual_row(node);
        for (to, weight) in (from..).zip(weights) {
            let force = [weight * x, weight * y];
            let begin = coupling.master_range.0;
            add_force(&mut self.master, zones.master, to, force, begin);
        }
        add_force(&mut self.slave, zones.slave, node, [x, y], coupling.first);
    }

    /// By all forces of a contact.
    pub(super) fn under_contact(
        &mut self,
        zones: Zones<'_>,
        slave: Side,
        coupling: &Coupling,
        contact: &ContactState,
    ) {
        self.reset(coupling);
        let begin = coupling.master_range.0;
        add_forces(
            &mut self.master,
            zones.master,
            contact,
            slave.other(),
            begin,
        );
        add_forces(&mut self.slave, zones.slave, contact, slave, coupling.first);
    }

    /// Relative displacements at the coupled nodes: the master's, averaged, and the slave's.
    pub(super) fn averaged<'a>(
        &'a self,
        coupling: &'a Coupling,
    ) -> impl Iterator<Item = [f64; 2]> + 'a {
        let (master, _) = self.master.as_chunks::<2>();
        let (slave, _) = self.slave.as_chunks::<2>();
        let begin = coupling.master_range.0;
        coupling
            .dual_rows()
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

/// Displaces the nodes of a body from `first` on by a force at a node.
fn add_force(
    displacement: &mut [f64],
    zone: &ZoneOperators,
    node: usize,
    force: [f64; 2],
    first: usize,
) {
    let nodes = first..first + displacement.len() / 2;
    let [per_x, per_y] = zone.to_force_at(node, &nodes);
    vectorized(
        #[inline(always)]
        || {
            for (u, (per_x, per_y)) in displacement.iter_mut().zip(per_x.iter().zip(per_y)) {
                *u += force[0] * per_x + force[1] * per_y;
            }
        },
    );
}

/// Displaces the nodes of a body from `first` on by the forces of a contact.
fn add_forces(
    displacement: &mut [f64],
    zone: &ZoneOperators,
    contact: &ContactState,
    side: Side,
    first: usize,
) {
    let force = contact.force.of(side);
    for node in contact.loaded(side) {
        let force = [force[2 * node], force[2 * node + 1]];
        if force[0] != 0.0 || force[1] != 0.0 {
            add_force(displacement, zone, node, force, first);
        }
    }
}
