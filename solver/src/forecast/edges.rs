//! Edge of a layer over one that wears faster. While it moves, its nodes change the wear rate in jumps of any length, so that the estimated
//! error holds jumps near their least.

use crate::law::plating::bottoms;
use crate::law::surface::SurfaceWear;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Accuracy, Scene};
use crate::schedule::jump::least_jump;
use crate::sides::{Side, Sides};

/// Ratio of the wear rates of two layers from which on their edge holds jumps back, and mean of the jumps over the least. Fitted to 15 random
/// plated lives at 2 %: with ratios of 9 to 160 the jumps were 0.8 to 5 times the least, in the mean 2.2, with 3 to 6 more than 8 times.
const LEAST_RATIO: f64 = 8.0;
const JUMP: f64 = 2.2;
/// Mean of the implicit jumps over the cycles done, and their increments over those of the surrogate's contact, which wears by the mean rate down
/// to the end. Fitted to `sd_card`, `dimm` and `zif` to base metal at 2 and 10 %, and to 20 000, 200 000 and 400 000 cycles at 10 %: computed
/// cycles are 0.45 to 1.5 times those forecast, increments 0.8 to 1.7 times.
const IMPLICIT_JUMP: f64 = 0.016;
const IMPLICIT_INCREMENTS: f64 = 1.5;

/// Edges that come to move in a run.
pub(super) struct Edges {
    /// Depth of the first interface over a layer that wears much faster.
    fast: Sides<Option<f64>>,
    /// Cycles at which the first of them is reached.
    reached: Option<u64>,
}

impl Edges {
    /// Edges that a scene may have.
    pub(super) fn new(scene: &Scene) -> Self {
        let wear = scene.surface_wear();
        let fast = Sides::from_fn(|side| {
            let wear = (*wear.of(side))?;
            bottoms(scene.plating(side)).find(|bottom| ratio_below(wear, *bottom) > LEAST_RATIO)
        });
        Self {
            fast,
            reached: None,
        }
    }

    /// The largest jump after so many cycles that have worn the sides to a depth, implicit in the worn shapes or of a computed cycle.
    pub(super) fn largest_jump(
        &mut self,
        accuracy: &Accuracy,
        done: u64,
        is_implicit: bool,
        depth: impl Fn(Side) -> f64,
    ) -> u64 {
        let is_reached = |side: Side| self.fast.of(side).is_some_and(|fast| depth(side) > fast);
        if !Side::BOTH.into_iter().any(is_reached) {
            return u64::MAX;
        }
        self.reached = self.reached.or(Some(done));
        cycles_at_least(if is_implicit {
            IMPLICIT_JUMP * real_cycles(done)
        } else {
            JUMP * least_jump(accuracy, done)
        })
    }

    /// Increments of a cycle over those of the surrogate's contact.
    pub(super) fn increments(&self, is_implicit: bool) -> f64 {
        if is_implicit && self.reached.is_some() {
            IMPLICIT_INCREMENTS
        } else {
            1.0
        }
    }

    /// Natural logarithm of the cycles at the end of a run over those at which the first edge was reached; 0 where none was.
    pub(super) fn course(&self, end: u64) -> f64 {
        let reached = self.reached.filter(|cycle| *cycle > 0);
        reached.map_or(0.0, |cycle| (real_cycles(end) / real_cycles(cycle)).ln())
    }
}

/// Wear rate below an interface over that above it.
fn ratio_below(wear: SurfaceWear, interface: f64) -> f64 {
    let part = 1e-3 * interface;
    let [above, at, below] =
        [interface - part, interface, interface + part].map(|depth| wear.equivalent(depth));
    (at - above) / (below - at)
}
