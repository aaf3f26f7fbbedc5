//! Parts of the reports of a line that other sections do not have.

use super::LineIntegrator;
use crate::condensation::Condensed;
use crate::model::Model;
use crate::sides::Sides;

impl LineIntegrator {
    /// The station that touches first: across the motion on a ring, in the middle of a crown, at the lower end of a tilt.
    pub(crate) fn reference(&self) -> usize {
        let stations = self.contact.stations.iter();
        let raised = stations.map(|station| station.place.raised_mm);
        let lowest = raised
            .enumerate()
            .reduce(|lowest, next| if next.1 < lowest.1 { next } else { lowest });
        lowest.map_or(0, |(number, _)| number)
    }

    /// Does work in the threads of the run.
    pub(crate) fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.contact.threads.within(work)
    }

    /// The meshed section of a station with its operators, and its worn depths, mm.
    pub(crate) fn section(&self, station: usize) -> (&Model, &Condensed, &Sides<Vec<f64>>) {
        let station = &self.contact.stations[station];
        let section = &station.section;
        (&section.model, &section.condensed, &station.state.depth)
    }

    /// Degrees of freedom of both meshes, contact elements of the receptacle, and their size in mm.
    pub(crate) fn size(&self) -> (usize, usize, f64) {
        let model = &self.contact.unworn.model;
        let bodies = &model.bodies;
        let nodes = bodies.receptacle.contact_x().len();
        let stations = self.contact.stations.len();
        (
            stations * (bodies.slider.dofs() + bodies.receptacle.dofs()),
            stations * (nodes - 1),
            model.sizes.contact_element,
        )
    }
}
