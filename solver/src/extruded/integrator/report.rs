//! Parts of the reports of extruded bodies that other sections do not have.

use super::ExtrudedIntegrator;
use crate::condensation::ExtrudedOperators;
use crate::contact::ContactState;
use crate::mesh::NodePlanes;
use crate::model::Model;
use crate::schedule::step::Position;
use crate::sides::Sides;

impl ExtrudedIntegrator {
    /// The plane in the middle of the width.
    pub(crate) fn reference(&self) -> usize {
        self.contact.bodies.planes.count() - 1
    }

    /// Distance by which the slider has sunk since first touch, by deformation and wear, mm.
    pub(crate) fn approach_mm(&self) -> f64 {
        -self.contact.planes.contacts[0].height
    }

    /// Pressures at the nodes of the body that carries them, plane by plane, MPa.
    pub(crate) fn pressures_mpa(&self) -> Vec<Vec<f64>> {
        let contacts = self.contact.planes.contacts.iter();
        contacts.map(|contact| contact.pressure.clone()).collect()
    }

    /// Node planes, and the section in each of them as when the operators were built, with these.
    pub(crate) fn condensed(&self) -> (&NodePlanes, &[Model], &ExtrudedOperators) {
        let bodies = &self.contact.bodies;
        (&bodies.planes, &bodies.models, &bodies.operators)
    }

    /// Worn depths of each plane, mm.
    pub(crate) fn depths(&self) -> impl Iterator<Item = &Sides<Vec<f64>>> {
        self.contact.planes.states.iter().map(|state| &state.depth)
    }

    /// Contacts of all planes at the named positions of the last computed cycle.
    pub(crate) fn contacts_at_positions(
        &self,
    ) -> impl Iterator<Item = (Position, &[ContactState])> {
        let positions = self.record.positions.iter();
        positions.map(|at| (at.position, &at.contacts[..]))
    }

    /// Degrees of freedom of both meshes, contact elements of the receptacle, and their size in mm.
    pub(crate) fn size(&self) -> (usize, usize, f64) {
        let model = self.contact.bodies.unworn();
        let nodes = model.bodies.receptacle.contact_x().len();
        (
            self.contact.bodies.dofs(),
            self.contact.bodies.planes.count() * (nodes - 1),
            model.sizes.contact_element,
        )
    }
}
