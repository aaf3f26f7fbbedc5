//! A computed cycle, which may stand for many, and the contacts within it: of a section, with doses, load and width that change evenly in the
//! cycles. So the criteria of a life are located between computed cycles, too (`record::life`).

use super::Moment;
use crate::change::Change;
use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::electrical::{Contact, Evaluation, Surface, Touching};
use crate::interpolation::part_way;
use crate::law::surface;
use crate::model::Model;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::sides::Sides;

/// A computed cycle of a section.
#[derive(Clone, Copy)]
pub(super) struct Computed<'a> {
    pub(super) scene: &'a Scene,
    pub(super) model: &'a Model,
    pub(super) condensed: &'a Condensed,
    pub(super) states: Change<&'a CycleState>,
}

impl Computed<'_> {
    /// The contact at the last passage of the neutral position before a moment.
    pub(super) fn contact(self, evaluation: &Evaluation<'_>, moment: Moment) -> Touching {
        let Moment { part, time_s, .. } = moment;
        let Change { before, after } = self.states;
        let (from, to) = (before.neutral, after.neutral);
        let middle = part_way(from.middle, to.middle, part);
        let half_width = part_way(from.half_width, to.half_width, part);
        let span = (middle - half_width, middle + half_width);
        let depths = (part < 1.0).then(|| self.depths(moment));
        let depths = depths.as_ref().unwrap_or(&after.depth);
        evaluation.section(&Contact {
            load_n_per_mm: part_way(from.load, to.load, part),
            span,
            surfaces: Sides::from_fn(|side| Surface {
                x: self.model.bodies.of(side).contact_x(),
                depth: depths.of(side),
            }),
            time_s,
            spreading: self.condensed.spreading_ratios(span),
        })
    }

    /// Depths of both surfaces at a moment, mm.
    fn depths(self, moment: Moment) -> Sides<Vec<f64>> {
        let Change { before, after } = self.states;
        let cycles = real_cycles(after.cycle - before.cycle);
        let (wear, rates) = (self.scene.surface_wear(), before.jump.rates());
        Sides::from_fn(|side| {
            let (from, to) = (before.depth.of(side), after.depth.of(side));
            let pace = rates.of(side).iter().map(|rate| rate * cycles);
            let depths = surface::between(*wear.of(side), from, to, pace, moment.part);
            let limit = *moment.deepest.of(side);
            depths.into_iter().map(|depth| depth.min(limit)).collect()
        })
    }
}
