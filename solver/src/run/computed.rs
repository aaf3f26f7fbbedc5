//! A computed cycle, which may stand for many, and the contacts within it: of a section, with doses, load and width that change evenly in the
//! cycles. So the criteria of a life are located between computed cycles, too (`record::life`).

use crate::condensation::Condensed;
use crate::cycle::CycleState;
use crate::electrical::{Contact, Evaluation, Surface, Touching};
use crate::law::surface;
use crate::model::Model;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::sides::Sides;

/// A computed cycle of a section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Computed<'a> {
    /// States before and after it.
    pub(super) before: &'a CycleState,
    pub(super) after: &'a CycleState,
}

impl Computed<'_> {
    /// The contact at the last passage of the neutral position after a part of its cycles, with doses, load and width that change evenly and
    /// no place deeper than these limits, mm.
    pub(super) fn contact(
        self,
        (evaluation, scene): (&Evaluation<'_>, &Scene),
        (model, condensed): (&Model, &Condensed),
        (part, limits): (f64, Sides<f64>),
    ) -> Touching {
        let Self { before, after } = self;
        let even = |from: f64, to: f64| {
            if part < 1.0 {
                from + part * (to - from)
            } else {
                to
            }
        };
        let (from, to) = (before.neutral, after.neutral);
        let middle = even(from.middle, to.middle);
        let half_width = even(from.half_width, to.half_width);
        let span = (middle - half_width, middle + half_width);
        let depths = (part < 1.0).then(|| self.depths(scene, part, limits));
        let depths = depths.as_ref().unwrap_or(&after.depth);
        evaluation.section(&Contact {
            load_n_per_mm: even(from.load, to.load),
            span,
            surfaces: Sides::from_fn(|side| Surface {
                x: model.bodies.of(side).contact_x(),
                depth: depths.of(side),
            }),
            time_s: elapsed_s(scene, cycle_after((before.cycle, after.cycle), part)),
            spreading: condensed.spreading_ratios(span),
        })
    }

    /// Depths of both surfaces after a part of the cycles, mm.
    fn depths(self, scene: &Scene, part: f64, limits: Sides<f64>) -> Sides<Vec<f64>> {
        let Self { before, after } = self;
        let cycles = real_cycles(after.cycle - before.cycle);
        let (wear, rates) = (scene.surface_wear(), before.jump.rates());
        Sides::from_fn(|side| {
            let ways = (&before.depth.of(side)[..], &after.depth.of(side)[..]);
            let pace = rates.of(side).iter().map(|rate| rate * cycles);
            let depths = surface::between(*wear.of(side), ways, pace, part);
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

/// The number of cycles after a part of those from one to another.
pub(super) fn cycle_after((from, to): (u64, u64), part: f64) -> f64 {
    if part < 1.0 {
        real_cycles(from) + part * real_cycles(to - from)
    } else {
        real_cycles(to)
    }
}

/// Time after a number of cycles, s; 0 of a continuous motion.
pub(super) fn elapsed_s(scene: &Scene, cycles: f64) -> f64 {
    scene.elapsed(cycles).1.unwrap_or_default()
}
