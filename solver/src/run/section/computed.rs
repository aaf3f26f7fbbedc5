//! A computed cycle, which may stand for many, and the contacts within it: of a section, with doses, load and width that change evenly in the
//! cycles. So the criteria of a life are located between computed cycles, too (`record::life`).

use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::electrical::{Contact, Evaluation, Surface, Touching};
use crate::interpolation::part_way;
use crate::law::surface;
use crate::model::Model;
use crate::number::real_cycles;
use crate::record::CycleRange;
use crate::scene::Scene;
use crate::sides::Sides;

/// A computed cycle of a section whose resistance is evaluated.
#[derive(Clone, Copy)]
pub(super) struct Computed<'a> {
    pub(super) evaluation: &'a Evaluation<'a>,
    pub(super) scene: &'a Scene,
    pub(super) model: &'a Model,
    pub(super) condensed: &'a Condensed,
    /// States before and after it.
    pub(super) before: &'a CycleState,
    pub(super) after: &'a CycleState,
}

impl Computed<'_> {
    /// The cycles that it stands for.
    pub(super) fn cycles(self) -> CycleRange {
        CycleRange {
            from: self.before.cycle,
            to: self.after.cycle,
        }
    }

    /// The contact at the last passage of the neutral position after a part of its cycles, with doses, load and width that change evenly and
    /// no place deeper than these limits, mm.
    pub(super) fn contact(self, part: f64, limits: Sides<f64>) -> Touching {
        let (from, to) = (self.before.neutral, self.after.neutral);
        let middle = part_way(from.middle, to.middle, part);
        let half_width = part_way(from.half_width, to.half_width, part);
        let span = (middle - half_width, middle + half_width);
        let depths = (part < 1.0).then(|| self.depths(part, limits));
        let depths = depths.as_ref().unwrap_or(&self.after.depth);
        self.evaluation.section(&Contact {
            load_n_per_mm: part_way(from.load, to.load, part),
            span,
            surfaces: Sides::from_fn(|side| Surface {
                x: self.model.bodies.of(side).contact_x(),
                depth: depths.of(side),
            }),
            time_s: elapsed_s(self.scene, self.cycles().after(part)),
            spreading: self.condensed.spreading_ratios(span),
        })
    }

    /// Depths of both surfaces after a part of the cycles, mm.
    fn depths(self, part: f64, limits: Sides<f64>) -> Sides<Vec<f64>> {
        let Self { before, after, .. } = self;
        let cycles = real_cycles(after.cycle - before.cycle);
        let (wear, rates) = (self.scene.surface_wear(), before.jump.rates());
        Sides::from_fn(|side| {
            let (from, to) = (before.depth.of(side), after.depth.of(side));
            let pace = rates.of(side).iter().map(|rate| rate * cycles);
            let depths = surface::between(*wear.of(side), from, to, pace, part);
            let limit = *limits.of(side);
            depths.into_iter().map(|depth| depth.min(limit)).collect()
        })
    }
}

/// No limit of the depth, mm.
pub(super) const UNLIMITED: Sides<f64> = Sides {
    slider: f64::INFINITY,
    receptacle: f64::INFINITY,
};

/// Time after a number of cycles, s; 0 of a continuous motion.
pub(super) fn elapsed_s(scene: &Scene, cycles: f64) -> f64 {
    scene.elapsed(cycles).1.unwrap_or_default()
}
